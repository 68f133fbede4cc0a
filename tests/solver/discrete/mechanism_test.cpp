/// Motions without strain, against the null space of a dense matrix that has unknowns for every node and
/// every member; and structures too large for anything but sparse matrices.
#include "solver/discrete/mechanism.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "solver/discrete/free_motions.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough {
namespace {

std::string node_id(int i) { return "n" + std::to_string(i); }

void add_member(Model& model, int start, int end, bool release_start, bool release_end) {
  model.members.push_back({"m" + std::to_string(model.members.size()), node_id(start), node_id(end), "s",
                           LineCurve{}, release_start, release_end});
}

void add_support(Model& model, int node, bool x, bool y, bool rotation, double angle = 0.0) {
  model.supports.push_back({node_id(node), x, y, rotation, angle, {}});
}

void add_force(Model& model, int node, double x, double y) {
  PointLoad load;
  load.at.node = node_id(node);
  load.force = {x, y};
  model.loads.push_back(load);
}

Model empty_model(double EA = 1e6, double EI = 100.0) {
  Model model;
  model.sections.push_back({"s", EA, EI, {}});
  return model;
}

/// A tree of members with some more between its nodes, at random or on a grid, so that some hinges are in
/// line.
Model random_frame(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto fraction = [&random] { return static_cast<double>(random() % 65536) / 65536.0; };
  Model model = empty_model(std::pow(10.0, 12.0 * fraction()), std::pow(10.0, -6.0 * fraction()));
  const int nodes = 2 + below(12);
  const bool grid = below(2) == 0;
  for (int i = 0; i < nodes; ++i)
    model.nodes.push_back({node_id(i), grid ? i % 4 : 5.0 * fraction(), grid ? i / 4 : 5.0 * fraction()});
  const int released = 45 * below(3);  // per cent
  const auto member = [&](int a, int b) {
    add_member(model, a, b, below(100) < released, below(100) < released);
  };
  for (int i = 1; i < nodes; ++i) member(i, below(i));
  for (int more = below(nodes + 4); more > 0; --more) {
    const int a = below(nodes);
    const int b = below(nodes);
    if (a != b) member(a, b);
  }
  for (int i = 0; i < nodes; ++i)
    if (below(4) == 0)
      add_support(model, i, below(2) == 0, true, below(6) == 0, below(2) == 0 ? 0.0 : 90.0 * fraction());
  for (int more = below(3); more > 0; --more) {
    Spring spring;
    spring.id = "q" + std::to_string(more);
    spring.at.node = node_id(below(nodes));
    if (below(4) != 0) spring.direction = {{fraction(), fraction() + 0.1}};
    spring.stiffness = std::pow(10.0, 12.0 * fraction() - 6.0);
    model.springs.push_back(spring);
  }
  add_force(model, below(nodes), fraction(), below(2) == 0 ? 0.0 : fraction());
  return model;
}

int position(const Model& model, const std::string& id) {
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].id == id) return static_cast<int>(i);
  return -1;
}

/// Rows over (x, y, rotation) of each node, then of each member at its start.
class DenseRows {
 public:
  explicit DenseRows(const Model& model)
      : columns_(3 * static_cast<int>(model.nodes.size() + model.members.size())) {
    std::vector<char> turned(model.nodes.size(), 0);
    for (std::size_t m = 0; m < model.members.size(); ++m)
      join(model, model.members[m], 3 * static_cast<int>(model.nodes.size() + m), turned);
    for (const Support& support : model.supports) {
      const int n = position(model, support.node);
      const double c = std::cos(support.angle_degrees * std::numbers::pi / 180.0);
      const double s = std::sin(support.angle_degrees * std::numbers::pi / 180.0);
      if (support.x) add({{3 * n, c}, {3 * n + 1, s}});
      if (support.y) add({{3 * n, -s}, {3 * n + 1, c}});
      if (support.rotation) add({{3 * n + 2, 1.0}});
    }
    for (const Spring& spring : model.springs) {
      const int n = position(model, spring.at.node);
      if (spring.direction)
        add({{3 * n, (*spring.direction)[0]}, {3 * n + 1, (*spring.direction)[1]}});
      else
        add({{3 * n + 2, 1.0}});
    }
    for (std::size_t n = 0; n < turned.size(); ++n)
      if (turned[n] == 0) add({{3 * static_cast<int>(n) + 2, 1.0}});
  }
  /// Orthonormal columns.
  [[nodiscard]] Eigen::MatrixXd null_space() const {
    Eigen::MatrixXd rows =
        Eigen::MatrixXd::Zero(std::max<int>(static_cast<int>(rows_.size()), columns_), columns_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (const auto& [column, value] : rows_[i]) rows(static_cast<int>(i), column) += value;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
    Eigen::Index rank = 0;
    while (rank < columns_ && svd.singularValues()[rank] > 1e-9) ++rank;
    return svd.matrixV().rightCols(columns_ - rank);
  }

 private:
  using Row = std::vector<std::pair<int, double>>;
  void add(const Row& row) { rows_.push_back(row); }
  void join(const Model& model, const Member& member, int own, std::vector<char>& turned) {
    const int a = position(model, member.start);
    const int b = position(model, member.end);
    const double dx = model.nodes[b].x - model.nodes[a].x;
    const double dy = model.nodes[b].y - model.nodes[a].y;
    add({{3 * a, 1.0}, {own, -1.0}});
    add({{3 * a + 1, 1.0}, {own + 1, -1.0}});
    add({{3 * b, 1.0}, {own, -1.0}, {own + 2, dy}});
    add({{3 * b + 1, 1.0}, {own + 1, -1.0}, {own + 2, -dx}});
    if (!member.release_start_rotation) add({{3 * a + 2, 1.0}, {own + 2, -1.0}});
    if (!member.release_end_rotation) add({{3 * b + 2, 1.0}, {own + 2, -1.0}});
    if (!member.release_start_rotation) turned[a] = 1;
    if (!member.release_end_rotation) turned[b] = 1;
  }

  int columns_;
  std::vector<Row> rows_;
};

TEST(Mechanism, IsWhatADenseMatrixOfAllNodesAndMembersSays) {
  int held = 0;
  int driven = 0;
  int neutral = 0;
  for (unsigned seed = 1; seed <= 500; ++seed) {
    const Model model = random_frame(seed);
    const Eigen::MatrixXd motions = DenseRows(model).null_space();
    const auto& load = std::get<PointLoad>(model.loads.front());
    const int n = position(model, load.at.node);
    const bool works =
        motions.cols() > 0 &&
        (load.force[0] * motions.row(3 * n) + load.force[1] * motions.row(3 * n + 1)).norm() > 1e-8;
    EXPECT_EQ(free_motions(resolve(model)).cols(), std::min<Eigen::Index>(motions.cols(), 24))
        << "seed " << seed;
    EXPECT_EQ(can_move(resolve(model)), motions.cols() > 0) << "seed " << seed;
    EXPECT_EQ(!find_mechanism(resolve(model)).empty(), works || motions.cols() >= 24) << "seed " << seed;
    (motions.cols() == 0 ? held : works ? driven : neutral) += 1;
  }
  EXPECT_GT(held, 50);
  EXPECT_GT(driven, 50);
  EXPECT_GT(neutral, 20);
}

TEST(Mechanism, MotionsAreOrthonormalOverTheJoints) {
  Model model = empty_model();
  for (int i = 0; i < 7; ++i) model.nodes.push_back({node_id(i), 2.0 * i, 0.3 * (i % 2)});
  for (int i = 0; i < 6; ++i) add_member(model, i, i + 1, i % 2 == 0, false);
  add_support(model, 0, true, true, false);
  const Eigen::MatrixXd motions = free_motions(resolve(model));
  ASSERT_GT(motions.cols(), 1);
  ASSERT_EQ(motions.rows(), 21);
  EXPECT_LT(
      (motions.transpose() * motions - Eigen::MatrixXd::Identity(motions.cols(), motions.cols())).norm(),
      1e-12);
}

// --- structures of thousands of members: a dense matrix of their joints would take gigabytes

/// Members end to end along a zigzag.
Model chain(int members, bool hinged) {
  Model model = empty_model();
  for (int i = 0; i <= members; ++i) model.nodes.push_back({node_id(i), 1.0 * i, 0.1 * (i % 2)});
  for (int i = 0; i < members; ++i) add_member(model, i, i + 1, hinged, hinged);
  add_force(model, members, 0.0, -1.0);
  return model;
}

/// A cantilever of bars: squares with one diagonal, held at its left end.
Model truss(int bays) {
  Model model = empty_model();
  for (int i = 0; i <= bays; ++i)
    for (int j = 0; j < 2; ++j) model.nodes.push_back({node_id(2 * i + j), 1.0 * i, 1.0 * j});
  const auto bar = [&model](int a, int b) { add_member(model, a, b, true, true); };
  bar(0, 1);
  for (int i = 0; i < bays; ++i) {
    bar(2 * i, 2 * i + 2);
    bar(2 * i + 1, 2 * i + 3);
    bar(2 * i, 2 * i + 3);
    bar(2 * i + 2, 2 * i + 3);
  }
  add_support(model, 0, true, true, false);
  add_support(model, 1, true, false, false);
  add_force(model, 2 * bays, 0.0, -1.0);
  return model;
}

TEST(LargeMechanism, LongCantileverIsNone) {
  Model model = chain(5000, false);
  add_support(model, 0, true, true, true);
  EXPECT_FALSE(can_move(resolve(model)));
  model.supports[0].rotation = false;
  ASSERT_EQ(find_mechanism(resolve(model)).size(), 1U);
  EXPECT_NE(find_mechanism(resolve(model))[0].detail.find("\"" + node_id(5000) + "\""), std::string::npos);
}

TEST(LargeMechanism, HeldWhereItSlidesAlongRollersOnly) {
  Model model = chain(3000, false);
  for (int i = 0; i <= 3000; i += 2) add_support(model, i, false, true, false);
  EXPECT_TRUE(can_move(resolve(model)));
  EXPECT_TRUE(find_mechanism(resolve(model)).empty()) << "no load acts along the rollers";
  add_force(model, 1500, 1.0, 0.0);
  EXPECT_EQ(find_mechanism(resolve(model)).size(), 1U);
  add_force(model, 7, -1.0, 0.0);
  EXPECT_TRUE(find_mechanism(resolve(model)).empty()) << "the loads balance";
  add_support(model, 3, true, false, false);
  EXPECT_FALSE(can_move(resolve(model)));
}

TEST(LargeMechanism, HingedChainHasMoreMotionsThanCanBeHeld) {
  Model model = chain(2500, true);
  add_support(model, 0, true, true, false);
  add_support(model, 2500, true, true, false);
  ASSERT_EQ(find_mechanism(resolve(model)).size(), 1U);
  EXPECT_NE(find_mechanism(resolve(model))[0].detail.find("at least 24"), std::string::npos);
}

TEST(LargeMechanism, TrussesAreHeldAndMissOneBar) {
  for (const int bays : {50, 600, 2000}) {
    Model model = truss(bays);
    EXPECT_FALSE(can_move(resolve(model))) << bays;
    model.members.erase(model.members.begin() + 4 * (bays / 2) + 3);  // a diagonal
    EXPECT_EQ(free_motions(resolve(model)).cols(), 1) << bays;
    EXPECT_EQ(find_mechanism(resolve(model)).size(), 1U) << bays;
    std::get<PointLoad>(model.loads[0]).force = {1.0, 0.0};
    EXPECT_TRUE(find_mechanism(resolve(model)).empty()) << bays;
  }
}

/// Bars between any nodes: the factor of 19 000 took 27 s and 214 MB.
TEST(LargeMechanism, BarsBetweenAnyNodesAreRefusedBeforeTheyTakeLong) {
  std::mt19937 random(1);
  constexpr int kNodes = 6000;
  Model model = empty_model();
  for (int i = 0; i < kNodes; ++i)
    model.nodes.push_back({node_id(i), 1e-3 * static_cast<double>(random() % 100000), 1e-3 * i});
  for (int i = 1; i < 3 * kNodes; ++i) {
    const int a = i < kNodes ? i : static_cast<int>(random() % kNodes);
    const int b = static_cast<int>(random() % kNodes);
    if (a != b) add_member(model, a, b, true, true);
  }
  add_support(model, 0, true, true, false);
  add_support(model, kNodes - 1, true, true, false);
  add_force(model, kNodes / 2, 1.0, 0.0);
  const auto findings = find_mechanism(resolve(model));
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].code, "too_connected");
}

TEST(LargeMechanism, BeamWithAHingeInEachSpan) {
  constexpr int kMembers = 3000;
  Model model = chain(kMembers, false);
  for (int i = 0; i <= kMembers; i += 2) add_support(model, i, i == 0, true, false);
  EXPECT_FALSE(can_move(resolve(model)));
  for (int i = 3; i < kMembers; i += 4) model.members[i].release_start_rotation = true;
  EXPECT_FALSE(can_move(resolve(model))) << "hinges in every other span";
  for (int i = 3; i < kMembers; i += 2) model.members[i].release_start_rotation = true;
  EXPECT_EQ(free_motions(resolve(model)).cols(), 0) << "held by the first span, body by body";
  model.members[1].release_start_rotation = true;
  EXPECT_EQ(free_motions(resolve(model)).cols(), 1);
}

TEST(LargeMechanism, FoundationsAndSpringsByTheThousand) {
  Model model = chain(2, false);
  for (int i = 0; i < 20000; ++i) {
    Foundation base;
    base.id = "f" + std::to_string(i);
    base.member = "m0";
    base.stiffness = 1.0;
    base.range = {i / 40000.0, 0.5 + i / 40000.0};
    model.foundations.push_back(base);
  }
  EXPECT_TRUE(can_move(resolve(model))) << "along the member";
  Spring spring;
  spring.id = "q";
  spring.at.member = "m1";
  spring.at.fraction = 0.25;
  spring.direction = {{1.0, 0.0}};
  spring.stiffness = 1e-9;
  model.springs.push_back(spring);
  EXPECT_FALSE(can_move(resolve(model)));
}

// --- what single supports and loads do

TEST(Mechanism, BaseOnAnArcLetsItTurnAboutItsCentre) {
  Model model = empty_model();
  model.nodes = {{node_id(0), 0.0, 0.0}, {node_id(1), 2.0, 0.0}};
  add_member(model, 0, 1, false, false);
  model.members[0].curve = ArcCurve{120.0};
  Foundation base;
  base.id = "f";
  base.member = "m0";
  base.stiffness = 1.0;
  model.foundations.push_back(base);
  EXPECT_EQ(free_motions(resolve(model)).cols(), 1);
  PressureLoad pressure;
  pressure.member = "m0";
  pressure.value = 1.0;
  model.loads.push_back(pressure);
  EXPECT_TRUE(find_mechanism(resolve(model)).empty()) << "pressure goes through the centre";
  add_force(model, 1, 0.0, 1.0);
  EXPECT_EQ(find_mechanism(resolve(model)).size(), 1U);
  model.foundations[0].direction = {{0.0, 1.0}};
  EXPECT_EQ(free_motions(resolve(model)).cols(), 1) << "slides across the direction of the base";
  model.members[0].curve = ParabolaCurve{0.5};
  model.foundations[0].direction.reset();
  EXPECT_EQ(free_motions(resolve(model)).cols(), 0) << "no other curve has a centre";
}

TEST(Mechanism, PressureOnAClosedRingDrivesNothing) {
  Model model = empty_model();
  model.nodes = {{node_id(0), -1.0, 0.0}, {node_id(1), 1.0, 0.0}};
  for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 0}}) {
    add_member(model, a, b, false, false);
    model.members.back().curve = ArcCurve{180.0};
    PressureLoad pressure;
    pressure.member = model.members.back().id;
    pressure.value = 1.0;
    model.loads.push_back(pressure);
  }
  EXPECT_EQ(free_motions(resolve(model)).cols(), 3);
  EXPECT_TRUE(find_mechanism(resolve(model)).empty());
  model.loads.pop_back();
  EXPECT_EQ(find_mechanism(resolve(model)).size(), 1U);
}

TEST(Mechanism, LoadAlongATurnedRollerIsNoWork) {
  Model model = empty_model();
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  model.nodes = {{node_id(0), 0.0, 0.0}, {node_id(1), 2.0 * c, 2.0 * s}};
  add_member(model, 0, 1, false, false);
  add_support(model, 0, true, true, false);
  add_support(model, 1, true, false, false, 0.3 * 180.0 / std::numbers::pi);
  add_force(model, 1, 5.0 * c, 5.0 * s);
  EXPECT_TRUE(can_move(resolve(model))) << "about the first node";
  EXPECT_TRUE(find_mechanism(resolve(model)).empty());
  add_force(model, 1, -s, c);
  EXPECT_EQ(find_mechanism(resolve(model)).size(), 1U);
}

}  // namespace
}  // namespace snapthrough
