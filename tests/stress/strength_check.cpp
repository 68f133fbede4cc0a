#include "tests/stress/strength_check.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "tests/index_of.h"

namespace snapthrough::testing {
namespace {

using Fail = std::function<void(const std::string&)>;

/// Stress over strength of a state that counts as first yield, which lies on other meshes than the state.
constexpr double kBeyond = 1.0 + 1e-6;

/// Stress over strength in a fibre by hand; side -1: left, 1: right.
double utilisation(const Strength& strength, double fraction, double side, double N, double M) {
  const double stress =
      N / strength.axial_force.at(fraction) + side * M / strength.bending_moment.at(fraction);
  return stress < 0.0 ? stress / strength.compression : stress;
}

const Section& section_of(const Model& model, const std::string& member) {
  const Member& one = model.members[static_cast<std::size_t>(index_of(model.members, member))];
  return model.sections[static_cast<std::size_t>(index_of(model.sections, one.section))];
}

/// A rod yields at its weakest place.
Strength weakest(const Strength& strength) {
  return {strength.axial_force.least(), strength.bending_moment.least(), strength.compression};
}

bool is_near(double value, double expected) {
  return std::abs(value - expected) <= 1e-9 * (1.0 + std::abs(expected));
}

void check_member(const Model& model, const MemberState& said, const Fail& fail) {
  const Member& member = model.members[static_cast<std::size_t>(index_of(model.members, said.id))];
  const std::optional<Strength>& given = section_of(model, said.id).strength;
  const std::size_t count = given ? said.s.size() : 0;
  if (said.utilisation_left.size() != count || said.utilisation_right.size() != count ||
      said.extremes.utilisation.has_value() != given.has_value()) {
    fail("strength: member " + said.id + " has stresses over strength without a strength, or none with one");
    return;
  }
  if (!given) return;
  const Strength strength = is_rod(member) ? weakest(*given) : *given;
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double fraction = said.s[i] / said.s.back();
    const double left = utilisation(strength, fraction, -1.0, said.axial_force[i], said.bending_moment[i]);
    const double right = utilisation(strength, fraction, 1.0, said.axial_force[i], said.bending_moment[i]);
    largest = std::max({largest, std::abs(left), std::abs(right)});
    if (!is_near(said.utilisation_left[i], left) || !is_near(said.utilisation_right[i], right))
      fail("strength: member " + said.id + " says " + std::to_string(said.utilisation_left[i]) + " and " +
           std::to_string(said.utilisation_right[i]) + " for " + std::to_string(left) + " and " +
           std::to_string(right));
  }
  if (std::abs(said.extremes.utilisation->value) < largest * (1.0 - 1e-6) - 1e-9)
    fail("strength: the extreme of member " + said.id + " is below a listed value");
}

/// Largest stress over strength of a state in size.
double largest_of(const State& state) {
  double out = 0.0;
  for (const MemberState& member : state.members)
    if (member.extremes.utilisation) out = std::max(out, std::abs(member.extremes.utilisation->value));
  return out;
}

/// No state of the primary path before first yield is beyond it, and a path whose states go beyond tells it.
void check_first_yield(const Result& result, const std::vector<int>& states, const Fail& fail) {
  const Branch* branch = result.branches.empty() ? nullptr : &result.branches.front();
  std::size_t row = 0;
  bool is_first = true;
  for (const int index : states) {
    const State& state = result.states[static_cast<std::size_t>(index)];
    if (state.branch != 0) continue;
    const bool is_beyond = largest_of(state) > kBeyond;
    const bool begins = std::exchange(is_first, false);
    if (branch != nullptr)
      while (row < branch->load_factor.size() && branch->load_factor[row] != state.load_factor) ++row;
    const bool has_row = branch != nullptr && row < branch->load_factor.size();
    if (is_beyond && begins && !result.first_yield) return;  // the path begins beyond first yield
    if (is_beyond && !result.first_yield) {
      fail("first_yield: none is told, and a state at load factor " + std::to_string(state.load_factor) +
           " has " + std::to_string(largest_of(state)) + " of the strength");
      return;
    }
    if (is_beyond && has_row && branch->arc_length[row] < result.first_yield->arc_length)
      fail("first_yield: a state before it, at load factor " + std::to_string(state.load_factor) + ", has " +
           std::to_string(largest_of(state)) + " of the strength");
    if (has_row) ++row;
  }
}

void check_mobilised(const State& state, const Fail& fail) {
  constexpr double kRounding = 1e-9;
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0 + kRounding; };
  for (const SpringState& spring : state.springs)
    if (spring.mobilised && !is_share(*spring.mobilised))
      fail("mobilised: spring " + spring.id + " says " + std::to_string(*spring.mobilised));
  for (const FoundationState& base : state.foundations)
    for (const double value : base.mobilised)
      if (!is_share(value)) fail("mobilised: foundation " + base.id + " says " + std::to_string(value));
}

}  // namespace

void check_strength(const Model& model, const Result& result, const std::vector<int>& states,
                    const std::function<void(const std::string&)>& fail) {
  bool is_beyond = false;
  for (const State& state : result.states) {
    for (const MemberState& member : state.members) check_member(model, member, fail);
    check_mobilised(state, fail);
    is_beyond = is_beyond || largest_of(state) > 1.0 + 1e-3;
  }
  check_first_yield(result, states, fail);
  const bool warns =
      std::ranges::any_of(result.warnings, [](const Warning& one) { return one.code == "beyond_yield"; });
  if (is_beyond && !warns) fail("strength: no warning tells that states are beyond first yield");
}

}  // namespace snapthrough::testing
