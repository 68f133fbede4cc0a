#include "solver/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string_view>
#include <unordered_map>

#include "solver/mesh/member_actions.h"
#include "solver/numeric/rounding.h"
#include "solver/numeric/work_limit.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

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

/// Numbers of elements that a request gives to members.
class GivenCounts {
 public:
  explicit GivenCounts(const Discretization& given)
      : of_members_(given.member_elements.begin(), given.member_elements.end()), others_(given.elements) {}
  [[nodiscard]] int of(const Member& member) const {
    const auto found = of_members_.find(member.id);
    return found == of_members_.end() ? std::max(1, others_) : found->second;
  }
  /// @param members of a Model or of a ResolvedModel
  template <class AnyMember>
  [[nodiscard]] long long sum(const std::vector<AnyMember>& members) const {
    long long elements = 0;
    for (const AnyMember& member : members) elements += of(member);
    return elements;
  }

 private:
  std::unordered_map<std::string_view, int> of_members_;
  int others_;
};

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

/// Rule of make_mesh() for meshes that no request gives.
class MeshChoice {
 public:
  MeshChoice(const Discretization& discretization, MeshUse use)
      : rule_(use == MeshUse::first  ? MeshRules::first
              : use == MeshUse::path ? MeshRules::path
                                     : MeshRules::final) {
    const double enough = std::cbrt(1.0 / discretization.accuracy);
    const bool is_soft = is_checked(use) && !discretization.full_stiffness;
    finest_ = {is_soft ? enough : std::numeric_limits<double>::infinity(), enough};
  }
  /// Whether a mesh of this use is checked on finer ones.
  static bool is_checked(MeshUse use) { return use != MeshUse::final; }
  [[nodiscard]] const ChosenMesh& rule() const { return rule_; }

  /// Number of elements for each piece of a member between neighbouring `breaks`.
  [[nodiscard]] std::vector<int> counts(const MemberActions& actions, const AxisCurve& axis,
                                        const std::vector<double>& breaks) const {
    std::vector<int> out;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      out.push_back(count(actions, axis, breaks[i], breaks[i + 1]));
    return out;
  }

 private:
  [[nodiscard]] int count(const MemberActions& actions, const AxisCurve& axis, double from, double to) const {
    const double length = (to - from) * axis.length();
    const double turn = axis.turning(from * axis.length(), to * axis.length());
    const double turns = turn / (rule_.turn * std::numbers::pi / 180.0);
    const double coarse = std::max(MeshRules::first.least * (to - from), turns);
    double n = std::max(rule_.least * (to - from), turns);
    const AlongMember& EI = actions.section->EI;
    const double least_EI = std::min(EI.at(from), EI.at(to));
    for (const Foundation* foundation : actions.foundations) {
      const double stiffness = initial_stiffness(*foundation);
      if (stiffness <= 0.0 || foundation->range[1] <= from || foundation->range[0] >= to) continue;
      if (!std::isfinite(stiffness)) {
        n = std::max(n, finest_[1] * coarse);
        continue;
      }
      // bending decays along a tensioned member as it does where the rotation is resisted
      const double decay = foundation->component == FoundationComponent::rotation
                               ? std::sqrt(least_EI / stiffness)
                               : std::pow(4.0 * least_EI / stiffness, 0.25);
      const double layers = length / (rule_.decay_lengths * decay);
      const bool is_bounded = is_one_sided(*foundation) && !foundation->direction && !foundation->law;
      n = std::max(n, is_bounded ? std::min(layers, finest_[0] * coarse) : layers);
    }
    n = std::max(n, actions.imperfection_elements * (to - from));
    const int count = std::max(1, static_cast<int>(std::ceil(std::min(n, MeshRules::elements) - 1e-9)));
    return rule_.odd && count % 2 == 0 ? count + 1 : count;
  }

  const ChosenMesh& rule_;
  /// Bounds for one-sided and for rigid foundations, as multiples of the number for the axis.
  std::array<double, 2> finest_{};
};

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

/// Adds the elements of a member: those at `breaks` are halved towards them, down to the width `layer`.
void add_elements(std::vector<MeshElement>& out, int member, const std::vector<double>& breaks,
                  const std::vector<int>& counts, double layer) {
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = breaks[i + 1] - breaks[i];
    for (int e = 0; e < counts[i]; ++e) {
      const bool is_last = e + 1 == counts[i];
      const double from = breaks[i] + width * e / counts[i];
      const double to = is_last ? breaks[i + 1] : breaks[i] + width * (e + 1) / counts[i];
      add_layered(out, {member, from, to}, e == 0, is_last, layer);
    }
  }
}

/// Width of elements that resolve a boundary layer. @param decay its decay length over that of the member
double width_at_layer(double decay) {
  return std::max(MeshRules::layer_width, MeshRules::first.decay_lengths * decay);
}

/// Width of the elements at places of action on a member with a section: the share of the member on which a
/// bending law concentrates the curvature, see bending_decays(). Infinite without a law.
double layer_of(const Section& section) {
  if (!section.bending) return std::numeric_limits<double>::infinity();
  const BendingLaw& law = *section.bending;
  double softening = 1.0 + law.coefficient * law.exponent;  // k'(M) at M = law.moment, over that at M = 0
  if (law.type == BendingLaw::Type::table) {
    std::array<double, 2> before{0.0, 0.0};
    double stiffest = 0.0;
    double softest = std::numeric_limits<double>::infinity();
    for (const auto& point : law.points) {
      if (point[0] == 0.0) continue;
      const double slope = (point[1] - before[1]) / (point[0] - before[0]);
      if (stiffest == 0.0) stiffest = slope;
      softest = std::min(softest, slope);
      before = point;
    }
    softening = stiffest / softest;
  }
  return width_at_layer(1.0 / std::sqrt(softening));
}

}  // namespace

MeshUse mesh_use(const Analysis& analysis) {
  const AnalysisTraits kind = analysis.traits();
  if (kind.follows_path) return kind.reports_path ? MeshUse::path : MeshUse::first;
  // several buckling modes need many elements anyway
  const bool one_mode = kind.linearised && analysis.modes == 1;
  return one_mode ? MeshUse::first : MeshUse::final;
}

std::array<double, 2> part_of(const MeshElement& element, std::array<double, 2> range) {
  const double width = element.to - element.from;
  const double one = kOnePlace / width;
  const double lo = std::clamp((range[0] - element.from) / width, 0.0, 1.0);
  const double hi = std::clamp((range[1] - element.from) / width, 0.0, 1.0);
  return {lo < one ? 0.0 : lo, hi > 1.0 - one ? 1.0 : hi};
}

Mesh make_mesh(const ResolvedModel& model, const Discretization& discretization, const Axes& axes,
               MeshUse use) {
  const MeshChoice choice(discretization, use);
  const GivenCounts given(discretization);
  const std::vector<MemberActions> actions = actions_on_members(model);
  const bool is_given = discretization.fixed_mesh;
  Mesh mesh;
  mesh.order = is_given ? discretization.order : choice.rule().order;
  mesh.foundation = is_given ? discretization.foundation : FoundationRule::consistent;
  if (!is_given && MeshChoice::is_checked(use)) mesh.decay_lengths = choice.rule().decay_lengths;
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    mesh.first.push_back(static_cast<int>(mesh.elements.size()));
    std::vector<double> breaks = breaks_of(actions[m], *axes[m]);
    std::vector<int> counts;
    if (is_given) {
      const int n = given.of(model.members[m]);
      if (n < static_cast<int>(breaks.size()) - 1) breaks = {0.0, 1.0};
      counts = share(n, breaks);
    } else {
      counts = choice.counts(actions[m], *axes[m], breaks);
    }
    const double layer = is_given ? std::numeric_limits<double>::infinity() : layer_of(*actions[m].section);
    add_elements(mesh.elements, static_cast<int>(m), breaks, counts, layer);
  }
  mesh.first.push_back(static_cast<int>(mesh.elements.size()));
  return mesh;
}

long long given_elements(const std::vector<Member>& members, const Discretization& discretization) {
  return GivenCounts(discretization).sum(members);
}

MeshSize mesh_size(const ResolvedModel& model, const Discretization& discretization, MeshUse use) {
  if (discretization.fixed_mesh)
    return {GivenCounts(discretization).sum(model.members), discretization.order};
  const MeshChoice choice(discretization, use);
  const std::vector<MemberActions> actions = actions_on_members(model);
  MeshSize size{0, choice.rule().order};
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    WorkLimit::poll();
    const AxisCurve axis = axis_of(model, model.members[m]);
    const std::vector<double> breaks = breaks_of(actions[m], axis);
    std::vector<MeshElement> elements;
    add_elements(elements, 0, breaks, choice.counts(actions[m], axis, breaks), layer_of(*actions[m].section));
    size.elements += static_cast<long long>(elements.size());
  }
  return size;
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

Mesh moved_mesh(const Mesh& mesh, const ResolvedModel& model, const Axes& axes, const ResolvedModel& moved,
                const Axes& moved_axes) {
  Mesh out = mesh;
  const std::vector<MemberActions> actions = actions_on_members(model);
  const std::vector<MemberActions> moved_actions = actions_on_members(moved);
  for (std::size_t m = 0; m < axes.size(); ++m) {
    const std::vector<double> from = breaks_of(actions[m], *axes[m]);
    const std::vector<double> to = breaks_of(moved_actions[m], *moved_axes[m]);
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

Mesh layered_mesh(const Mesh& mesh, const ResolvedModel& model, const Axes& axes,
                  const std::vector<double>& decays) {
  Mesh out = mesh;
  out.elements.clear();
  const std::vector<MemberActions> actions = actions_on_members(model);
  for (std::size_t m = 0; m < axes.size(); ++m) {
    const std::vector<double> breaks = breaks_of(actions[m], *axes[m]);
    const auto is_break = [&breaks](double at) {
      return std::any_of(breaks.begin(), breaks.end(),
                         [at](double b) { return std::abs(at - b) <= kOnePlace; });
    };
    const double width = width_at_layer(decays[m] / axes[m]->length());
    for (int e = mesh.first[m]; e < mesh.first[m + 1]; ++e) {
      const MeshElement& element = mesh.elements[static_cast<std::size_t>(e)];
      add_layered(out.elements, element, is_break(element.from), is_break(element.to), width);
    }
    out.first[m + 1] = static_cast<int>(out.elements.size());
  }
  return out;
}

}  // namespace snapthrough
