/// Where elements end, how many there are, and how meshes become finer.
#include "solver/mesh/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/discrete/build_structure.h"
#include "solver/discrete/structure.h"
#include "solver/resolve/resolved_model.h"
#include "solver/solve.h"
#include "tests/index_of.h"
#include "tests/solver/structures.h"

namespace snapthrough {
namespace {

using testing::fixed_mesh;

Mesh mesh_of(const Model& model, const Discretization& asked, MeshUse use = MeshUse::final) {
  return make_mesh(resolve(model), asked, make_axes(resolve(model)), use);
}

/// Ends of a member's elements, 0 included.
std::vector<double> ends_of(const Mesh& mesh, std::size_t member) {
  std::vector<double> out{0.0};
  for (int e = mesh.first[member]; e < mesh.first[member + 1]; ++e) {
    const MeshElement& element = mesh.elements[static_cast<std::size_t>(e)];
    EXPECT_EQ(element.member, static_cast<int>(member));
    EXPECT_EQ(element.from, out.back()) << "no gap and no overlap";
    out.push_back(element.to);
  }
  EXPECT_EQ(out.back(), 1.0);
  return out;
}

bool has_end(const std::vector<double>& ends, double place) {
  return std::ranges::any_of(ends, [place](double end) { return std::abs(end - place) < 1e-12; });
}

double longest(const std::vector<double>& ends) {
  double out = 0.0;
  for (std::size_t i = 1; i < ends.size(); ++i) out = std::max(out, ends[i] - ends[i - 1]);
  return out;
}

/// A column with something at each of 0.1, 0.2, 0.35, 0.6, 0.8.
Model crowded() {
  Model model = testing::column(1.0, 1.0, 1e6, 10.0);
  model.foundations[0].range = {0.1, 0.6};
  model.springs = {{"s", {"", "column", 0.2}, std::array{0.0, 1.0}, 1.0, Reaction::bilateral, 0.0}};
  model.loads.push_back(PointLoad{{"", "column", 0.35}, {0.0, 1.0}, 0.0, Pattern::constant});
  model.loads.push_back(
      DistributedLoad{"column", {0.0, 1.0}, {0.6, 0.8}, LoadMeasure::length, Pattern::constant});
  return model;
}

TEST(Mesh, IsCountedWithoutBeingMade) {
  Model model = crowded();
  model.members[0].curve = PointsCurve{{{0.3, 0.1}, {0.7, -0.1}}};
  model.imperfections = {SineImperfection{"column", 20, 0.01}};
  Discretization chosen;
  for (const Discretization& asked : {chosen, fixed_mesh(3, 2), fixed_mesh(70, 1)}) {
    for (const MeshUse use : {MeshUse::final, MeshUse::path, MeshUse::first}) {
      const Mesh mesh = mesh_of(model, asked, use);
      const MeshSize size = mesh_size(resolve(model), asked, use);
      EXPECT_EQ(size.elements, static_cast<long long>(mesh.elements.size()));
      EXPECT_EQ(size.order, mesh.order);
    }
  }
}

TEST(Mesh, HasElementsEndWhereSomethingActs) {
  for (const MeshUse use : {MeshUse::final, MeshUse::path, MeshUse::first}) {
    const auto ends = ends_of(mesh_of(crowded(), {}, use), 0);
    for (const double place : {0.1, 0.2, 0.35, 0.6, 0.8}) EXPECT_TRUE(has_end(ends, place)) << place;
  }
}

TEST(Mesh, HasElementsEndWhereASectionBendsItsTaper) {
  Model model = testing::column(4.0, 1.0, 1e6, 0.0);
  model.sections[0].EI = AlongMember({{0.3, 1.0}, {0.7, 0.5}}, 4.0);
  model.sections[0].GA = AlongMember({{0.0, 1.0}, {0.45, 0.5}});
  const auto ends = ends_of(mesh_of(model, {}, MeshUse::first), 0);
  for (const double place : {0.3, 0.45, 0.7}) EXPECT_TRUE(has_end(ends, place)) << place;
}

TEST(Mesh, HasElementsEndAtTheKnotsOfAnAxis) {
  Model model = testing::column(4.0, 1.0, 1e6, 0.0);
  model.members[0].curve = PointsCurve{{{0.8, 0.2}, {1.7, -0.1}, {2.5, 0.2}, {3.1, 0.1}}};
  const Axes axes = make_axes(resolve(model));
  ASSERT_EQ(axes[0]->knots().size(), 2U);
  const auto ends = ends_of(make_mesh(resolve(model), {}, axes), 0);
  for (const double knot : axes[0]->knots()) EXPECT_TRUE(has_end(ends, knot / axes[0]->length()));
}

/// Twelve elements over pieces of 0.1, 0.1, 0.15, 0.25, 0.2, 0.2: the longest piece is cut first.
TEST(Mesh, SharesAFixedNumberByLength) {
  const auto ends = ends_of(mesh_of(crowded(), fixed_mesh(12, 3)), 0);
  EXPECT_EQ(ends.size(), 13U);
  for (const double place : {0.1, 0.2, 0.35, 0.6, 0.8}) EXPECT_TRUE(has_end(ends, place)) << place;
  EXPECT_NEAR(longest(ends), 0.1, 1e-12);
}

/// Ends move with the places that they are at, those between in proportion; nothing moves where a place
/// comes.
TEST(Mesh, MovesWithWhatActsOnIt) {
  const Model model = crowded();
  const Axes axes = make_axes(resolve(model));
  const Mesh mesh = make_mesh(resolve(model), {}, axes);
  Model moved = model;
  moved.springs[0].at.fraction = 0.22;
  const auto before = ends_of(mesh, 0);
  const auto after = ends_of(moved_mesh(mesh, resolve(model), axes, resolve(moved), axes), 0);
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double at = before[i];
    const double expected = at > 0.1 && at < 0.2     ? 0.1 + 1.2 * (at - 0.1)
                            : at >= 0.2 && at < 0.35 ? 0.22 + (at - 0.2) * 0.13 / 0.15
                                                     : at;
    EXPECT_NEAR(after[i], expected, 1e-15) << at;
  }
  moved.loads.push_back(PointLoad{{"", "column", 0.5}, {0.0, 1.0}, 0.0, Pattern::constant});
  EXPECT_EQ(ends_of(moved_mesh(mesh, resolve(model), axes, resolve(moved), axes), 0), before);
}

/// With fewer elements than pieces they are equal, and what lies inside them acts inside.
TEST(Mesh, CutsEquallyWhereThereAreTooFewElements) {
  const auto ends = ends_of(mesh_of(crowded(), fixed_mesh(4, 3)), 0);
  ASSERT_EQ(ends.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(ends[i], 0.25 * static_cast<double>(i), 1e-15);
}

TEST(Mesh, TakesNumbersMemberByMember) {
  Model model = testing::column(1.0, 1.0, 1e6, 0.0);
  model.nodes.push_back({"c", 2.0, 0.0});
  model.members.push_back({"second", "b", "c", "s", LineCurve{}, false, false});
  Discretization asked = fixed_mesh(3, 2);
  asked.member_elements = {{"second", 7}};
  const Mesh mesh = mesh_of(model, asked);
  EXPECT_EQ(mesh.first, (std::vector<int>{0, 3, 10}));
  EXPECT_EQ(mesh.order, 2);
}

/// What an element of each mesh may span, by the rule of make_mesh(): 25 degrees and one decay length where
/// nothing checks it, 60 degrees and three decay lengths where finer meshes follow.
class Grading : public ::testing::TestWithParam<MeshUse> {
 protected:
  [[nodiscard]] double turn() const { return GetParam() == MeshUse::final ? 25.0 : 60.0; }
  [[nodiscard]] double decay_lengths() const { return GetParam() == MeshUse::final ? 1.0 : 3.0; }
};
INSTANTIATE_TEST_SUITE_P(Uses, Grading, ::testing::Values(MeshUse::final, MeshUse::path, MeshUse::first));

TEST_P(Grading, FollowsTheTurningOfTheAxis) {
  for (const double sweep : {20.0, 180.0, 355.0}) {
    Model model = testing::arch(sweep, 1e6, 1.0);
    model.loads.clear();
    const auto ends = ends_of(mesh_of(model, {}, GetParam()), 0);
    EXPECT_LE(longest(ends) * sweep, turn() * (1.0 + 1e-9)) << sweep;
    if (sweep > 300.0) {
      EXPECT_GT(longest(ends) * sweep, 0.6 * turn()) << "far too many elements";
    }
  }
}

TEST_P(Grading, FollowsTheDecayLengthOfTheBasesWhereTheyAre) {
  for (const double K : {1e4, 1e8, 1e12}) {
    Model model = testing::column(1.0, 1.0, 1e6, K);
    model.foundations[0].range = {0.0, 0.5};
    const auto ends = ends_of(mesh_of(model, {}, GetParam()), 0);
    const auto middle = std::ranges::find(ends, 0.5);
    ASSERT_NE(middle, ends.end());
    const double decay = std::pow(4.0 / K, 0.25);
    EXPECT_LE(longest({ends.begin(), middle + 1}), decay_lengths() * decay * (1.0 + 1e-9)) << K;
    // beside the base nothing asks for more
    EXPECT_LE(ends.end() - middle, 6) << K;
  }
}

/// Where finer meshes follow, one-sided bases get the elements that the accuracy needs, and act as those
/// resolve them.
TEST_P(Grading, OfOneSidedBasesFollowsTheAccuracy) {
  Model model = testing::column(1.0, 1.0, 1e6, 1e12);
  model.foundations[0].reaction = Reaction::compression_only;
  const bool is_checked = GetParam() != MeshUse::final;
  const double decay = std::pow(4.0 / 1e12, 0.25);
  for (const double accuracy : {1e-2, 1e-3, 1e-5}) {
    Discretization asked;
    asked.accuracy = accuracy;
    const double width = longest(ends_of(mesh_of(model, asked, GetParam()), 0));
    if (is_checked)
      EXPECT_NEAR(width, std::cbrt(accuracy) / 3.0, 0.1 * width) << accuracy;
    else
      EXPECT_LE(width, decay_lengths() * decay * (1.0 + 1e-9)) << accuracy;
    const double given = longest(ends_of(mesh_of(model, as_stiff_as_given(asked), GetParam()), 0));
    EXPECT_LE(given, decay_lengths() * decay * (1.0 + 1e-9)) << accuracy;
    const Structure structure = make_structure(resolve(model), asked, Geometry::nonlinear, {}, GetParam());
    const FoundationLaw law = law_on(structure, structure.foundation_laws[0], 0);
    const double acting = law.law.stiffness / structure.scales.scaled_modulus(1.0);
    EXPECT_NEAR(acting / (is_checked ? 4.0 * std::pow(3.0 / width, 4) : 1e12), 1.0, 1e-9) << accuracy;
  }
}

TEST_P(Grading, FollowsTheHalfWavesOfAnImperfection) {
  Model model = testing::column(1.0, 1.0, 1e6, 0.0);
  model.imperfections = {SineImperfection{"column", 20, 1e-3}};
  EXPECT_GE(ends_of(mesh_of(model, {}, GetParam()), 0).size(), 41U);
}

TEST_P(Grading, FollowsTheIntervalsOfAnImperfection) {
  Model model = testing::column(1.0, 1.0, 1e6, 0.0);
  PointsImperfection points{"column", {}};
  for (int i = 0; i <= 30; ++i) points.offsets.push_back({i / 30.0, 1e-3 * i * (30 - i)});
  model.imperfections = {points};
  EXPECT_GE(ends_of(mesh_of(model, {}, GetParam()), 0).size(), 31U);
}

/// Three elements saw offsets of sixteen intervals with the other sign; the limit point of the path on the
/// other side, 20 % lower, was then confirmed by finer meshes.
TEST(Mesh, SeesRoughOffsetsOfAColumn) {
  Model model = testing::column(1.0, 1.0, 1e9, 100.0);
  const double offsets[] = {-0.4999, 0.1463,   0.7811, -0.5205, 1.044, 0.5336, -1.624, -2.274,
                            0.5858,  -0.06073, 1.438,  1.122,   -1.45, 0.3087, 1.021};
  PointsImperfection points{"column", {}};
  for (int i = 0; i < 15; ++i) points.offsets.push_back({(i + 1) / 16.0, 1e-3 * offsets[i]});
  model.imperfections = {points};
  Analysis analysis;
  analysis.output.states = StateOutput::none;
  analysis.discretization.accuracy = 1e-5;
  const auto chosen = solve(model, analysis).summary.critical_load_factor;
  analysis.discretization = fixed_mesh(40, 5);
  const auto fine = solve(model, analysis).summary.critical_load_factor;
  ASSERT_TRUE(chosen && fine);
  EXPECT_NEAR(*chosen, *fine, 1e-5 * *fine);
}

/// An imperfection of size zero changes nothing: the bifurcation is perfect.
TEST(Mesh, OfAColumnWithOffsetsOfSizeZeroIsPerfect) {
  Model model = testing::column(1.0, 1.0, 1e9, 100.0);
  model.imperfections = {PointsImperfection{"column", {{0.25, 0.0}, {0.5, 0.0}}},
                         SineImperfection{"column", 1, 0.0}};
  Analysis analysis;
  analysis.output.states = StateOutput::none;
  const Result result = solve(model, analysis);
  EXPECT_EQ(result.summary.critical_type, CriticalType::bifurcation) << result.summary.message;
}

/// So that no element is half a half wave long: see the rule.
TEST(Mesh, OfSeveralHasOddNumbersOfElements) {
  for (const MeshUse use : {MeshUse::path, MeshUse::first})
    for (double K = 1.0; K < 1e10; K *= 7.0)
      EXPECT_EQ(mesh_of(testing::column(1.0, 1.0, 1e6, K), {}, use).elements.size() % 2, 1U) << K;
}

TEST(Mesh, BecomesFinerByHalves) {
  const Mesh mesh = mesh_of(crowded(), fixed_mesh(12, 3, FoundationRule::lumped));
  const auto finer = finer_mesh(mesh);
  ASSERT_TRUE(finer);
  EXPECT_EQ(finer->order, 3);
  EXPECT_EQ(finer->foundation, FoundationRule::consistent) << "what is lumped has no limit";
  const auto coarse = ends_of(mesh, 0);
  const auto fine = ends_of(*finer, 0);
  ASSERT_EQ(fine.size(), 2 * coarse.size() - 1);
  for (std::size_t i = 0; i + 1 < coarse.size(); ++i) {
    EXPECT_EQ(fine[2 * i], coarse[i]);
    EXPECT_EQ(fine[2 * i + 1], 0.5 * (coarse[i] + coarse[i + 1]));
  }
}

/// Halved towards each place until an element there has at most three decay lengths; elsewhere as it was.
TEST(Mesh, IsLayeredTowardsWhereSomethingActs) {
  const Model model = crowded();
  const Axes axes = make_axes(resolve(model));
  const Mesh mesh = mesh_of(model, {}, MeshUse::path);
  const auto ends = ends_of(layered_mesh(mesh, resolve(model), axes, {1e-3}), 0);
  for (const double place : {0.0, 0.1, 0.2, 0.35, 0.6, 0.8, 1.0}) {
    const auto at = std::ranges::find_if(ends, [place](double end) { return std::abs(end - place) < 1e-12; });
    ASSERT_NE(at, ends.end()) << place;
    const auto n = static_cast<std::size_t>(at - ends.begin());
    for (std::size_t i = std::max<std::size_t>(n, 1); i <= std::min(n + 1, ends.size() - 1); ++i)
      EXPECT_LE(ends[i] - ends[i - 1], 3e-3) << place;
  }
  const auto before = ends_of(mesh, 0);
  for (const double end : before) EXPECT_TRUE(has_end(ends, end)) << end;
  EXPECT_LE(ends.size(), before.size() + 12U * 6U);
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ends_of(layered_mesh(mesh, resolve(model), axes, {infinite}), 0), before);
  EXPECT_EQ(
      ends_of(layered_mesh(layered_mesh(mesh, resolve(model), axes, {1e-3}), resolve(model), axes, {1e-3}),
              0),
      ends);
  EXPECT_LE(layered_mesh(mesh, resolve(model), axes, {0.0}).elements.size(), before.size() + 12U * 20U);
}

TEST(Mesh, IsNotRefinedWithoutEnd) {
  std::optional<Mesh> mesh = mesh_of(testing::column(1.0, 1.0, 1e6, 0.0), fixed_mesh(1, 1));
  std::size_t most = 0;
  for (int i = 0; i < 40 && mesh; ++i) {
    most = mesh->elements.size();
    mesh = finer_mesh(*mesh);
  }
  EXPECT_FALSE(mesh);
  EXPECT_EQ(most, 2048U);
}

/// A curve that turns in peaks as narrow as they are sharp asked for as many elements as a sample in a peak
/// let expect (millions); a base beside which a beam is a thread, for more than a number holds.
TEST(Mesh, HasNoMoreElementsThanItNeedsOrMay) {
  Model model = testing::arch(20.0, 1e8, 1e6);
  model.members.front().curve = SineCurve{6.0, 80};
  const Mesh wavy = mesh_of(model, {});
  EXPECT_LE(wavy.elements.size(), 80U * 8U) << "180 degrees a half wave, at 25 an element";
  EXPECT_GE(wavy.elements.size(), 80U * 3U);
  Foundation base;
  base.member = model.members.front().id;
  base.stiffness = 1e60;
  model.foundations.push_back(base);
  const Mesh stiff = mesh_of(model, {});
  EXPECT_GT(stiff.elements.size(), wavy.elements.size());
  EXPECT_LE(stiff.elements.size(), 4000U * 4U) << "4 000 a piece between loads";
}

TEST(Mesh, FindsThingsById) {
  const Model model = crowded();
  EXPECT_EQ(index_of(model.nodes, "b"), 1);
  EXPECT_EQ(index_of(model.nodes, "z"), -1);
}

}  // namespace
}  // namespace snapthrough
