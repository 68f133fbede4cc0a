#pragma once
/// @file
/// Loads of members in the forms that the equations take: forces per length, initial strains.

#include <array>
#include <vector>

#include "solver/resolve/resolved_model.h"

namespace snapthrough {

/// Part of a line load on which its force is a smooth function of the fraction.
struct LinePiece {
  std::array<double, 2> range{};  ///< fractions of the member
  std::array<double, 2> from{};   ///< force at the range's start, in the axes of the load
  std::array<double, 2> to{};
  double power = 1.0;  ///< force^(1/power) is linear

  [[nodiscard]] std::array<double, 2> at(double fraction) const;
};

/// Dead load along a member.
struct LineLoad {
  int member = -1;
  LoadMeasure per = LoadMeasure::length;
  LoadAxes axes = LoadAxes::global;
  Pattern pattern = Pattern::proportional;
  std::vector<LinePiece> pieces;  ///< ascending
};

[[nodiscard]] LineLoad line_load(const ResolvedDistributedLoad& load);

/// Length to which a load refers, per undeformed length of an axis at an angle.
[[nodiscard]] double measure_of(LoadMeasure per, double angle);

/// Components along global axes of a force in the axes of a load, where the member's axis has an angle.
[[nodiscard]] std::array<double, 2> global_force(LoadAxes axes, const std::array<double, 2>& force,
                                                 double angle);

/// Weight of a member. @pre the member's section has a mass
[[nodiscard]] LineLoad weight_of(const ResolvedModel& model, int member, const SelfWeight& load);

/// Strain by temperature. @pre the member's section has an expansion
[[nodiscard]] ResolvedInitialStrain strain_of(const ResolvedModel& model,
                                              const ResolvedTemperatureLoad& load);

}  // namespace snapthrough
