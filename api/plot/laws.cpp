#include "api/plot/laws.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "api/list_foundations.h"
#include "api/plot/laws_of_foundations.h"
#include "api/plot/model.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::plot {
namespace {

constexpr double kSame = 1e-9;  // relative to the largest force: laws with smaller differences are one
/// Displacements at which laws are compared, over the largest reach of a group.
constexpr std::array<double, 10> kCompared{0.001, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.75, 1, 1.2};

double reach_of(const LawGroup& group) {
  double reach = 0;
  for (const LawPlace& place : group.places) {
    reach = std::max(reach, group.sum_at(place).reach());
  }
  return reach;
}

bool is_same(const LawPlace& one, const LawPlace& other, double most) {
  if (one.reaction != other.reaction || one.gap != other.gap) {
    return false;
  }
  for (std::size_t i = 0; i < kCompared.size(); ++i) {
    if (std::abs(one.forces[i] - other.forces[i]) > kSame * most) {
      return false;
    }
  }
  return true;
}

/// Makes one place of neighbours with the same law, and of springs and joints with the same law wherever
/// they are. Leaves out places that have no reaction, and none beside them.
void merge_places(LawGroup& group) {
  const double reach = reach_of(group);
  double most = 0;
  for (LawPlace& place : group.places) {
    const LawSum sum = group.sum_at(place);
    for (std::size_t i = 0; i < kCompared.size(); ++i) {
      WorkLimit::poll();
      place.forces[i] = sum.force_at(kCompared[i] * reach);
      most = std::max(most, std::abs(place.forces[i]));
    }
  }
  std::vector<LawPlace> merged;
  std::vector<std::size_t> more;
  for (LawPlace& place : group.places) {
    WorkLimit::poll();
    const bool anywhere = group.whereabouts == Whereabouts::name;
    auto same = anywhere ? merged.begin() : merged.empty() ? merged.end() : merged.end() - 1;
    while (same != merged.end() && !is_same(*same, place, most)) {
      WorkLimit::poll();
      ++same;
    }
    if (same != merged.end()) {
      same->to = place.to;
      same->last_link = place.last_link;
      same->last_fraction = place.last_fraction;
      ++more[static_cast<std::size_t>(same - merged.begin())];
      continue;
    }
    merged.push_back(std::move(place));
    more.push_back(0);
  }
  group.places.clear();
  const auto reacts = [&](std::size_t i) {
    const auto& forces = merged[i].forces;
    return std::any_of(forces.begin(), forces.end(), [&](double p) { return p > kSame * most; });
  };
  const auto ends_part = [&](std::size_t i) {  // whose other end has a reaction
    return (i > 0 && are_joined(merged[i - 1], merged[i]) && reacts(i - 1)) ||
           (i + 1 < merged.size() && are_joined(merged[i], merged[i + 1]) && reacts(i + 1));
  };
  for (std::size_t i = 0; i < merged.size(); ++i) {
    if (reacts(i) || ends_part(i)) {
      merged[i].name += more[i] > 0 && !merged[i].name.empty() ? " + " + std::to_string(more[i]) : "";
      group.places.push_back(std::move(merged[i]));
    }
  }
}

/// Adds a spring or joint to a group.
void add_one(LawGroup& group, const Field& law, const std::string& id) {
  LawSource source;
  source.id = id;
  source.given = read_reaction_law(law);
  source.law = law_in_units_of_model(source.given);
  source.link = group.sources.size();
  group.sources.push_back(std::move(source));
  LawPlace& place = group.places.emplace_back();
  place.link = group.places.size() - 1;
  place.name = id;
}

/// Returns the height of a location; 0 for one on an unknown node or member.
double height_of(const Location& at, const Model& known) {
  if (const auto node = known.nodes.find(at.node); node != known.nodes.end()) {
    return node->second.y;
  }
  for (const ModelMember& member : known.members) {
    if (member.id == at.member) {
      return interpolate(member.axis.s, member.axis.y, at.fraction * member.axis.s.back());
    }
  }
  return 0;
}

/// Returns the laws of springs that turn, or of the others, from the highest spring to the lowest.
LawGroup spring_group(const Field& model, const Model& known, const LawChoice& choice, bool turns) {
  LawGroup group;
  group.title = turns ? "Springs against rotation" : "Springs";
  group.turns = turns;
  group.is_spring = true;
  const std::optional<Field> springs = model.find("springs");
  for (std::size_t i = 0; springs && i < springs->size(); ++i) {
    const Field spring = springs->item(i);
    const std::optional<Field> law = spring.find("law");
    const std::string id = spring.at("id").text();
    if (!law || !choice.has(id) || turns == known.springs[i].direction.has_value()) {
      continue;
    }
    add_one(group, *law, id);
    LawPlace& place = group.places.back();
    place.reaction = read_reaction_sense(spring);
    place.gap = read_gap_of_law(spring, place.reaction).first;
    place.from = place.to = height_of(known.springs[i].at, known);
  }
  std::stable_sort(group.places.begin(), group.places.end(),
                   [](const LawPlace& one, const LawPlace& other) { return one.from > other.from; });
  return group;
}

LawGroup joint_group(const Field& model, const LawChoice& choice) {
  LawGroup group;
  group.title = "Joints";
  group.turns = true;
  group.is_spring = true;
  const Field members = model.at("members");
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::optional<Field> release = members.item(i).find("release");
    const std::string id = members.item(i).at("id").text();
    for (const char* end : {"start", "end"}) {
      const std::optional<Field> parts = release && choice.has(id) ? release->find(end) : std::nullopt;
      const std::optional<Field> joint = parts && parts->json().is_object() ? parts->find("rotation") : parts;
      if (joint && joint->json().is_object()) {
        add_one(group, joint->at("law"), id + " " + end);
      }
    }
  }
  return group;
}

/// Returns the ids by which laws of a model can be chosen, of which the first ones are told.
std::string choices_in(const Field& model) {
  constexpr std::size_t kTold = 20;
  std::string names;
  std::size_t told = 0;
  for (const char* list : {"springs", "foundations"}) {
    const std::optional<Field> all = model.find(list);
    for (std::size_t i = 0; all && i < all->size(); ++i) {
      const Field support = all->item(i);
      if ((support.find("law") || support.find("soil")) && told++ < kTold) {
        names += (names.empty() ? "" : ", ") + support.at("id").text();
      }
    }
  }
  return told > kTold ? names + ", \u2026" : names;
}

std::vector<LawGroup> read_made(const Field& model, const LawChoice& choice) {
  const Model known = read_model(model);
  std::vector<LawGroup> groups = foundation_law_groups(model, known, choice);
  groups.push_back(spring_group(model, known, choice, false));
  groups.push_back(spring_group(model, known, choice, true));
  groups.push_back(joint_group(model, choice));
  for (LawGroup& group : groups) {
    merge_places(group);
  }
  std::erase_if(groups, [](const LawGroup& group) { return group.places.empty(); });
  return groups;
}

}  // namespace

std::vector<LawGroup> read_law_groups(const Field& model, const std::optional<std::string>& id) {
  const LawChoice choice = read_law_choice(model, id);
  std::vector<LawGroup> groups;
  if (has_soil(model.json())) {
    const nlohmann::json made = with_laws_of_soil(model.json());
    groups = read_made(Field(made, PointerPath(model.pointer())), choice);
  } else {
    groups = read_made(model, choice);
  }
  if (groups.empty() && id) {
    const std::string names = choices_in(model);
    model.fail("has no law of \"" + *id + "\"; " +
               (names.empty() ? "no spring and no foundation has one" : "those with a law are: " + names));
  }
  if (groups.empty()) {
    model.fail("no spring, foundation or joint of the model has a law, which a figure of kind laws draws");
  }
  return groups;
}

}  // namespace snapthrough::api::plot
