#pragma once
/// @file
/// Laws of supports in groups that have axes in common.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "api/plot/law.h"

namespace snapthrough::api::plot {

/// A support with a law. A foundation without one is among them where it acts together with others.
struct LawSource {
  std::string id;
  ReactionLaw given;
  FoundationLaw law;
  std::size_t link = 0;               ///< foundation: member of the group's chain; else its own number
  std::array<double, 2> range{0, 1};  ///< fractions of the member on which the foundation acts
};

/// A place of a group, at which the laws of all its sources that act there are added. Places with the same
/// law that follow one another are one.
struct LawPlace {
  std::size_t link = 0;
  double fraction = 0;  ///< share of the member's length
  double middle = 0;    ///< fraction inside of the part of the member whose sources act
  double from = 0;      ///< coordinates between which the law is the same; both are equal where it varies
  double to = 0;
  std::size_t last_link = 0;  ///< member and fraction at `to`
  double last_fraction = 0;
  std::string name;                    ///< name of a spring or joint; empty: the coordinates tell the place
  std::string reaction = "bilateral";  ///< or "compression_only", "tension_only"
  double gap = 0;
  std::array<double, 10> forces{};  ///< at displacements that all places of the group have in common
};

/// Whether the numbers of laws are linear from one place to the next one.
[[nodiscard]] bool are_joined(const LawPlace& before, const LawPlace& after);

/// The sum of the laws at a place.
struct LawSum {
  std::vector<LawCurve> parts;
  [[nodiscard]] double force_at(double w) const;
  /// Returns the largest reach of the parts.
  [[nodiscard]] double reach() const;
  /// Returns the displacement beyond which the force is constant; infinite where it is nowhere.
  [[nodiscard]] double flat_from() const;
};

enum class Whereabouts { depth, height, distance, name };

/// Laws that a figure draws with the same axes.
struct LawGroup {
  std::string title;        ///< such as "Across shaft"
  std::string sense;        ///< side and sense of a one-sided foundation; empty: others
  std::string given_by;     ///< ids of what gives the laws; empty: the places have names
  bool turns = false;       ///< against rotation
  bool is_spring = false;   ///< forces, or moments; false: per length
  bool gap_varies = false;  ///< displacements are those beyond a gap that varies
  Whereabouts whereabouts = Whereabouts::name;
  std::vector<LawSource> sources;  ///< in the order of their links
  /// Whether coordinates are linear in the fractions of members, so that places between two have them too.
  bool is_even = false;
  std::vector<LawPlace>
      places;  ///< at which the numbers of laws bend; from top to bottom, or along the members

  [[nodiscard]] std::span<const LawSource> sources_on(std::size_t link) const;
  [[nodiscard]] LawSum sum_at(const LawPlace& place) const;
};

}  // namespace snapthrough::api::plot
