#pragma once
/// @file
/// A row of a branch of a path, and what curves over the path show.

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "solver/path/path_point.h"

namespace snapthrough {

/// Least and largest load factor and shown values of the points of a path that are known so far.
struct ShownRange {
  Eigen::VectorXd least, most;
};

/// A row of a branch.
struct PathRow {
  PathPoint point;       ///< its tangent is the rate by arc length, not of norm one
  bool computed = true;  ///< an equilibrium was solved there; false: read off the curve between two of them
  std::optional<double> stiffness_ratio = {};  ///< what add() was given
};
/// Receives rows in path order; may change what it is given.
using RowVisitor = std::function<void(PathRow& row)>;

/// Values that curves over a path show: linear in y, the load factor not among them.
using ShownValues = std::function<Eigen::VectorXd(const Eigen::VectorXd& y)>;

}  // namespace snapthrough
