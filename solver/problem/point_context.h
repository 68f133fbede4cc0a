#pragma once
/// @file
/// What the equations at a point of a path depend on beside unknowns and load factor.

#include <memory>

#include "solver/problem/holds.h"

namespace snapthrough {

/// @brief What supports remember of the path so far. Derived classes say what; immutable.
class History {
 public:
  History() = default;
  History(const History&) = delete;
  History& operator=(const History&) = delete;
  History(History&&) = delete;
  History& operator=(History&&) = delete;
  virtual ~History() = default;
};

/// History shared by the points of a path; null: nothing was remembered yet.
using SharedHistory = std::shared_ptr<const History>;

/// @brief Holds and history of a point.
///
/// Every point has its own, so that a path can go on from any of its points. A step keeps the context of the
/// point from which it starts; the history advances where a step is recorded
/// (EquilibriumProblem::remembered()).
struct PointContext {
  SharedHolds holds;
  SharedHistory history;
};

}  // namespace snapthrough
