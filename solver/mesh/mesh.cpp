#include "solver/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <variant>

#include "solver/model/id_index.h"
#include "solver/numeric/rounding.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

/// Adds the fractions inside a range at which a number of a law bends.
void add_breaks(const ReactionLaw& law, std::array<double, 2> range, std::vector<double>& at) {
  for (const AlongMember* value : {&law.stiffness, &law.capacity, &law.factor})
    for (const auto& [fraction, unused] : value->points)
      if (fraction > range[0] && fraction < range[1]) at.push_back(fraction);
}

/// Fractions at which elements must end, ascending, with 0 and 1.
std::vector<double> breaks_of(const Model& model, int member, const AxisCurve& axis) {
  const std::string& id = model.members[member].id;
  std::vector<double> at{0.0, 1.0};
  const auto add_location = [&](const Location& location) {
    if (location.member == id) at.push_back(location.fraction);
  };
  const auto add_kinks = [&at](const auto& along) {
    for (const auto& point : along) at.push_back(point.first);
  };
  for (const Spring& spring : model.springs) add_location(spring.at);
  for (const PointMass& mass : model.masses) add_location(mass.at);
  for (const Foundation& foundation : model.foundations) {
    if (foundation.member != id) continue;
    at.insert(at.end(), foundation.range.begin(), foundation.range.end());
    if (foundation.law) add_breaks(*foundation.law, foundation.range, at);
    for (const auto& [fraction, gap] : foundation.gap_along)
      if (fraction > foundation.range[0] && fraction < foundation.range[1]) at.push_back(fraction);
    if (!foundation.displacement) continue;
    add_kinks(foundation.displacement->x.points);
    add_kinks(foundation.displacement->y.points);
  }
  for (const Load& load : model.loads) {
    if (const auto* point = std::get_if<PointLoad>(&load)) add_location(point->at);
    const auto* distributed = std::get_if<DistributedLoad>(&load);
    if (distributed != nullptr && distributed->member == id) {
      at.insert(at.end(), distributed->range.begin(), distributed->range.end());
      add_kinks(distributed->force_along);
    }
    const auto* pressure = std::get_if<PressureLoad>(&load);
    if (pressure != nullptr && pressure->member == id) add_kinks(pressure->value_along);
    const auto* strain = std::get_if<InitialStrain>(&load);
    if (strain != nullptr && strain->member == id) {
      add_kinks(strain->axial_along);
      add_kinks(strain->curvature_along);
    }
    const auto* temperature = std::get_if<TemperatureLoad>(&load);
    if (temperature != nullptr && temperature->member == id) {
      add_kinks(temperature->change_along);
      add_kinks(temperature->gradient_along);
    }
  }
  const Section& section = model.sections[index_of(model.sections, model.members[member].section)];
  for (const AlongMember* value : {&section.EA, &section.EI}) add_kinks(value->points);
  for (const auto* value : {&section.GA, &section.mass, &section.rotary_inertia})
    if (*value) add_kinks((*value)->points);
  for (const double knot : axis.knots()) at.push_back(knot / axis.length());
  std::sort(at.begin(), at.end());
  std::vector<double> unique;
  for (const double fraction : at)
    if (unique.empty() || fraction - unique.back() > kOnePlace) unique.push_back(fraction);
  unique.back() = 1.0;
  return unique;
}

/// Distributes n elements over the pieces by largest element length, at least one each.
std::vector<int> share(int n, const std::vector<double>& breaks) {
  const std::size_t pieces = breaks.size() - 1;
  std::vector<int> counts(pieces, 1);
  int left = n - static_cast<int>(pieces);
  while (left > 0) {
    std::size_t longest = 0;
    double size = 0.0;
    for (std::size_t i = 0; i < pieces; ++i) {
      const double h = (breaks[i + 1] - breaks[i]) / counts[i];
      if (h > size * Rounding::first_of_equal) {
        size = h;
        longest = i;
      }
    }
    ++counts[longest];
    --left;
  }
  return counts;
}

int fixed_count(const Discretization& d, const std::string& member) {
  for (const auto& [id, n] : d.member_elements)
    if (id == member) return n;
  return std::max(1, d.elements);
}

/// Constants of the rule of make_mesh().
struct ChosenMesh {
  int order;
  double turn;           ///< rotation of the axis per element, degrees
  double decay_lengths;  ///< per element
  double least;          ///< least number of elements per member
  bool odd;              ///< odd numbers of elements per piece
};

/// Numbers of chosen meshes, a rule for each MeshUse. Source: work per digit; docs/theory.md, Stiff bases.
///
/// High orders on few elements need the least work per digit, also with contact ends inside elements.
/// Elements of a piece are equal, so that a ring keeps its symmetry and its bifurcations. Their number is
/// odd: an element of half a half-wave length buckles as a cantilever at the member's load, which costs most
/// digits in its elimination; 2 n equal elements per member have this defect in the n-th mode.
struct MeshRules {
  static constexpr ChosenMesh first{5, 60.0, kResolvedDecays, 3.0, true};
  static constexpr ChosenMesh path{5, 60.0, kResolvedDecays, 5.0, true};
  static constexpr ChosenMesh final{4, 25.0, 1.0, 8.0, false};
  static constexpr double elements = 4000;           ///< most elements of a piece, and of a refined mesh
  static constexpr double elements_per_member = 16;  ///< most elements over members, of models with many
  /// Least width of an element in a layer, fraction of a member: element ends then keep ten digits.
  static constexpr double layer_width = 1e-6;
};

/// Intervals of the spline through the offsets and the ends of the member.
double intervals_of(const PointsImperfection& points) {
  const int ends = (points.offsets.front()[0] > 0.0 ? 1 : 0) + (points.offsets.back()[0] < 1.0 ? 1 : 0);
  return static_cast<double>(points.offsets.size()) - 1.0 + ends;
}

/// Number of elements of a piece of a member, by the rule of make_mesh().
/// @param finest bounds for one-sided and for rigid foundations, as multiples of the number for the axis
int default_count(const ChosenMesh& rule, const Model& model, int member, const AxisCurve& axis, double from,
                  double to, std::array<double, 2> finest) {
  const Member& m = model.members[member];
  const double length = (to - from) * axis.length();
  const double turn = axis.turning(from * axis.length(), to * axis.length());
  const double turns = turn / (rule.turn * std::numbers::pi / 180.0);
  const double coarse = std::max(MeshRules::first.least * (to - from), turns);
  double n = std::max(rule.least * (to - from), turns);
  const AlongMember& EI = model.sections[index_of(model.sections, m.section)].EI;
  const double least_EI = std::min(EI.at(from), EI.at(to));
  for (const Foundation& foundation : model.foundations) {
    if (foundation.member != m.id || initial_stiffness(foundation) <= 0.0 || foundation.range[1] <= from ||
        foundation.range[0] >= to)
      continue;
    const double stiffness = initial_stiffness(foundation);
    if (!std::isfinite(stiffness)) {
      n = std::max(n, finest[1] * coarse);
      continue;
    }
    const double layers = length / (rule.decay_lengths * std::pow(4.0 * least_EI / stiffness, 0.25));
    const bool is_bounded = is_one_sided(foundation) && !foundation.direction && !foundation.law;
    n = std::max(n, is_bounded ? std::min(layers, finest[0] * coarse) : layers);
  }
  for (const Imperfection& imperfection : model.imperfections) {
    const auto* sine = std::get_if<SineImperfection>(&imperfection);
    if (sine != nullptr && sine->member == m.id) n = std::max(n, 2.0 * sine->half_waves * (to - from));
    // A mesh coarser than the intervals has another imperfection, and its path may turn to the other side.
    const auto* points = std::get_if<PointsImperfection>(&imperfection);
    if (points != nullptr && points->member == m.id) n = std::max(n, intervals_of(*points) * (to - from));
  }
  const int count = std::max(1, static_cast<int>(std::ceil(std::min(n, MeshRules::elements) - 1e-9)));
  return rule.odd && count % 2 == 0 ? count + 1 : count;
}

void add_elements(Mesh& mesh, int member, const std::vector<double>& breaks, const std::vector<int>& counts) {
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = breaks[i + 1] - breaks[i];
    for (int e = 0; e < counts[i]; ++e) {
      const double from = breaks[i] + width * e / counts[i];
      const double to = e + 1 == counts[i] ? breaks[i + 1] : breaks[i] + width * (e + 1) / counts[i];
      mesh.elements.push_back({member, from, to});
    }
  }
}

/// Halves an element towards its ends at places of action, down to a width.
void add_layered(std::vector<MeshElement>& out, const MeshElement& element, bool at_start, bool at_end,
                 double width) {
  const double middle = 0.5 * (element.from + element.to);
  if (!(at_start || at_end) || element.to - element.from <= width) {
    out.push_back(element);
    return;
  }
  add_layered(out, {element.member, element.from, middle}, at_start, false, width);
  add_layered(out, {element.member, middle, element.to}, false, at_end, width);
}

}  // namespace

MeshUse mesh_use(const Analysis& analysis) {
  if (analysis.type == AnalysisType::critical) return MeshUse::first;
  if (analysis.type == AnalysisType::path) return MeshUse::path;
  // several buckling modes need many elements anyway
  const bool one_mode = analysis.type == AnalysisType::buckling && analysis.modes == 1;
  return one_mode ? MeshUse::first : MeshUse::final;
}

std::array<double, 2> part_of(const MeshElement& element, std::array<double, 2> range) {
  const double width = element.to - element.from;
  const double one = kOnePlace / width;
  const double lo = std::clamp((range[0] - element.from) / width, 0.0, 1.0);
  const double hi = std::clamp((range[1] - element.from) / width, 0.0, 1.0);
  return {lo < one ? 0.0 : lo, hi > 1.0 - one ? 1.0 : hi};
}

Mesh make_mesh(const Model& model, const Discretization& discretization, const Axes& axes, MeshUse use) {
  const ChosenMesh& rule = use == MeshUse::first  ? MeshRules::first
                           : use == MeshUse::path ? MeshRules::path
                                                  : MeshRules::final;
  Mesh mesh;
  mesh.order = discretization.fixed_mesh ? discretization.order : rule.order;
  mesh.foundation = discretization.fixed_mesh ? discretization.foundation : FoundationRule::consistent;
  const bool is_checked = !discretization.fixed_mesh && use != MeshUse::final;
  if (is_checked) mesh.decay_lengths = rule.decay_lengths;
  const double enough = std::cbrt(1.0 / discretization.accuracy);
  const bool is_soft = is_checked && !discretization.full_stiffness;
  const std::array finest{is_soft ? enough : std::numeric_limits<double>::infinity(), enough};
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const int member = static_cast<int>(m);
    mesh.first.push_back(static_cast<int>(mesh.elements.size()));
    std::vector<double> breaks = breaks_of(model, member, *axes[m]);
    std::vector<int> counts;
    if (discretization.fixed_mesh) {
      const int n = fixed_count(discretization, model.members[m].id);
      if (n < static_cast<int>(breaks.size()) - 1) breaks = {0.0, 1.0};
      counts = share(n, breaks);
    } else {
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
        counts.push_back(default_count(rule, model, member, *axes[m], breaks[i], breaks[i + 1], finest));
    }
    add_elements(mesh, member, breaks, counts);
  }
  mesh.first.push_back(static_cast<int>(mesh.elements.size()));
  return mesh;
}

std::optional<Mesh> finer_mesh(const Mesh& mesh) {
  const double most = std::max(MeshRules::elements,
                               MeshRules::elements_per_member * static_cast<double>(mesh.first.size() - 1));
  if (2.0 * static_cast<double>(mesh.elements.size()) > most) return std::nullopt;
  Mesh out = mesh;
  out.foundation = FoundationRule::consistent;
  out.elements.clear();
  for (const MeshElement& e : mesh.elements) {
    const double middle = 0.5 * (e.from + e.to);
    out.elements.push_back({e.member, e.from, middle});
    out.elements.push_back({e.member, middle, e.to});
  }
  for (int& first : out.first) first *= 2;
  return out;
}

Mesh moved_mesh(const Mesh& mesh, const Model& model, const Axes& axes, const Model& moved,
                const Axes& moved_axes) {
  Mesh out = mesh;
  for (std::size_t m = 0; m < axes.size(); ++m) {
    const std::vector<double> from = breaks_of(model, static_cast<int>(m), *axes[m]);
    const std::vector<double> to = breaks_of(moved, static_cast<int>(m), *moved_axes[m]);
    const auto first = mesh.elements.begin() + mesh.first[m];
    const auto last = mesh.elements.begin() + mesh.first[m + 1];
    const auto is_end = [&](double at) {
      return std::any_of(first, last,
                         [at](const MeshElement& e) { return std::abs(e.to - at) <= kOnePlace; });
    };
    if (from == to || from.size() != to.size() || !std::all_of(from.begin() + 1, from.end(), is_end))
      continue;
    const auto place = [&](double at) {
      std::size_t i = 1;
      while (i + 1 < from.size() && at > from[i]) ++i;
      const double share = (at - from[i - 1]) / (from[i] - from[i - 1]);
      return share == 1.0 ? to[i] : to[i - 1] + share * (to[i] - to[i - 1]);
    };
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) {
      MeshElement& element = out.elements[static_cast<std::size_t>(e)];
      element.from = place(element.from);
      element.to = place(element.to);
    }
  }
  return out;
}

Mesh layered_mesh(const Mesh& mesh, const Model& model, const Axes& axes, const std::vector<double>& decays) {
  Mesh out = mesh;
  out.elements.clear();
  for (std::size_t m = 0; m < axes.size(); ++m) {
    const std::vector<double> breaks = breaks_of(model, static_cast<int>(m), *axes[m]);
    const auto is_break = [&breaks](double at) {
      return std::any_of(breaks.begin(), breaks.end(),
                         [at](double b) { return std::abs(at - b) <= kOnePlace; });
    };
    const double width =
        std::max(MeshRules::layer_width, MeshRules::first.decay_lengths * decays[m] / axes[m]->length());
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) {
      const MeshElement& element = mesh.elements[static_cast<std::size_t>(e)];
      add_layered(out.elements, element, is_break(element.from), is_break(element.to), width);
    }
    out.first[m + 1] = static_cast<int>(out.elements.size());
  }
  return out;
}

}  // namespace snapthrough
