#pragma once
/// @file
/// The model as the equations take it: what names another object by its id in Model has its index here.
///
/// A resolved object is the object of Model with fields that hide those of the same name: `member` of a
/// resolved foundation is the index of the member, -1: none. Ids are left as names for reports.

#include <array>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "solver/model/model.h"
#include "solver/resolve/action.h"
#include "solver/resolve/located.h"

namespace snapthrough {

struct ResolvedMember : Member {
  int start = -1;    ///< node
  int end = -1;      ///< node
  int section = -1;  ///< section
  bool operator==(const ResolvedMember&) const = default;
};

struct ResolvedSupport : Support {
  int node = -1;
  bool operator==(const ResolvedSupport&) const = default;
};

struct ResolvedSpring : Spring {
  ResolvedLocation at;
  std::optional<ResolvedLocation> to;
  /// See displacement_without_force(): constant, and per load factor; of springs with has_length().
  std::array<double, 2> without_force{0.0, 0.0};
  /// Whether the length between the nodes is not, or not always, that without force.
  [[nodiscard]] bool has_length() const { return pretension || lengthening != std::array{0.0, 0.0}; }
  bool operator==(const ResolvedSpring&) const = default;
};

using ResolvedFoundation = OnMember<Foundation>;
using ResolvedMonitor = AtLocation<Monitor>;
using ResolvedPointMass = AtLocation<PointMass>;
using ResolvedSineImperfection = OnMember<SineImperfection>;
using ResolvedPointsImperfection = OnMember<PointsImperfection>;
using ResolvedImperfection =
    std::variant<ResolvedSineImperfection, ModeImperfection, ResolvedPointsImperfection, WorstImperfection>;

/// Model whose one-sided members are springs: see with_rods_as_springs().
struct ResolvedModel {
  std::vector<Node> nodes;
  std::vector<Section> sections;
  std::vector<ResolvedMember> members;
  std::vector<ResolvedSupport> supports;
  std::vector<ResolvedSpring> springs;
  std::vector<ResolvedFoundation> foundations;
  std::vector<Action> actions;                      ///< in the order of the loads
  std::vector<std::vector<int>> actions_on_member;  ///< indices of `actions`, one list per member
  std::vector<ResolvedImperfection> imperfections;
  std::vector<ResolvedPointMass> masses;
  Damping damping;
  std::vector<ResolvedMonitor> monitors;
  bool operator==(const ResolvedModel&) const = default;

  [[nodiscard]] const Section& section_of(const ResolvedMember& member) const {
    return sections[static_cast<std::size_t>(member.section)];
  }
  [[nodiscard]] const Node& start_of(const ResolvedMember& member) const {
    return nodes[static_cast<std::size_t>(member.start)];
  }
  [[nodiscard]] const Node& end_of(const ResolvedMember& member) const {
    return nodes[static_cast<std::size_t>(member.end)];
  }
};

/// @brief Finds what the ids of a model name, in linear time.
/// @pre the model passed all checks but that of mechanisms
[[nodiscard]] ResolvedModel resolve(const Model& model);

}  // namespace snapthrough
