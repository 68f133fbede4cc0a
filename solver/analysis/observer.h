#pragma once
/// @file
/// What is gathered over everything that an analysis reaches: extremes and warnings.

#include <Eigen/Core>

#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/report/strain.h"
#include "solver/result.h"

namespace snapthrough {

/// Looks at states as they are reached, whether they are returned or not.
class Observer {
 public:
  /// All kept by reference, must outlive this.
  Observer(const Model& model, const Analysis& analysis, const Structure& structure)
      : model_(model), analysis_(analysis), structure_(structure), gauge_(structure, model) {}

  /// Notes how large the strains are at scaled unknowns y and load factor.
  void note_strain(const Eigen::VectorXd& y, double lambda, int branch);
  /// Adds a state to the extremes, if they were asked for.
  void add_to_extremes(const Eigen::VectorXd& y, double lambda, int branch);
  /// Adds the states that the result returns to the extremes; puts extremes and warnings into it.
  void finish(Result& result);

 private:
  const Model& model_;
  const Analysis& analysis_;
  const Structure& structure_;
  StrainGauge gauge_;
  LargestStrain largest_;
  int strained_branch_ = 0;
  double strained_load_ = 0.0;
  std::vector<MemberExtremes> extremes_;
};

}  // namespace snapthrough
