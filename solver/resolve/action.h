#pragma once
/// @file
/// The four basic actions to which every load is resolved.
///
/// What computes with loads visits these four; no other part of the solver but check/ and the resolving
/// itself knows which kinds of loads a request can have.

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "solver/model/model.h"
#include "solver/resolve/located.h"

namespace snapthrough {

/// Force and moment at a place.
using PointAction = AtLocation<PointLoad>;
/// Follower pressure along a member.
using PressureAction = OnMember<PressureLoad>;
/// Strain of a member without stress.
using StrainAction = OnMember<InitialStrain>;

/// Part of a line action on which its force is a smooth function of the fraction.
struct LinePiece {
  std::array<double, 2> range{};  ///< fractions of the member
  std::array<double, 2> from{};   ///< force per length at the range's start, in the axes of the action
  std::array<double, 2> to{};
  double power = 1.0;  ///< force^(1/power) is linear

  [[nodiscard]] std::array<double, 2> at(double fraction) const;
  bool operator==(const LinePiece&) const = default;
};

/// Dead force per length along a member.
struct LineAction {
  int member = -1;
  LoadMeasure per = LoadMeasure::length;
  LoadAxes axes = LoadAxes::global;
  Pattern pattern = Pattern::proportional;
  std::vector<LinePiece> pieces;  ///< ascending
  bool operator==(const LineAction&) const = default;
};

/// What a load does at one place, or on one member.
struct Action {
  std::variant<PointAction, LineAction, PressureAction, StrainAction> what;
  /// Index of the load among those of the model, whose actions stand together; -1: a pretension.
  int load = -1;
  std::string name;  ///< name of the load for messages

  [[nodiscard]] Pattern pattern() const {
    return std::visit([](const auto& one) { return one.pattern; }, what);
  }
  bool operator==(const Action&) const = default;
};

/// Length to which a force refers, per undeformed length of an axis at an angle.
[[nodiscard]] double measure_of(LoadMeasure per, double angle);

/// Components along global axes of a force in the axes of an action, where the member's axis has an angle.
[[nodiscard]] std::array<double, 2> global_force(LoadAxes axes, const std::array<double, 2>& force,
                                                 double angle);

}  // namespace snapthrough
