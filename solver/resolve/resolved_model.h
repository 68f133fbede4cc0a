#pragma once
/// @file
/// The model as the equations take it: what names another object by its id in Model has its index here.
///
/// A resolved object is the object of Model with fields that hide those of the same name: `member` of a
/// resolved foundation is the index of the member, -1: none. Ids are left as names for reports.

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "solver/model/model.h"

namespace snapthrough {

/// Location with indices. Exactly one of `node`, `member` is not -1.
struct ResolvedLocation {
  int node = -1;
  int member = -1;
  double fraction = 0.0;  ///< fraction of the member's undeformed length
  [[nodiscard]] bool is_on_member() const { return member >= 0; }
  bool operator==(const ResolvedLocation&) const = default;
};

/// What acts on a member.
template <class T>
struct OnMember : T {
  int member = -1;
  bool operator==(const OnMember&) const = default;
};

/// What acts at a location.
template <class T>
struct AtLocation : T {
  ResolvedLocation at;
  bool operator==(const AtLocation&) const = default;
};

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
  bool operator==(const ResolvedSpring&) const = default;
};

using ResolvedFoundation = OnMember<Foundation>;
using ResolvedMonitor = AtLocation<Monitor>;
using ResolvedPointMass = AtLocation<PointMass>;
using ResolvedPointLoad = AtLocation<PointLoad>;
using ResolvedDistributedLoad = OnMember<DistributedLoad>;
using ResolvedPressureLoad = OnMember<PressureLoad>;
using ResolvedInitialStrain = OnMember<InitialStrain>;
using ResolvedTemperatureLoad = OnMember<TemperatureLoad>;
using ResolvedLoad = std::variant<ResolvedPointLoad, ResolvedDistributedLoad, ResolvedPressureLoad,
                                  ResolvedInitialStrain, SelfWeight, ResolvedTemperatureLoad>;
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
  std::vector<ResolvedLoad> loads;
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
