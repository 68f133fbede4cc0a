/// Beams on one-sided foundations with a shear layer, small displacements: where they lift off.
///
/// Source: data/tensionless_pasternak.py, exact solutions piece by piece. EI = 1/4, K = 1; beams that are
/// infinite there are so long here that e^-25 is left of what happens in the middle.
#include "tests/verification/cases.h"

namespace snapthrough {
namespace {

using namespace testing;

Model beam_on_ground(double length, double G, GroundEnd end = GroundEnd::free) {
  Model model = straight(length, 0.25, 1e6, "x", "");
  model.foundations = {one_sided("m", 1.0, Side::right)};
  model.foundations[0].shear_stiffness = G;
  model.foundations[0].ground_end = end;
  return model;
}

Load weight_of_beam() {
  return DistributedLoad{"m", {0.0, -1.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional};
}

State linear_state(const Model& model, const Discretization& mesh) {
  Analysis analysis = static_on(mesh, Geometry::linear);
  analysis.output.points_per_member = 10 * mesh.elements * mesh.order + 1;
  Result result = solve_soundly(model, analysis);
  return result.states.at(0);
}

struct PointLoaded {
  double G, half, depth, moment;
};

TEST(WeightlessBeamOnPasternakGround, LiftsOffWhereTheExactSolutionDoes) {
  constexpr PointLoaded kBeams[] = {{0.01, 1.47803766237477, 0.541124079317617, 0.270562039658808},
                                    {0.1, 1.31660984752759, 0.510195946033965, 0.255097973016982},
                                    {0.5, 1.11072073453959, 0.42290886594554, 0.21145443297277},
                                    {1.5, 0.931229859452712, 0.320482662853511, 0.160241331426756}};
  for (const PointLoaded& beam : kBeams) {
    Model model = beam_on_ground(6.0, beam.G, GroundEnd::endless);
    model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
    const State state = linear_state(model, fixed_mesh(24, 6));
    ASSERT_EQ(state.foundations[0].contact.size(), 1u) << beam.G;
    EXPECT_NEAR(state.foundations[0].contact[0][0], 3.0 - beam.half, 1e-5) << beam.G;
    EXPECT_NEAR(state.foundations[0].contact[0][1], 3.0 + beam.half, 1e-5) << beam.G;
    const std::size_t middle = state.members[0].s.size() / 2;
    EXPECT_NEAR(-state.members[0].y[middle], beam.depth, 1e-8) << beam.G;
    EXPECT_NEAR(state.members[0].bending_moment[middle], beam.moment, 1e-8) << beam.G;
    EXPECT_NEAR(state.foundations[0].resultant.fy, 1.0, 1e-9) << beam.G;
  }
}

/// The pressure jumps inside an element, at an end of contact: the order is min(2 p, 5).
TEST(WeightlessBeamOnPasternakGround, ConvergesWithTheOrder) {
  const auto error = [](int elements, int order) {
    Model model = beam_on_ground(6.0, 0.1, GroundEnd::endless);
    model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
    const State state = linear_state(model, fixed_mesh(elements, order));
    return std::abs(-state.members[0].y[state.members[0].y.size() / 2] - 0.510195946033965);
  };
  for (const int order : {1, 2, 3}) {
    const double slope = std::log(error(34, order) / error(66, order)) / std::log(66.0 / 34.0);
    EXPECT_GT(slope, std::min(2.0 * order, 5.0) - 0.2) << order;
  }
}

struct Heavy {
  double G, force, lift_off, touch_down, depth;
};

/// The ground's surface between the zones belongs to both.
TEST(HeavyBeamOnPasternakGround, LiftsOffWhereTheExactSolutionDoes) {
  constexpr double kHalf = 40.0;
  constexpr Heavy kBeams[] = {{0.1, 80, 2.307337109289, 4.3771005834406, 39.160172062401},
                              {0.1, 200, 1.88464727059815, 6.48163252178148, 96.8906052576327},
                              {0.3, 120, 2.09670629768488, 4.7274508889585, 53.6474321727883},
                              {0.3, 200, 1.8420280926431, 5.9650885333372, 88.881230650559}};
  for (const Heavy& beam : kBeams) {
    Model model = beam_on_ground(2.0 * kHalf, beam.G);
    model.loads = {force_at(at_member("m", 0.5), 0.0, -beam.force), weight_of_beam()};
    const State state = linear_state(model, fixed_mesh(240, 6));
    const auto& contact = state.foundations[0].contact;
    ASSERT_EQ(contact.size(), 3u) << beam.G << " " << beam.force;
    EXPECT_NEAR(contact[0][1], kHalf - beam.touch_down, 1e-5) << beam.force;
    EXPECT_NEAR(contact[1][0], kHalf - beam.lift_off, 1e-5) << beam.force;
    EXPECT_NEAR(contact[1][1], kHalf + beam.lift_off, 1e-5) << beam.force;
    EXPECT_NEAR(contact[2][0], kHalf + beam.touch_down, 1e-5) << beam.force;
    const std::vector<double>& y = state.members[0].y;
    expect_relative(-y[y.size() / 2], beam.depth, 1e-8, "depth");
  }
}

struct Turned {
  double G;
  GroundEnd end;
  double lift_off, start, tip, edge_force;
};

/// A beam of length 4 and unit weight, turned by a moment at its start, with a force at its other end, where
/// the ground has an edge force.
TEST(TurnedBeamOnPasternakGround, LiftsOffWhereTheExactSolutionDoes) {
  constexpr GroundEnd kFree = GroundEnd::free;
  constexpr GroundEnd kEndless = GroundEnd::endless;
  constexpr Turned kBeams[] = {
      {0.1, kFree, 0.547137111310395, -0.776159070011726, 1.82863418556314, 0.0709223222578134},
      {0.5, kFree, 0.773974428135536, -0.672388396128881, 1.62902374781936, 0.227142848050867},
      {0.1, kEndless, 0.534508818155817, -0.784975070678898, 1.17787446322086, 0.381284808776058},
      {0.5, kEndless, 0.745539140160937, -0.775478540543746, 0.87389778157286, 0.537911405969135}};
  for (const Turned& beam : kBeams) {
    Model model = beam_on_ground(4.0, beam.G, beam.end);
    model.loads = {force_at(at_node("a"), 0.0, 0.0, -0.8), force_at(at_node("b"), 0.0, -0.5),
                   weight_of_beam()};
    const State state = linear_state(model, fixed_mesh(24, 6));
    ASSERT_EQ(state.foundations[0].contact.size(), 1u) << beam.G;
    EXPECT_NEAR(state.foundations[0].contact[0][0], beam.lift_off, 1e-5) << beam.G;
    EXPECT_NEAR(state.foundations[0].contact[0][1], 4.0, 1e-12) << beam.G;
    EXPECT_NEAR(-state.members[0].y.front(), beam.start, 1e-8) << beam.G;
    EXPECT_NEAR(-state.members[0].y.back(), beam.tip, 1e-8) << beam.G;
    EXPECT_NEAR(state.members[0].shear_force.back(), beam.edge_force - 0.5, 1e-7) << beam.G;
    EXPECT_NEAR(state.foundations[0].resultant.fy, 4.5, 1e-9) << beam.G;
  }
}

/// The answer goes to that of a Winkler foundation as the shear layer vanishes.
TEST(BeamOnPasternakGround, GoesToTheWinklerFoundation) {
  const auto depth = [](double G) {
    Model model = beam_on_ground(6.0, G);
    model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
    const State state = linear_state(model, fixed_mesh(24, 6));
    return -state.members[0].y[state.members[0].y.size() / 2];
  };
  constexpr double kWinkler = 0.5451657053637;
  const double first = kWinkler - depth(1e-4);
  const double second = kWinkler - depth(1e-6);
  EXPECT_GT(first, 0.0);
  EXPECT_NEAR(second, 0.01 * first, 0.002 * first);
  EXPECT_NEAR(depth(1e-12), kWinkler, 1e-9);
}

struct PinnedColumn {
  double G;
  GroundEnd end;
  double load;
};

/// Values of data/column_between_layers.py: the contact of the mode, without pressure before it.
TEST(ColumnBetweenPasternakGround, HasTheBucklingLoadOfItsOwnContact) {
  constexpr PinnedColumn kColumns[] = {{1.0, GroundEnd::free, 116.40312039},
                                       {5.0, GroundEnd::free, 119.73622766},
                                       {20.0, GroundEnd::free, 129.77710413},
                                       {20.0, GroundEnd::endless, 131.26645626},
                                       {50.0, GroundEnd::endless, 149.59324718}};
  for (const PinnedColumn& column : kColumns) {
    Model model = straight(1.0, 1.0, 1e8, "xy", "y");
    model.foundations = {one_sided("m", 3000.0, Side::right), one_sided("m", 3000.0, Side::left)};
    model.foundations[1].id = "above";
    for (Foundation& ground : model.foundations) {
      ground.shear_stiffness = column.G;
      ground.ground_end = column.end;
    }
    model.loads = {force_at(at_node("b"), -1.0, 0.0)};
    const Result result = solve_soundly(model, buckling_on(fixed_mesh(24, 6)));
    ASSERT_FALSE(!result.buckling || result.buckling->load_factors.empty()) << column.G;
    expect_relative(result.buckling->load_factors[0], column.load, 3e-8, "buckling load");
  }
}

struct Arch {
  double G;
  GroundEnd end;
  double limit, depth, lift_off;
};

/// Values of data/arch_on_pasternak.py, by collocation with the end of contact as an unknown.
TEST(ArchOnPasternakGround, HasTheLimitLoadOfCollocation) {
  constexpr double kRise = 0.4;  // opening angle
  constexpr Arch kArches[] = {
      {0.5, GroundEnd::free, 2.690024258373136, 0.056599, 0.5914279046606309},
      {1.0, GroundEnd::free, 2.755592340370985, 0.058230, 0.6934589203721626},
      {1.0, GroundEnd::endless, 2.759603130864683, 0.058418, 0.686345123924367},
  };
  for (const Arch& arch : kArches) {
    Model model = straight(2.0, 1.0, 8000.0, "xyr", "xyr");
    model.members[0].curve = ArcCurve{-kRise * 180.0 / kPi};
    model.foundations = {one_sided("m", 10.0, Side::left)};
    model.foundations[0].direction = {0.0, -1.0};
    model.foundations[0].shear_stiffness = arch.G;
    model.foundations[0].ground_end = arch.end;
    model.loads = {force_at(at_member("m", 0.5), 0.0, -1.0)};
    Analysis analysis = path_on(fixed_mesh(32, 6), 1);
    analysis.output.states = StateOutput::critical;
    const Result result = solve_soundly(model, analysis);
    const std::vector<CriticalPoint> limits = limits_of(result);
    ASSERT_EQ(limits.size(), 1u) << arch.G;
    expect_relative(limits[0].load_factor, arch.limit, 1e-8, "limit load");
    const auto& contact = result.states.back().foundations[0].contact;
    ASSERT_EQ(contact.size(), 1u) << arch.G;
    EXPECT_NEAR(contact[0][0], arch.lift_off, 1e-5) << arch.G;
  }
}

/// solve_soundly() expects that the results' forces add up to nothing: results and equations integrate alike
/// where the normal turns within elements.
TEST(ArchOnPasternakGround, IsInBalanceOnACoarseMesh) {
  Model model = straight(2.0, 1.0, 1e4, "xyr", "xyr");
  model.members[0].curve = ArcCurve{-140.0};
  model.foundations = {one_sided("m", 200.0, Side::left)};
  model.foundations[0].shear_stiffness = 40.0;
  model.loads = {force_at(at_member("m", 0.4), 0.0, -5.0)};
  const Result result = solve_soundly(model, static_on(fixed_mesh(4, 3), Geometry::nonlinear));
  ASSERT_FALSE(result.states.empty());
  EXPECT_FALSE(result.states.back().foundations[0].contact.empty());
}

/// A pinned beam that its load lifts off the ground touches it at its ends alone, within rounding. The shear
/// forces there are q L / 2 and -q L / 2, however the beam is drawn.
TEST(LiftedBeamOnPasternakGround, HasTheShearForcesOfTheBeamAlone) {
  for (const bool reversed : {false, true}) {
    Model model = straight(6.0, 3000.0, 2e6, "xy", "y");
    if (reversed) std::swap(model.members[0].start, model.members[0].end);
    model.foundations = {one_sided("m", 800.0, reversed ? Side::left : Side::right)};
    model.foundations[0].shear_stiffness = 2000.0;
    model.loads = {DistributedLoad{"m", {0.0, 4.0}, {0.0, 1.0}, LoadMeasure::length, Pattern::proportional}};
    for (const Geometry geometry : {Geometry::linear, Geometry::nonlinear}) {
      const Result result = solve_soundly(model, static_on(fixed_mesh(8, 4), geometry));
      const std::vector<double> shear = member_of(result.states.at(0), "m").shear_force;
      // large displacements: cos of the slope, q L^3 / 24 EI = 0.012
      EXPECT_NEAR(std::abs(shear.front()), 12.0, 0.002) << reversed;
      EXPECT_NEAR(shear.back(), -shear.front(), 1e-8) << reversed;
    }
  }
}

}  // namespace
}  // namespace snapthrough
