#pragma once
/// @file
/// Extremes and warnings over all states that an analysis reaches.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "solver/analysis/peak_watch.h"
#include "solver/discrete/structure.h"
#include "solver/model/analysis.h"
#include "solver/report/strain.h"
#include "solver/report/strength.h"
#include "solver/resolve/resolved_model.h"
#include "solver/result.h"

namespace snapthrough {

/// Examines each state of an analysis, including states that the result does not list.
class Observer {
 public:
  /// @param analysis, structure kept by reference; must outlive this object
  Observer(const Analysis& analysis, const Structure& structure)
      : analysis_(analysis),
        structure_(structure),
        gauge_(structure),
        has_strength_(has_strength(*structure.model)),
        peaks_(structure) {}

  /// Begins a path.
  void begin_path() { peaks_.start(); }
  /// Records the largest strain, and supports that go back, at scaled unknowns y and scaled load
  /// factor lambda.
  void note(const Eigen::VectorXd& y, double lambda, int branch);
  /// Records the largest stress over strength, at scaled unknowns y and scaled load factor lambda.
  void note_stress(const Eigen::VectorXd& y, double lambda, int branch);
  /// Adds a state to the extremes, if requested.
  void add_to_extremes(const Eigen::VectorXd& y, double lambda, int branch);
  /// Adds the reported states to the extremes, and writes extremes and warnings into the result.
  void finish(Result& result);

 private:
  void warn_of_stress(Result& result) const;

  const Analysis& analysis_;
  const Structure& structure_;
  StrainGauge gauge_;
  bool has_strength_;
  PeakWatch peaks_;
  LargestStrain largest_;
  int strained_branch_ = 0;
  double strained_load_ = 0.0;
  std::optional<MemberUtilisation> stressed_;  ///< largest stress over strength
  int stressed_branch_ = 0;
  double stressed_load_ = 0.0;
  std::vector<MemberExtremes> extremes_;
};

}  // namespace snapthrough
