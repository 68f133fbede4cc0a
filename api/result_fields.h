#pragma once
/// @file
/// The fields of the result document, one line each: name, member and traits. api/write_result.cpp writes
/// documents by these tables, api/result_table.cpp CSV tables, server/worker/record.h what runners send, and
/// api/stored_fields.h what stores keep. Descriptions, units and ranges are in api/openapi/openapi.json; a
/// test (tests/api/result_fields_test.cpp) holds that against the tables.

#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "api/fields.h"
#include "solver/result.h"

namespace snapthrough::api {

template <>
inline constexpr auto kFields<MemberMode> =
    std::tuple{field<kKey>("id", &MemberMode::id), field("s", &MemberMode::s), field("u", &MemberMode::u),
               field("v", &MemberMode::v), field("rotation", &MemberMode::rotation)};

template <>
inline constexpr auto kFields<EffectiveLength> =
    std::tuple{field<kKey>("id", &EffectiveLength::id), field("length", &EffectiveLength::length),
               field("ratio", &EffectiveLength::ratio)};

template <>
inline constexpr auto kFields<Mode> =
    std::tuple{field("members", &Mode::members), internal(&Mode::effective_lengths)};

/// Documents have effective lengths in buckling modes alone.
struct BucklingMode {
  std::vector<MemberMode> members;
  std::vector<EffectiveLength> effective_lengths;
};

template <>
inline constexpr auto kFields<BucklingMode> =
    std::tuple{field("members", &BucklingMode::members),
               field<kIfAny>("effective_lengths", &BucklingMode::effective_lengths)};

template <>
inline constexpr auto kFields<Softest> =
    std::tuple{field("load_factor", &Softest::load_factor),
               field("stiffness_ratio", &Softest::stiffness_ratio), field("mode", &Softest::mode)};

template <>
inline constexpr auto kFields<AtCritical> =
    std::tuple{field("displacement", &AtCritical::displacement),
               field("relative_displacement", &AtCritical::relative_displacement),
               field("rotation", &AtCritical::rotation), field("strain", &AtCritical::strain)};

template <>
inline constexpr auto kFields<Summary> =
    std::tuple{field<kSent>("critical_load_factor", &Summary::critical_load_factor),
               field<kSent>("critical_type", &Summary::critical_type),
               field<kSent>("error_estimate", &Summary::error_estimate),
               field("softest", &Summary::softest),
               field("at_critical", &Summary::at_critical),
               field<kSent>("termination", &Summary::termination),
               field<kSent>("message", &Summary::message)};

template <>
inline constexpr auto kFields<MeshAnswer> =
    std::tuple{field("elements", &MeshAnswer::elements), field("order", &MeshAnswer::order),
               field("load_factor", &MeshAnswer::load_factor)};

template <>
inline constexpr auto kFields<Sensitivity> =
    std::tuple{field("pointer", &Sensitivity::pointer), field("derivative", &Sensitivity::derivative),
               field("reason", &Sensitivity::reason)};

template <>
inline constexpr auto kFields<KoiterCoefficients> =
    std::tuple{field("a", &KoiterCoefficients::a), field("b", &KoiterCoefficients::b),
               field("kind", &KoiterCoefficients::kind)};

/// `koiter` is absent where the analysis did not ask for it (api/write_result.cpp).
template <>
inline constexpr auto kFields<CriticalPoint> =
    std::tuple{field<kSent>("branch", &CriticalPoint::branch),
               field<kSent>("type", &CriticalPoint::type),
               field<kSent>("cause", &CriticalPoint::cause),
               field<kSent>("load_factor", &CriticalPoint::load_factor),
               field<kSent>("error_estimate", &CriticalPoint::error_estimate),
               field<kSent>("confirmed", &CriticalPoint::confirmed),
               field("meshes", &CriticalPoint::meshes),
               field<kSent>("arc_length", &CriticalPoint::arc_length),
               field("monitors", &CriticalPoint::monitors),
               field<kStored | kIfAny>("monitor_rate", &CriticalPoint::monitor_rate),
               field<kSent | kCount>("negative_before", &CriticalPoint::negative_before),
               field<kSent | kCount>("negative_after", &CriticalPoint::negative_after),
               field<kSent>("multiplicity", &CriticalPoint::multiplicity),
               field<kSent | kNoColumn>("imperfection", &CriticalPoint::imperfection),
               field("state", &CriticalPoint::state),
               field("member", &CriticalPoint::member),
               field("mode", &CriticalPoint::mode),
               field<kIfAny>("sensitivities", &CriticalPoint::sensitivities),
               field<kIfAny>("koiter", &CriticalPoint::koiter),
               internal(&CriticalPoint::after_growth)};

template <>
inline constexpr auto kFields<NodeMotion> =
    std::tuple{field<kKey>("node", &NodeMotion::node), field("u", &NodeMotion::u), field("v", &NodeMotion::v),
               field("rotation", &NodeMotion::rotation)};

template <>
inline constexpr auto kFields<NeutralMotion> =
    std::tuple{field("branch", &NeutralMotion::branch), field("from", &NeutralMotion::from),
               field("to", &NeutralMotion::to), field("nodes", &NeutralMotion::nodes)};

template <>
inline constexpr auto kFields<CapacityLimit> =
    std::tuple{field("load_factor", &CapacityLimit::load_factor), field("supports", &CapacityLimit::supports),
               field("nodes", &CapacityLimit::nodes)};

template <>
inline constexpr auto kFields<ContactEvent> = std::tuple{
    field("branch", &ContactEvent::branch),
    field("id", &ContactEvent::id),
    internal(&ContactEvent::opened),
    field("type",
          [](const ContactEvent& event) { return std::string_view(event.opened ? "opened" : "closed"); }),
    field("load_factor", &ContactEvent::load_factor),
    field("arc_length", &ContactEvent::arc_length),
    field("zones_before", &ContactEvent::zones_before),
    field("zones_after", &ContactEvent::zones_after)};

template <>
inline constexpr auto kFields<Frequencies> = std::tuple{field("omega_squared", &Frequencies::squares),
                                                        field<kIfAny>("imaginary", &Frequencies::imaginary)};

template <>
inline constexpr auto kFields<Vibration> =
    std::tuple{field("load_factor", &Vibration::load_factor), field("frequencies", &Vibration::frequencies),
               field("error_estimates", &Vibration::error_estimates), field("modes", &Vibration::modes)};

template <>
inline constexpr auto kFields<PathRates> = std::tuple{field<kSent>("load_factor", &PathRates::load_factor),
                                                      field<kSent>("monitors", &PathRates::monitors)};

/// The lists have one value a row, but for `computed`.
template <>
inline constexpr auto kFields<Branch> =
    std::tuple{field<kSent>("id", &Branch::id),
               field<kSent>("parent", &Branch::parent),
               field<kSent>("load_factor", &Branch::load_factor),
               field<kSent>("arc_length", &Branch::arc_length),
               field<kSent>("monitors", &Branch::monitors),
               field<kSent>("negative_eigenvalues", &Branch::negative_eigenvalues),
               field<kSent>("stiffness_ratio", &Branch::stiffness_ratio),
               field<kSent>("contact_fraction", &Branch::contact_fraction),
               field<kStored | kIfAny | kNoColumn>("frequencies", &Branch::frequencies),
               field<kStored | kIfAny | kNoColumn>("computed", &Branch::computed),
               field<kStored | kIfAny | kNoColumn>("rates", &Branch::rates),
               field<kSent>("termination", &Branch::termination)};

template <>
inline constexpr auto kFields<Resultant> =
    std::tuple{field("fx", &Resultant::fx), field("fy", &Resultant::fy), field("moment", &Resultant::moment)};

template <>
inline constexpr auto kFields<Peak> = std::tuple{field("value", &Peak::value), field("s", &Peak::s)};

template <>
inline constexpr auto kFields<PeakRange> =
    std::tuple{field("min", &PeakRange::min), field("max", &PeakRange::max)};

/// Documents have the largest displacement as an object with `max` alone.
struct LargestPeak {
  Peak max;
};
template <>
inline constexpr auto kFields<LargestPeak> = std::tuple{field("max", &LargestPeak::max)};

template <>
inline constexpr auto kFields<Utilisation> = std::tuple{
    field("value", &Utilisation::value), field("s", &Utilisation::s), field("fibre", &Utilisation::fibre)};

template <>
inline constexpr auto kFields<MemberPeaks> =
    std::tuple{field("axial_force", &MemberPeaks::axial_force),
               field("shear_force", &MemberPeaks::shear_force),
               field("bending_moment", &MemberPeaks::bending_moment),
               internal(&MemberPeaks::displacement),
               field("displacement", [](const MemberPeaks& one) { return LargestPeak{one.displacement}; }),
               field<kIfAny>("utilisation", &MemberPeaks::utilisation)};

template <>
inline constexpr auto kFields<MemberState> =
    std::tuple{field<kKey>("id", &MemberState::id),
               field("s", &MemberState::s),
               field("x0", &MemberState::x0),
               field("y0", &MemberState::y0),
               field("x", &MemberState::x),
               field("y", &MemberState::y),
               field("u", &MemberState::u),
               field("v", &MemberState::v),
               field("rotation", &MemberState::rotation),
               field("axial_force", &MemberState::axial_force),
               field("shear_force", &MemberState::shear_force),
               field("bending_moment", &MemberState::bending_moment),
               field<kIfAny>("utilisation_left", &MemberState::utilisation_left),
               field<kIfAny>("utilisation_right", &MemberState::utilisation_right),
               field("extremes", &MemberState::extremes)};

template <>
inline constexpr auto kFields<SupportState> =
    std::tuple{field<kKey>("node", &SupportState::node), field("fx", &SupportState::fx),
               field("fy", &SupportState::fy), field("moment", &SupportState::moment)};

template <>
inline constexpr auto kFields<SpringState> = std::tuple{field<kKey>("id", &SpringState::id),
                                                        field("force", &SpringState::force),
                                                        field("displacement", &SpringState::displacement),
                                                        field("closed", &SpringState::closed),
                                                        field("resultant", &SpringState::resultant),
                                                        field<kIfAny>("mobilised", &SpringState::mobilised)};

template <>
inline constexpr auto kFields<FoundationState> = std::tuple{
    field<kKey>("id", &FoundationState::id),       field("s", &FoundationState::s),
    field("reaction", &FoundationState::reaction), field("displacement", &FoundationState::displacement),
    field("contact", &FoundationState::contact),   field("resultant", &FoundationState::resultant),
    field("extremes", &FoundationState::extremes), field<kIfAny>("mobilised", &FoundationState::mobilised)};

/// `tangent` is null where the place has no stiffness matrix.
template <>
inline constexpr auto kFields<PlaceStiffness> = std::tuple{
    field<kIfAny>("node", &PlaceStiffness::node), field<kIfAny>("member", &PlaceStiffness::member),
    field<kIfAny>("fraction", &PlaceStiffness::fraction), field("tangent", &PlaceStiffness::tangent)};

template <>
inline constexpr auto kFields<State> = std::tuple{field("branch", &State::branch),
                                                  field("load_factor", &State::load_factor),
                                                  field("refinements", &State::refinements),
                                                  field<kIfAny>("error_estimate", &State::error_estimate),
                                                  field("members", &State::members),
                                                  field("supports", &State::supports),
                                                  field("springs", &State::springs),
                                                  field("foundations", &State::foundations),
                                                  field("loads", &State::loads),
                                                  field<kIfAny>("stiffness_at", &State::stiffness_at)};

/// The lists have one value a load factor.
template <>
inline constexpr auto kFields<StaticTable> =
    std::tuple{field("load_factor", &StaticTable::load_factor),
               field("monitors", &StaticTable::monitors),
               field("negative_eigenvalues", &StaticTable::negative_eigenvalues),
               field("contact_fraction", &StaticTable::contact_fraction),
               field("state", &StaticTable::state),
               field<kIfAny | kNoColumn>("frequencies", &StaticTable::frequencies)};

template <>
inline constexpr auto kFields<BucklingResult> =
    std::tuple{field("load_factors", &BucklingResult::load_factors),
               field("error_estimates", &BucklingResult::error_estimates), internal(&BucklingResult::modes),
               field("modes", [](const BucklingResult& result) {
                 std::vector<BucklingMode> modes;
                 modes.reserve(result.modes.size());
                 for (const Mode& mode : result.modes)
                   modes.push_back({mode.members, mode.effective_lengths});
                 return modes;
               })};

template <>
inline constexpr auto kFields<Extreme> =
    std::tuple{field("value", &Extreme::value), field("s", &Extreme::s), field("branch", &Extreme::branch),
               field("load_factor", &Extreme::load_factor)};

/// Documents have the place beside branch and load factor.
template <>
inline constexpr auto kFields<UtilisationExtreme> =
    std::tuple{internal(&UtilisationExtreme::place),
               field("value", [](const UtilisationExtreme& one) { return one.place.value; }),
               field("s", [](const UtilisationExtreme& one) { return one.place.s; }),
               field("fibre", [](const UtilisationExtreme& one) { return one.place.fibre; }),
               field("branch", &UtilisationExtreme::branch),
               field("load_factor", &UtilisationExtreme::load_factor)};

template <>
inline constexpr auto kFields<FirstYield> =
    std::tuple{field("load_factor", &FirstYield::load_factor),
               field("error_estimate", &FirstYield::error_estimate),
               field("arc_length", &FirstYield::arc_length),
               field("member", &FirstYield::member),
               internal(&FirstYield::place),
               field("s", [](const FirstYield& one) { return one.place.s; }),
               field("fibre", [](const FirstYield& one) { return one.place.fibre; }),
               field("stress",
                     [](const FirstYield& one) {
                       return std::string_view(one.place.value > 0.0 ? "tension" : "compression");
                     }),
               field("monitors", &FirstYield::monitors)};

template <>
inline constexpr auto kFields<ExtremeRange> =
    std::tuple{field("min", &ExtremeRange::min), field("max", &ExtremeRange::max)};

/// Documents have the largest displacement as an object with `max` alone.
struct LargestExtreme {
  Extreme max;
};
template <>
inline constexpr auto kFields<LargestExtreme> = std::tuple{field("max", &LargestExtreme::max)};

template <>
inline constexpr auto kFields<MemberExtremes> = std::tuple{
    field<kKey>("id", &MemberExtremes::id),
    field("axial_force", &MemberExtremes::axial_force),
    field("shear_force", &MemberExtremes::shear_force),
    field("bending_moment", &MemberExtremes::bending_moment),
    internal(&MemberExtremes::displacement),
    field("displacement", [](const MemberExtremes& one) { return LargestExtreme{one.displacement}; }),
    field<kIfAny>("utilisation", &MemberExtremes::utilisation)};

/// Documents have the extremes of all members in an object `members`.
struct AllExtremes {
  std::vector<MemberExtremes> members;
};
template <>
inline constexpr auto kFields<AllExtremes> = std::tuple{field("members", &AllExtremes::members)};

template <>
inline constexpr auto kFields<Warning> =
    std::tuple{field("code", &Warning::code), field("detail", &Warning::detail)};

/// Documents have the two accuracies of a mesh in an object `accuracy`.
struct MeshAccuracy {
  std::optional<double> requested;
  std::optional<double> estimated;
};
template <>
inline constexpr auto kFields<MeshAccuracy> =
    std::tuple{field("requested", &MeshAccuracy::requested), field("estimated", &MeshAccuracy::estimated)};

template <>
inline constexpr auto kFields<MeshReport> =
    std::tuple{field<kCount>("elements", &MeshReport::elements),
               field<kCount>("order", &MeshReport::order),
               field<kCount>("unknowns", &MeshReport::unknowns),
               field<kCount>("refinements", &MeshReport::refinements),
               field("paths", &MeshReport::paths),
               internal(&MeshReport::requested_accuracy),
               internal(&MeshReport::estimated_accuracy),
               field("accuracy",
                     [](const MeshReport& mesh) {
                       return MeshAccuracy{mesh.requested_accuracy, mesh.estimated_accuracy};
                     }),
               internal(&MeshReport::ends)};

/// Documents also have `wall_time_s`, which write_result() is given.
template <>
inline constexpr auto kFields<Diagnostics> =
    std::tuple{field<kCount>("steps", &Diagnostics::steps),
               field<kCount>("rejected_steps", &Diagnostics::rejected_steps),
               field<kCount>("iterations", &Diagnostics::iterations),
               field<kCount>("factorizations", &Diagnostics::factorizations),
               field<kCount>("max_relative_residual", &Diagnostics::max_relative_residual),
               field("skipped", &Diagnostics::skipped),
               internal(&Diagnostics::corrections)};

template <>
inline constexpr auto kFields<MemberOffsets> =
    std::tuple{field("type", [](const MemberOffsets&) { return std::string_view("points"); }),
               field("member", &MemberOffsets::member), field("offsets", &MemberOffsets::offsets)};

template <>
inline constexpr auto kFields<WorstOffset> =
    std::tuple{field("perfect_load_factor", &WorstOffset::perfect_load_factor),
               field("perfect_type", &WorstOffset::perfect_type),
               field("first_order_load_factor", &WorstOffset::first_order_load_factor),
               field("load_factor", &WorstOffset::load_factor),
               field<kCount>("paths", &WorstOffset::paths),
               field("imperfections", &WorstOffset::imperfections)};

template <>
inline constexpr auto kFields<Failure> =
    std::tuple{field("code", &Failure::code), field("detail", &Failure::detail)};

/// Documents also have `kind`, `program`, `request_sha256`, and `model`: title and units of the request.
template <>
inline constexpr auto kFields<Result> = std::tuple{
    field("summary", &Result::summary),
    field("critical_points", &Result::critical_points),
    field("neutral_motion", &Result::neutral_motion),
    field<kIfAny>("capacity", &Result::capacity),
    field("contact_events", &Result::contact_events),
    field("branches", &Result::branches),
    field("states", &Result::states),
    field<kIfAny>("static", &Result::static_table),
    field("not_reached", &Result::not_reached),
    field<kIfAny>("buckling", &Result::buckling),
    field<kIfAny>("vibrations", &Result::vibrations),
    internal(&Result::extremes),
    field<kIfAny>("extremes",
                  [](const Result& result) {
                    return result.extremes ? std::optional(AllExtremes{*result.extremes}) : std::nullopt;
                  }),
    field<kIfAny>("first_yield", &Result::first_yield),
    field<kIfAny>("worst_imperfection", &Result::worst_imperfection),
    field("warnings", &Result::warnings),
    field("discretization", &Result::discretization),
    field("diagnostics", &Result::diagnostics),
    field<kIfAny>("failure", &Result::failure)};

template <class... Types>
inline constexpr bool kAllHaveEveryMember = (has_every_member<Types>() && ...);

static_assert(
    kAllHaveEveryMember<MemberMode, EffectiveLength, Mode, Softest, AtCritical, Summary, MeshAnswer,
                        Sensitivity, KoiterCoefficients, CriticalPoint, NodeMotion, NeutralMotion,
                        CapacityLimit, ContactEvent, Frequencies, Vibration, Branch, Resultant, MemberState,
                        SupportState, SpringState, FoundationState, State, StaticTable, BucklingResult,
                        Extreme, UtilisationExtreme, ExtremeRange, MemberExtremes, FirstYield, Utilisation,
                        Warning, MeshReport, Diagnostics, MemberOffsets, WorstOffset, Failure, Result>,
    "A member of solver/result.h has no line in its table: add field(...), or internal(...) where documents "
    "do not have it.");

}  // namespace snapthrough::api
