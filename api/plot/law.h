#pragma once
/// @file
/// The law of a spring or foundation of a model: its reaction p over the displacement w into the medium.

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/plot/document.h"
#include "solver/support/law.h"

namespace snapthrough::api::plot {

/// Reaction of a law at one place of its member.
struct LawCurve {
  double fraction = 0;       ///< place on the member, as a fraction of its length
  Law law;                   ///< one-sided supports: for displacements beyond the gap
  double reach = 0;          ///< displacement at which p is 90 % of the capacity or more; 0: p is zero
  std::vector<double> ends;  ///< ascending displacements > 0 at which a part of p ends
  /// Displacement beyond which p is constant; infinite where it is nowhere.
  double flat_from = std::numeric_limits<double>::infinity();
};

/// A spring or foundation with a `law`, in the model's units.
struct SupportLaw {
  std::string id;
  std::string type;         ///< name of the law's form in the document, such as "tanh"
  std::string reaction;     ///< "bilateral", "compression_only" or "tension_only"
  bool is_spring = false;   ///< true: p is a force; false: a force per length
  bool turns = false;       ///< against rotation: w is in rad, p a moment, of a foundation per length
  double gap = 0;           ///< displacement before a one-sided support reacts
  bool gap_varies = false;  ///< the gap varies along the member; `gap` is then 0
  /// One curve; three, at the start, the middle and the end of the range, where numbers vary along the
  /// member.
  std::vector<LawCurve> curves;
  std::shared_ptr<const ReactionCurve> form;  ///< owns what the laws of the curves refer to
};

/// How curves of laws are drawn.
struct LawDrawing {
  static constexpr double room = 1.2;  ///< share of the largest reach of the curves that is drawn
  static constexpr double free =
      0.25;                          ///< share of it on the side to which a one-sided support does not react
  static constexpr int pieces = 60;  ///< parts of each curve over its reach, and over what is drawn
  static constexpr double tolerance = 0.05;  ///< pixels; deviation of a thinned line
};

/// @brief Reads the law of a spring, foundation or release.
/// @throws PlotError when it breaks a rule of docs/requests.md, "Laws"
[[nodiscard]] ReactionLaw read_reaction_law(const Field& law);
/// Reads a number that may vary along its member, and is not negative.
[[nodiscard]] AlongMember read_number_along(const Field& number);
/// Returns a law per length in the model's units, for displacements beyond the gap.
[[nodiscard]] FoundationLaw law_in_units_of_model(const ReactionLaw& given);
/// Returns the curve of a law at a fraction of its member's length. @param law law_in_units_of_model(given)
[[nodiscard]] LawCurve law_curve_at(const ReactionLaw& given, const FoundationLaw& law, double fraction);
/// Reads the gap of a support: its number, and whether it varies along the member. Bilateral ones have none.
[[nodiscard]] std::pair<double, bool> read_gap_of_law(const Field& support, const std::string& reaction);
/// Reads the `reaction` of a support. @throws PlotError when it is none
[[nodiscard]] std::string read_reaction_sense(const Field& support);

/// @brief Reads the law of a spring or foundation.
/// @param id of the spring or foundation; nullopt: the first one with a law, springs first
/// @throws PlotError when the model has no such support, or the law breaks a rule of docs/requests.md, "Laws"
[[nodiscard]] SupportLaw read_support_law(const Field& model, const std::optional<std::string>& id);

}  // namespace snapthrough::api::plot
