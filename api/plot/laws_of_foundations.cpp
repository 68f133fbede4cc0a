#include "api/plot/laws_of_foundations.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "api/plot/chain.h"
#include "api/plot/ink.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kApart = 1e-9;     // fractions that differ by less are one
constexpr std::size_t kFewest = 4;  // parts of a chain that are enough without more places in them

/// A foundation with a law, or with a stiffness that may act together with laws.
struct ReadFoundation {
  LawSource source;
  const ModelMember* member = nullptr;
  std::string reaction;
  double gap = 0;
  bool gap_varies = false;
  bool turns = false;
  bool has_law = false;
  std::string title;  ///< title of its group, without the members
  std::string sense;  ///< sense of its group
};

/// Foundations that act alike, by what tells them from others.
using Alike = std::map<std::string, std::vector<ReadFoundation>>;

std::string title_of(const Field& field, const std::string& component) {
  if (component == "tangent") {
    return "Along";
  }
  if (component == "rotation") {
    return "Against rotation of";
  }
  if (const auto direction = field.find("direction"); direction && direction->json().is_array()) {
    const std::vector<double> way = direction->numbers(2);
    return "In the direction (" + format_number(way[0]) + ", " + format_number(way[1]) + ") on";
  }
  return "Across";
}

/// Returns the side and the sense of a one-sided foundation, for a title.
std::string sense_in_title(const Field& field, const std::string& reaction) {
  if (reaction == "bilateral") {
    return "";
  }
  const bool has_side = !field.find("direction") && !field.find("outline");
  return (has_side ? text_or(field, "side", "left") + " side, " : "") +
         (reaction == "tension_only" ? "tension only" : "compression only");
}

/// Reads a law, or a stiffness as a linear law; nullopt where there is neither, or a rigid foundation.
std::optional<ReactionLaw> read_law_or_stiffness(const Field& field) {
  if (const std::optional<Field> law = field.find("law")) {
    return read_reaction_law(*law);
  }
  const std::optional<Field> stiffness = field.find("stiffness");
  if (!stiffness || stiffness->json().is_string()) {
    return std::nullopt;
  }
  ReactionLaw linear;
  linear.stiffness = read_number_along(*stiffness);
  return linear;
}

std::optional<ReadFoundation> read_one(const Field& field,
                                       const std::map<std::string, const ModelMember*>& by_id) {
  const std::optional<ReactionLaw> given = read_law_or_stiffness(field);
  if (!given) {
    return std::nullopt;
  }
  const auto member = by_id.find(field.at("member").text());
  if (member == by_id.end()) {
    field.at("member").fail("must be the id of a member");
  }
  ReadFoundation read;
  read.source = {field.at("id").text(), *given, law_in_units_of_model(*given), 0, range_or_all(field)};
  read.member = member->second;
  read.reaction = read_reaction_sense(field);
  std::tie(read.gap, read.gap_varies) = read_gap_of_law(field, read.reaction);
  const std::string component = text_or(field, "component", "normal");
  read.turns = component == "rotation";
  read.has_law = field.find("law").has_value();
  read.title = title_of(field, component);
  read.sense = sense_in_title(field, read.reaction);
  return read;
}

/// Returns what foundations have in common whose reactions at one displacement of a place are added.
std::string key_of(const ReadFoundation& read, const Field& field) {
  std::string key = read.title + "\n" + read.sense;
  if (read.reaction != "bilateral") {
    const std::optional<Field> gap = field.find("gap");
    const std::optional<Field> outline = field.find("outline");
    key += "\n" + (gap ? gap->json().dump() : "0") + "\n" + (outline ? outline->json().dump() : "");
  }
  return key;
}

/// Returns the fractions at which the laws of a member's foundations bend, begin or end, in ascending order.
std::vector<double> breaks_of(const LawGroup& group, std::size_t link) {
  std::vector<double> all;
  for (const LawSource& source : group.sources_on(link)) {
    all.insert(all.end(), source.range.begin(), source.range.end());
    for (const AlongMember* number :
         {&source.given.stiffness, &source.given.capacity, &source.given.factor}) {
      for (const auto& [fraction, value] : number->points) {
        WorkLimit::poll();
        if (fraction > source.range[0] && fraction < source.range[1]) {
          all.push_back(fraction);
        }
      }
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<double> apart;
  for (const double fraction : all) {
    if (apart.empty() || fraction - apart.back() > kApart) {
      apart.push_back(fraction);
    }
  }
  return apart;
}

/// Adds the places of a part of a member, between two fractions.
void add_part(LawGroup& group, const Chain& chain, std::size_t link, double from, double to,
              std::size_t pieces) {
  Ink::require(10 * (group.places.size() + pieces));  // numbers of the places
  for (std::size_t i = 0; i <= pieces; ++i) {
    LawPlace place;
    place.link = place.last_link = link;
    place.fraction = place.last_fraction =
        from + static_cast<double>(i) / static_cast<double>(pieces) * (to - from);
    place.middle = 0.5 * (from + to);
    place.from = place.to = coordinate_on(chain, link, place.fraction);
    group.places.push_back(place);
  }
}

void add_places(LawGroup& group, const Chain& chain) {
  std::vector<std::vector<double>> breaks;
  std::size_t parts = 0;
  for (std::size_t link = 0; link < chain.links.size(); ++link) {
    breaks.push_back(breaks_of(group, link));
    parts += breaks.back().size() - 1;
  }
  const std::size_t pieces = std::max<std::size_t>(1, kFewest / std::max<std::size_t>(1, parts));
  for (std::size_t link = 0; link < chain.links.size(); ++link) {
    std::vector<double>& at = breaks[link];
    if (chain.links[link].backwards) {
      std::reverse(at.begin(), at.end());
    }
    for (std::size_t i = 1; i < at.size(); ++i) {
      add_part(group, chain, link, at[i - 1], at[i], pieces);
    }
  }
}

/// Whether the heights on a chain are linear in the fractions of its members.
bool is_straight(const Chain& chain) {
  return std::all_of(chain.links.begin(), chain.links.end(), [](const Chain::Link& link) {
    const Axis& axis = link.member->axis;
    const double chord = std::hypot(axis.x.back() - axis.x.front(), axis.y.back() - axis.y.front());
    return axis.s.back() <= (1 + kApart) * chord;
  });
}

/// Makes zero of coordinates that rounding left beside it.
void round_coordinates(LawGroup& group) {
  double most = 0;
  for (const LawPlace& place : group.places) {
    most = std::max(most, std::abs(place.from));
  }
  for (LawPlace& place : group.places) {
    if (std::abs(place.from) <= kApart * most) {
      place.from = place.to = 0;
    }
  }
}

/// Sets what the places are told by: depths where the ground level is known, and the same for all members.
void set_whereabouts(LawGroup& group, const Chain& chain, const LawChoice& choice) {
  group.whereabouts = chain.goes_down ? Whereabouts::height : Whereabouts::distance;
  group.is_even = !chain.goes_down || is_straight(chain);
  std::set<double> levels;
  for (const Chain::Link& link : chain.links) {
    const auto found = choice.ground_level.find(link.member->id);
    levels.insert(found == choice.ground_level.end() ? kNone : found->second);
  }
  if (chain.goes_down && levels.size() == 1 && std::isfinite(*levels.begin())) {
    group.whereabouts = Whereabouts::depth;
    for (LawPlace& place : group.places) {
      place.from = place.to = *levels.begin() - place.from + 0.0;
    }
  }
  round_coordinates(group);
}

/// Returns the ids of what gives the laws: the foundation in soil in place of the many that it gives.
std::string sources_of(const LawGroup& group, const LawChoice& choice) {
  std::vector<std::string> ids;
  for (const LawSource& source : group.sources) {
    const auto soil = std::find_if(choice.soils.begin(), choice.soils.end(), [&](const std::string& id) {
      return source.id.starts_with(id + " layer ");
    });
    const std::string& id = soil == choice.soils.end() ? source.id : *soil;
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) {
      ids.push_back(id);
    }
    if (ids.size() > 3) {
      return ids[0] + ", " + ids[1] + ", \u2026";
    }
  }
  std::string text;
  for (const std::string& id : ids) {
    text += (text.empty() ? "" : ", ") + id;
  }
  return text;
}

std::string members_of(const Chain& chain) {
  const std::string& first = chain.links.front().member->id;
  return chain.links.size() == 1 ? first : first + " \u2026 " + chain.links.back().member->id;
}

/// Returns the group of a chain; without a law when it has stiffnesses alone.
std::optional<LawGroup> group_of(const std::vector<ReadFoundation>& alike, const Chain& chain,
                                 const LawChoice& choice) {
  std::map<const ModelMember*, std::size_t> links;
  for (std::size_t link = 0; link < chain.links.size(); ++link) {
    links[chain.links[link].member] = link;
  }
  LawGroup group;
  bool has_law = false;
  for (const ReadFoundation& read : alike) {
    WorkLimit::poll();
    const auto link = links.find(read.member);
    if (link == links.end()) {
      continue;
    }
    has_law = has_law || read.has_law;
    group.sources.push_back(read.source);
    group.sources.back().link = link->second;
  }
  if (!has_law) {
    return std::nullopt;
  }
  const ReadFoundation& first = alike.front();
  group.turns = first.turns;
  group.gap_varies = first.gap_varies;
  group.title = first.title + " " + members_of(chain);
  group.sense = first.sense;
  group.given_by = sources_of(group, choice);
  std::stable_sort(group.sources.begin(), group.sources.end(),
                   [](const LawSource& one, const LawSource& other) { return one.link < other.link; });
  add_places(group, chain);
  set_whereabouts(group, chain, choice);
  for (LawPlace& place : group.places) {
    place.reaction = first.reaction;
    place.gap = first.gap;
  }
  return group;
}

}  // namespace

bool LawChoice::has(const std::string& support) const {
  return !id || support == *id ||
         (is_soil && (support.starts_with(*id + " layer ") || support.starts_with(*id + " base ")));
}

LawChoice read_law_choice(const Field& model, const std::optional<std::string>& id) {
  LawChoice choice;
  choice.id = id;
  const std::optional<Field> all = model.find("foundations");
  for (std::size_t i = 0; all && i < all->size(); ++i) {
    const Field foundation = all->item(i);
    if (!foundation.find("soil")) {
      continue;
    }
    choice.soils.push_back(foundation.at("id").text());
    choice.is_soil = choice.is_soil || choice.soils.back() == id;
    choice.ground_level[foundation.at("member").text()] = number_or(foundation, "ground_level", 0);
  }
  return choice;
}

std::vector<LawGroup> foundation_law_groups(const Field& model, const Model& known, const LawChoice& choice) {
  std::map<std::string, const ModelMember*> by_id;
  for (const ModelMember& member : known.members) {
    by_id.emplace(member.id, &member);
  }
  Alike alike;
  std::vector<std::string> order;
  const std::optional<Field> all = model.find("foundations");
  for (std::size_t i = 0; all && i < all->size(); ++i) {
    const Field field = all->item(i);
    const bool asked = choice.has(field.at("id").text());
    const std::optional<ReadFoundation> read = asked ? read_one(field, by_id) : std::nullopt;
    if (!read) {
      continue;
    }
    std::vector<ReadFoundation>& group = alike[key_of(*read, field)];
    if (group.empty()) {
      order.push_back(key_of(*read, field));
    }
    group.push_back(*read);
  }
  std::vector<LawGroup> groups;
  for (const std::string& key : order) {
    std::vector<const ModelMember*> members;
    std::set<const ModelMember*> listed;
    for (const ReadFoundation& read : alike[key]) {
      if (listed.insert(read.member).second) {
        members.push_back(read.member);
      }
    }
    for (const Chain& chain : chains_of(members)) {
      if (std::optional<LawGroup> group = group_of(alike[key], chain, choice)) {
        groups.push_back(std::move(*group));
      }
    }
  }
  return groups;
}

}  // namespace snapthrough::api::plot
