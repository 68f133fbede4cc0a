#include "bench/cases.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/solver/structures.h"

namespace snapthrough::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kShallowLength = 100.0 * 20.0 * kPi / 180.0;  // of the shallow arch's axis

Analysis first_limit_point() {
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.stop.limit_points = 1;
  analysis.output.states = StateOutput::none;
  return analysis;
}

Analysis first_loss_of_stability() {
  Analysis analysis;
  analysis.type = AnalysisType::critical;
  analysis.output.states = StateOutput::none;
  return analysis;
}

Case column_on_base() {
  constexpr double kBase = 100.0;
  Case out{"column", testing::column(1.0, 1.0, 1e14, kBase), first_loss_of_stability(),
           kPi * kPi + kBase / (kPi * kPi), 0.0};
  return out;
}

Case shallow_arch(const std::string& name, double k, double load, double target) {
  Case out{name, testing::arch(20.0, 420.0, 1.4), first_limit_point(), load, target};
  if (k > 0.0) testing::add_soil(out.model, k);
  return out;
}

/// Half a ring in a medium outside, under its weight.
Case ring(const std::string& name, double k, double load, double target) {
  return {name, testing::half_ring_in_medium(k, 36e6), first_limit_point(), load, target};
}

/// Four short steps: the path ends far below the first critical load.
Analysis four_steps(int elements, int order) {
  constexpr int kSteps = 4;
  constexpr double kLargestStep = 0.02;  // of the scale of the first critical load
  Analysis analysis;
  analysis.type = AnalysisType::path;
  analysis.stop.steps = kSteps;
  analysis.step.max = kLargestStep;
  analysis.output.states = StateOutput::none;
  analysis.discretization = testing::fixed_mesh(elements, order);
  return analysis;
}

constexpr int kGrowingOrder = 3;

/// Rigid frame with clamped feet, bays of 6 and storeys of 4, a load down and a smaller one along on each
/// joint.
Model rigid_frame(int bays, int storeys) {
  Model model;
  model.sections = {{"s", 1.5e6, 2e4, {}}};
  const auto name = [](int column, int floor) {
    return "n" + std::to_string(column) + "_" + std::to_string(floor);
  };
  const auto add_member = [&model](const std::string& id, const std::string& start, const std::string& end) {
    Member member;
    member.id = id;
    member.start = start;
    member.end = end;
    member.section = "s";
    model.members.push_back(member);
  };
  for (int floor = 0; floor <= storeys; ++floor) {
    for (int column = 0; column <= bays; ++column) {
      const std::string joint = name(column, floor);
      model.nodes.push_back({joint, 6.0 * column, 4.0 * floor});
      if (floor == 0) {
        model.supports.push_back({joint, true, true, true, 0.0, {}});
        continue;
      }
      add_member("c" + joint, name(column, floor - 1), joint);
      if (column > 0) add_member("b" + joint, name(column - 1, floor), joint);
      model.loads.emplace_back(PointLoad{{joint, "", 0.0}, {1.0, -100.0}, 0.0, Pattern::proportional});
    }
  }
  return model;
}

/// Lee's frame, inextensible.
Case frame() { return {"frame", testing::lee_frame(4.32e17), first_limit_point(), 18.55874653948, 0.0}; }

}  // namespace

std::vector<Case> cases() {
  return {column_on_base(),
          shallow_arch("shallow_arch", 0.0, 76.1493461733, 1.0),
          shallow_arch("shallow_arch_k1e7", 1e7, 93.1178142194, 1.5),
          shallow_arch("shallow_arch_k1e9", 1e9, 102.9341234421, 3.0),
          Case{"deep_arch", testing::arch(215.0, 1e8, 1e6, true), first_limit_point(), 8.97294947594, 2.0},
          ring("ring_k1200", 1200.0, 13.626899644, 1.5),
          ring("ring_k180000", 180000.0, 65.729726832, 4.0),
          frame()};
}

Case case_named(const std::string& name) {
  if (name == "column_with_spring") return column_with_spring();
  for (Case& c : cases())
    if (c.name == name) return c;
  throw std::invalid_argument("no case " + name);
}

Case growing_arch(int elements, int order) {
  Case out = shallow_arch("growing_arch", 0.0, 0.0, 0.0);
  out.analysis = four_steps(elements, order);
  return out;
}

Case growing_bays(int members) {
  constexpr int kStoreys = 2;
  int bays = 1;
  while (kStoreys * (2 * bays + 1) < members) ++bays;
  return {"growing_bays", rigid_frame(bays, kStoreys), four_steps(1, kGrowingOrder), 0.0, 0.0};
}

Case growing_square(int members) {
  int bays = 1;
  while (bays * (2 * bays + 1) < members) ++bays;
  return {"growing_square", rigid_frame(bays, bays), four_steps(1, kGrowingOrder), 0.0, 0.0};
}

Case growing_bases(int bases) {
  Case out = arch_on_pieces(bases);
  out.name = "growing_bases";
  out.analysis = four_steps(bases, kGrowingOrder);
  return out;
}

Case growing_springs(int springs) {
  Case out = growing_bases(springs);
  out.name = "growing_springs";
  const double whole = out.model.foundations.front().stiffness * kShallowLength;
  for (int i = 0; i < springs; ++i) {
    Spring spring;
    spring.id = "spring" + std::to_string(i);
    spring.at = {"", "arch", (i + 0.5) / springs};
    spring.direction = std::array<double, 2>{0.0, 1.0};
    spring.stiffness = whole / springs;
    spring.reaction = Reaction::compression_only;
    out.model.springs.push_back(spring);
  }
  out.model.foundations.clear();
  return out;
}

Case growing_case(const std::string& name, int size) {
  if (name == "bays") return growing_bays(size);
  if (name == "square") return growing_square(size);
  if (name == "bases") return growing_bases(size);
  if (name == "springs") return growing_springs(size);
  const std::string elements = "elements";
  if (name.rfind(elements, 0) != 0) throw std::invalid_argument("nothing grows by " + name);
  return growing_arch(size, name == elements ? 1 : std::stoi(name.substr(elements.size())));
}

Case arch_on_pieces(int pieces) {
  Case out = shallow_arch("arch_on_pieces", 1e6, 0.0, 0.0);
  const Foundation whole = out.model.foundations.front();
  out.model.foundations.clear();
  for (int i = 0; i < pieces; ++i) {
    Foundation piece = whole;
    piece.id = "soil" + std::to_string(i);
    piece.range = {static_cast<double>(i) / pieces, static_cast<double>(i + 1) / pieces};
    out.model.foundations.push_back(piece);
  }
  return out;
}

Case column_with_spring() {
  constexpr double kStiffness = 100.0;
  constexpr double kHalf = 0.5;
  // symmetric mode A sin(a x) + B x of each half: k (l - tan(a l) / a) = 2 P, a^2 = P / EI
  double low = 0.51 * kPi / kHalf;
  double high = 0.99 * kPi / kHalf;
  for (int i = 0; i < 200; ++i) {
    const double a = 0.5 * (low + high);
    (kStiffness * (kHalf - std::tan(a * kHalf) / a) > 2.0 * a * a ? low : high) = a;
  }
  Case out{"column_with_spring", testing::column(1.0, 1.0, 1e14, 0.0), {}, low * low, 0.06};
  out.analysis.type = AnalysisType::buckling;
  out.analysis.output.points_per_member = 2;
  out.model.monitors.clear();
  Spring spring;
  spring.id = "spring";
  spring.at = {"", "column", 0.5};
  spring.direction = std::array<double, 2>{0.0, 1.0};
  spring.stiffness = kStiffness;
  out.model.springs = {spring};
  return out;
}

}  // namespace snapthrough::bench
