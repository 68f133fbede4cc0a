#pragma once
/// @file
/// Structures of one model over the values of a parameter.

#include <functional>
#include <memory>
#include <utility>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

/// Structure and equations for one value of the parameter.
struct FamilyMember {
  explicit FamilyMember(Structure structure_of_value)
      : structure(std::move(structure_of_value)), problem(structure) {}

  Structure structure;
  StructuralProblem problem;
};

/// @brief Structures for all values of a parameter, with the unknowns, the mesh and the scales of a
/// reference.
///
/// The coordinate t of a value is the value, or its logarithm. The model is asked for between two values
/// only.
class ModelFamily {
 public:
  /// @param model model for a value; passed check()
  /// @param from, to the two values that bound the parameter, in either order
  ModelFamily(std::function<Model(double)> model, Analysis analysis, bool logarithmic, double from,
              double to);

  [[nodiscard]] double coordinate_of(double value) const;
  [[nodiscard]] double value_at(double t) const;
  [[nodiscard]] double lowest() const { return lowest_; }    ///< least coordinate
  [[nodiscard]] double highest() const { return highest_; }  ///< largest coordinate
  [[nodiscard]] double span() const { return highest_ - lowest_; }

  /// Replaces the reference; it defines the unknowns and scales of all members from now on.
  void set_reference(std::shared_ptr<const FamilyMember> reference) { reference_ = std::move(reference); }
  [[nodiscard]] const FamilyMember& reference() const { return *reference_; }

  /// @brief Member at a coordinate, which is moved between lowest() and highest().
  /// @return null when its unknowns are not those of the reference
  /// @pre set_reference()
  [[nodiscard]] std::shared_ptr<FamilyMember> at(double t) const;

 private:
  std::function<ResolvedModel(double)> model_;
  Analysis analysis_;
  bool logarithmic_;
  double lowest_;
  double highest_;
  double value_lowest_;
  double value_highest_;
  std::shared_ptr<const FamilyMember> reference_;
};

}  // namespace snapthrough
