#include "solver/support/joined_supports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "solver/geometry/axes.h"
#include "solver/numeric/rounding.h"
#include "solver/support/law.h"

namespace snapthrough {
namespace {

using Vec2 = std::array<double, 2>;

/// 1: same direction; -1: opposite directions; 0: different lines of action.
double agreement(const Direction& a, const Direction& b) {
  if (a.turns != b.turns) return 0.0;
  if (a.turns) return a.sign * b.sign;
  if (std::abs(a.fixed[0] * b.fixed[1] - a.fixed[1] * b.fixed[0]) > Rounding::parallel) return 0.0;
  return a.fixed[0] * b.fixed[0] + a.fixed[1] * b.fixed[1] > 0.0 ? 1.0 : -1.0;
}

/// Direction of action of a spring; for a rotational spring a turning direction with the spring's sign.
Direction action_of(const ResolvedSpring& spring) {
  const double sense = sense_of(spring.reaction);
  return spring.direction ? fixed_direction(*spring.direction, sense) : Direction{true, {}, sense};
}

/// Direction of action of a foundation; a fixed one on straight axes, for comparison with given directions.
Direction action_of(const ResolvedModel& model, const ResolvedMember& member,
                    const ResolvedFoundation& foundation) {
  const Direction direction = direction_of(foundation);
  if (!direction.turns || !std::holds_alternative<LineCurve>(member.curve)) return direction;
  const Node& a = model.nodes[member.start];
  const Node& b = model.nodes[member.end];
  return fixed_direction({-(b.y - a.y), b.x - a.x}, direction.sign);
}

/// One-sided support without gap, with its index in the model.
struct Touching {
  std::size_t number = 0;
  double stiffness = 0.0;
  Direction action;
};

/// Sum of supports at one place with one line of action.
struct JoinedLaw {
  std::vector<std::size_t> members;  ///< indices in the list of summed supports
  std::size_t against = 0;           ///< index of the first support in the opposite direction
  double with_first = 0.0;
  double against_first = 0.0;

  [[nodiscard]] bool is_joined() const { return against_first > 0.0; }
  [[nodiscard]] double bilateral() const { return std::min(with_first, against_first); }
  /// Difference of both sums; zero within rounding.
  [[nodiscard]] double rest() const {
    const double rounding = static_cast<double>(members.size()) * std::numeric_limits<double>::epsilon();
    const double more = std::abs(with_first - against_first);
    return more > rounding * (with_first + against_first) ? more : 0.0;
  }
  [[nodiscard]] std::size_t stiffer() const { return with_first > against_first ? members.front() : against; }
};

std::vector<JoinedLaw> laws_of(const std::vector<Touching>& supports) {
  std::vector<JoinedLaw> out;
  std::vector<char> taken(supports.size(), 0);
  for (std::size_t i = 0; i < supports.size(); ++i) {
    if (taken[i] != 0) continue;
    JoinedLaw law;
    for (std::size_t j = i; j < supports.size(); ++j) {
      const double sense = taken[j] != 0 ? 0.0 : agreement(supports[i].action, supports[j].action);
      if (sense == 0.0) continue;
      taken[j] = 1;
      law.members.push_back(j);
      if (sense < 0.0 && law.against_first == 0.0) law.against = j;
      (sense > 0.0 ? law.with_first : law.against_first) += supports[j].stiffness;
    }
    out.push_back(std::move(law));
  }
  return out;
}

/// Appends a support with a given stiffness and without gap, bilateral or as before.
template <class Support>
void append(Support support, double stiffness, bool bilateral, std::vector<Support>& out) {
  support.stiffness = stiffness;
  support.gap = 0.0;
  if (bilateral) support.reaction = Reaction::bilateral;
  out.push_back(std::move(support));
}

class Joiner {
 public:
  explicit Joiner(const ResolvedModel& model) : model_(model) {
    for (const ResolvedMember& member : model.members) {
      const Node& a = model.nodes[member.start];
      const Node& b = model.nodes[member.end];
      span_ = std::max(span_, std::hypot(b.x - a.x, b.y - a.y));
    }
  }

  /// Joins the supports; false when none are opposite.
  [[nodiscard]] bool join() {
    join_springs();
    for (std::size_t m = 0; m < model_.members.size(); ++m) join_foundations(static_cast<int>(m));
    if (!joined_) return false;
    for (std::size_t i = 0; i < model_.springs.size(); ++i)
      if (!replaced_springs_[i]) springs_.push_back(model_.springs[i]);
    for (std::size_t i = 0; i < model_.foundations.size(); ++i)
      if (!replaced_foundations_[i]) foundations_.push_back(model_.foundations[i]);
    return true;
  }
  [[nodiscard]] ResolvedModel take() {
    ResolvedModel out = model_;
    out.springs = std::move(springs_);
    out.foundations = std::move(foundations_);
    return out;
  }

 private:
  template <class Support>
  [[nodiscard]] bool touches(const Support& support, double unit) const {
    if constexpr (requires { support.outline; })
      if (support.outline || !support.gap_along.empty() || support.shear_stiffness > 0.0) return false;
    if constexpr (requires { support.pretension; })
      if (support.pretension) return false;
    return is_one_sided(support) && !support.law && !support.displacement &&
           std::isfinite(support.stiffness) && support.gap <= Rounding::coordinate * unit;
  }
  void join_springs();
  void join_springs_at(const std::vector<Touching>& place);
  void join_foundations(int member);
  [[nodiscard]] bool join_foundations_on(std::array<double, 2> range,
                                         const std::vector<Touching>& foundations,
                                         std::vector<ResolvedFoundation>& out) const;

  const ResolvedModel& model_;
  double span_ = 0.0;
  bool joined_ = false;
  std::vector<bool> replaced_springs_ = std::vector<bool>(model_.springs.size(), false);
  std::vector<bool> replaced_foundations_ = std::vector<bool>(model_.foundations.size(), false);
  std::vector<ResolvedSpring> springs_;
  std::vector<ResolvedFoundation> foundations_;
};

/// Joins springs, sorted by place: nodes (with member ends), then positions inside members. Rotational
/// springs are kept apart, because the rotation of a member end may be released.
void Joiner::join_springs() {
  using Place = std::tuple<bool, bool, int, double>;  // rotational, at a member, index, fraction
  std::vector<std::pair<Place, Touching>> sorted;
  for (std::size_t i = 0; i < model_.springs.size(); ++i) {
    const ResolvedSpring& spring = model_.springs[i];
    if (spring.to || !touches(spring, spring.direction ? span_ : 1.0)) continue;
    Place place{!spring.direction, spring.at.is_on_member(), 0, spring.at.fraction};
    if (!spring.at.is_on_member()) {
      place = {!spring.direction, false, spring.at.node, 0.0};
    } else {
      const int m = spring.at.member;
      const bool at_start = spring.at.fraction <= kOnePlace;
      const bool at_end = spring.at.fraction >= 1.0 - kOnePlace;
      std::get<2>(place) = m;
      if (spring.direction && (at_start || at_end))
        place = {false, false, at_start ? model_.members[m].start : model_.members[m].end, 0.0};
    }
    sorted.push_back({place, {i, spring.stiffness, action_of(spring)}});
  }
  std::sort(sorted.begin(), sorted.end(), [](const auto& l, const auto& r) { return l.first < r.first; });
  std::vector<Touching> place;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    place.push_back(sorted[i].second);
    const auto [rotation, inside, which, fraction] = sorted[i].first;
    const bool last = i + 1 == sorted.size() ||
                      std::tie(rotation, inside, which) != std::tie(std::get<0>(sorted[i + 1].first),
                                                                    std::get<1>(sorted[i + 1].first),
                                                                    std::get<2>(sorted[i + 1].first)) ||
                      std::get<3>(sorted[i + 1].first) - fraction > kOnePlace;
    if (!last) continue;
    join_springs_at(place);
    place.clear();
  }
}

void Joiner::join_springs_at(const std::vector<Touching>& place) {
  for (const JoinedLaw& law : laws_of(place)) {
    if (!law.is_joined()) continue;
    joined_ = true;
    for (const std::size_t i : law.members) replaced_springs_[place[i].number] = true;
    append(model_.springs[place[law.members.front()].number], law.bilateral(), true, springs_);
    if (law.rest() > 0.0) append(model_.springs[place[law.stiffer()].number], law.rest(), false, springs_);
  }
}

/// Joins the foundations of a member on each part between the ends of their ranges.
void Joiner::join_foundations(int member) {
  std::vector<Touching> touching;
  std::vector<double> ends;
  for (std::size_t i = 0; i < model_.foundations.size(); ++i) {
    const ResolvedFoundation& foundation = model_.foundations[i];
    if (foundation.member != member || !touches(foundation, span_)) continue;
    touching.push_back({i, foundation.stiffness, action_of(model_, model_.members[member], foundation)});
    ends.insert(ends.end(), foundation.range.begin(), foundation.range.end());
  }
  if (touching.size() < 2) return;
  std::sort(ends.begin(), ends.end());
  std::vector<ResolvedFoundation> parts;
  bool any = false;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    if (ends[i + 1] - ends[i] > kOnePlace)
      any = join_foundations_on({ends[i], ends[i + 1]}, touching, parts) || any;
  if (!any) return;
  joined_ = true;
  for (const Touching& foundation : touching) replaced_foundations_[foundation.number] = true;
  foundations_.insert(foundations_.end(), parts.begin(), parts.end());
}

/// Appends the supports on a part of a member; true when some were joined.
bool Joiner::join_foundations_on(std::array<double, 2> range, const std::vector<Touching>& foundations,
                                 std::vector<ResolvedFoundation>& out) const {
  const double middle = 0.5 * (range[0] + range[1]);
  std::vector<Touching> here;
  for (const Touching& foundation : foundations) {
    const ResolvedFoundation& whole = model_.foundations[foundation.number];
    if (whole.range[0] < middle && middle < whole.range[1]) here.push_back(foundation);
  }
  const auto put = [&](std::size_t position, double stiffness, bool bilateral) {
    append(model_.foundations[here[position].number], stiffness, bilateral, out);
    out.back().range = range;
  };
  bool any = false;
  for (const JoinedLaw& law : laws_of(here)) {
    any = any || law.is_joined();
    if (law.is_joined()) {
      put(law.members.front(), law.bilateral(), true);
      if (law.rest() > 0.0) put(law.stiffer(), law.rest(), false);
    } else {
      for (const std::size_t i : law.members) put(i, here[i].stiffness, false);
    }
  }
  return any;
}

}  // namespace

std::optional<ResolvedModel> with_joined_supports(const ResolvedModel& model) {
  const auto one_sided = [](const auto& support) { return support.reaction != Reaction::bilateral; };
  if (std::none_of(model.springs.begin(), model.springs.end(), one_sided) &&
      std::none_of(model.foundations.begin(), model.foundations.end(), one_sided))
    return std::nullopt;
  Joiner joiner(model);
  if (!joiner.join()) return std::nullopt;
  return joiner.take();
}

}  // namespace snapthrough
