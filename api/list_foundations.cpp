#include "api/list_foundations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "api/read_pipe.h"
#include "api/read_soil_layer.h"
#include "api/read_soils.h"
#include "api/soil/buried_pipe.h"
#include "api/soil/write_base.h"
#include "api/soil/write_foundations.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api {

namespace {

using nlohmann::json;

/// Entry of `foundations` that names a soil.
struct SoilEntry {
  std::string id, member, soil;
  double ground_level = 0.0;       ///< y of the ground's surface
  std::optional<double> diameter;  ///< empty: that of the member's section
  double force_factor = 1.0;
  double displacement_factor = 1.0;
  bool base = false;  ///< the member's lower end is the pile's tip, and bears
};

/// Largest slope of a pipe for which a foundation along its normal is one in the vertical direction.
constexpr double kLargestPipeSlope = 0.2;

/// A member in soil: its geometry, and the nodes at its ends.
struct Shaft {
  soil::Pile pile;
  std::string upper, lower;
  std::array<double, 2> across{};  ///< unit normal to the left
  std::array<double, 2> down{};    ///< unit vector from the upper to the lower end
};

/// Objects of a list by their ids; of several with one id the first.
class ById {
 public:
  ById(const json& model, const char* list) {
    const auto found = model.find(list);
    if (found == model.end() || !found->is_array()) {
      return;
    }
    for (const json& one : *found) {
      if (const json* id = field(one, "id"); id != nullptr && id->is_string()) {
        objects_.emplace(id->get<std::string>(), &one);
      }
    }
  }
  /// Returns null for an unknown id.
  [[nodiscard]] const json* find(const std::string& id) const {
    const auto found = objects_.find(id);
    return found == objects_.end() ? nullptr : found->second;
  }
  /// Returns the object whose id a field of another one is.
  [[nodiscard]] const json* named_by(const json& object, const char* key) const {
    const json* id = field(object, key);
    return id != nullptr && id->is_string() ? find(id->get<std::string>()) : nullptr;
  }
  /// Returns null for a field that an object does not have.
  static const json* field(const json& object, const char* key) {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return found == object.end() ? nullptr : &*found;
  }
  /// Returns a number of an object; NaN when it has none.
  static double number(const json& object, const char* key) {
    const json* value = field(object, key);
    return value != nullptr && value->is_number() ? value->get<double>()
                                                  : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  std::unordered_map<std::string, const json*> objects_;
};

/// Reads the factors of forces and displacements of a pile in a group.
void read_multiplier(const Value& value, SoilEntry& out) {
  Object in(value);
  if (in.find("p")) {
    read_positive(in, "p", out.force_factor);
  }
  if (in.find("y")) {
    read_positive(in, "y", out.displacement_factor);
  }
  in.finish();
}

SoilEntry read_entry(const Value& value) {
  SoilEntry out;
  Object in(value);
  in.required("id", out.id);
  in.required("member", out.member);
  in.required("soil", out.soil);
  if (in.optional("ground_level", out.ground_level)) {
    require(in, "ground_level", out.ground_level, std::abs(out.ground_level) <= kMaxMagnitude, "finite");
  }
  if (in.find("diameter")) {
    read_positive(in, "diameter", out.diameter.emplace());
  }
  if (const auto multiplier = in.find("multiplier")) {
    read_multiplier(*multiplier, out);
  }
  in.optional("base", out.base);
  for (const char* own : {"stiffness", "law", "pipe"}) {
    if (const auto field = in.find(own)) {
      field->report(
          "ambiguous",
          "the soil gives the laws of a foundation that names one: give either soil or " + std::string(own));
    }
  }
  (void)in.find("displacement");  // read with each foundation that the soil gives
  in.finish();
  return out;
}

/// Whether an entry of `foundations` names a soil.
bool names_soil(const json& entry) { return entry.is_object() && entry.contains("soil"); }

/// Whether an entry of `foundations` is the soil around a pipe.
bool has_pipe(const json& entry) { return entry.is_object() && entry.contains("pipe"); }

/// Members in soil that continue one another downwards.
class Chains {
 public:
  /// Adds a member in a soil by the nodes at its ends. @param y height of the lower end
  void add(const std::string& soil, const std::string& upper, const std::string& lower, double y) {
    members_.try_emplace({soil, upper}, Link{lower, y});
  }

  /// Returns the height of the lowest end of the members in a soil that follow one another downwards from a
  /// node at the height y.
  double lowest(const std::string& soil, const std::string& node, double y) {
    std::vector<Link*> passed;
    std::string at = node;
    for (auto next = members_.find({soil, at}); next != members_.end(); next = members_.find({soil, at})) {
      Link& link = next->second;
      if (!(link.lowest < y)) {
        break;  // members do not rise again
      }
      y = link.lowest;
      at = link.lower;
      passed.push_back(&link);
    }
    for (Link* link : passed) {
      *link = {at, y};
    }
    return y;
  }

 private:
  struct Link {
    std::string lower;    ///< node where the known part of the chain ends
    double lowest = 0.0;  ///< its height
  };
  std::map<std::pair<std::string, std::string>, Link> members_;  ///< by soil and upper node
};

/// Writes the list of foundations of a model.
class FoundationList {
 public:
  explicit FoundationList(const Value& model)
      : model_(model),
        report_(model.document_report()),
        nodes_(model.json(), "nodes"),
        sections_(model.json(), "sections"),
        members_(model.json(), "members") {}

  ListedSupports list();

 private:
  void link_members(const json& entries);
  void add_made(const Value& entry, std::size_t index);
  bool add_base(const Value& entry, std::size_t index, const GivenSoil& soil, const Shaft& shaft);
  void add_pipe(const Value& entry, std::size_t index);
  json foundations_of_pipe(const Value& entry, PipeEntry& data);
  bool is_buried(const Value& entry, const soil::BuriedPipe& pipe);
  bool reacts(const Value& entry, const json& made);
  std::optional<bool> above_is_left(const Value& entry, const json& member);
  void add_all(const Value& entry, std::size_t index, json made);
  void add_unknown(std::size_t index, const std::string& id, const std::string& member);
  std::optional<Shaft> shaft_of(const Value& entry, const SoilEntry& data);
  const json* member_of(const Value& entry, const std::string& id, const std::string& member);
  std::optional<double> diameter_of(const Value& entry, const json& member);
  const GivenSoil* soil_of(const Value& entry, const SoilEntry& data);
  bool reaches(const Value& entry, const GivenSoil& soil, const SoilEntry& data, const soil::Pile& pile);
  json foundations_of(const GivenSoil& soil, const soil::Pile& pile);
  const soil::Profile& profile_of(const GivenSoil& soil) {
    const auto [found, is_new] = profiles_.try_emplace(soil.id);
    if (is_new) {
      found->second = soil.profile();
    }
    return found->second;
  }
  [[nodiscard]] std::string pointer_of(const GivenSoil& soil) const {
    return model_.pointer() + "/soils/" + std::to_string(&soil - soils_.data());
  }

  const Value& model_;
  Report& report_;
  ById nodes_, sections_, members_;
  std::vector<GivenSoil> soils_;
  std::unordered_map<std::string, soil::Profile> profiles_;  ///< by id of the soils that were used
  Chains chains_;
  std::size_t numbers_by_depth_ = 0;
  ListedSupports listed_;
};

ListedSupports FoundationList::list() {
  if (const auto soils = model_.member("soils")) {
    soils_ = read_soils(*soils);
  }
  const auto entries = model_.member("foundations");
  if (!entries || !entries->is_array()) {
    return {};
  }
  link_members(entries->json());
  for (std::size_t i = 0; i < entries->size(); ++i) {
    const Value entry = entries->item(i);
    if (names_soil(entry.json())) {
      WorkLimit::poll();
      add_made(entry, i);
    } else if (has_pipe(entry.json())) {
      add_pipe(entry, i);
    } else {
      listed_.foundations.push_back({i, nullptr});
    }
  }
  return std::move(listed_);
}

/// Finds which members in one soil continue one another. Passes over what is not readable.
void FoundationList::link_members(const json& entries) {
  for (const json& entry : entries) {
    const json* soil = names_soil(entry) ? ById::field(entry, "soil") : nullptr;
    const json* member = soil != nullptr && soil->is_string() ? members_.named_by(entry, "member") : nullptr;
    const json* start = member != nullptr ? nodes_.named_by(*member, "start") : nullptr;
    const json* end = member != nullptr ? nodes_.named_by(*member, "end") : nullptr;
    if (start == nullptr || end == nullptr) {
      continue;
    }
    const bool head_is_start = ById::number(*start, "y") > ById::number(*end, "y");
    const json& upper = head_is_start ? *start : *end;
    const json& lower = head_is_start ? *end : *start;
    chains_.add(soil->get<std::string>(), upper.at("id").get<std::string>(),
                lower.at("id").get<std::string>(), ById::number(lower, "y"));
  }
}

/// Adds what the soil of an entry gives, or a foundation of unknown stiffness.
void FoundationList::add_made(const Value& entry, std::size_t index) {
  const SoilEntry data = read_entry(entry);
  if (report_.covers(entry.pointer())) {
    return add_unknown(index, data.id, data.member);
  }
  const GivenSoil* soil = soil_of(entry, data);
  auto shaft = soil != nullptr ? shaft_of(entry, data) : std::nullopt;
  if (!shaft || !reaches(entry, *soil, data, shaft->pile)) {
    return add_unknown(index, data.id, data.member);
  }
  const double tip = chains_.lowest(data.soil, shaft->lower, data.ground_level - shaft->pile.tip_depth());
  shaft->pile.embedded_depth = data.ground_level - tip - soil->scour.general;
  shaft->pile.head_depth -= soil->scour.general;
  shaft->pile.held_from = soil->scour.local;
  json made = foundations_of(*soil, shaft->pile);
  if (made.is_null() || (data.base && !add_base(entry, index, *soil, *shaft))) {
    return add_unknown(index, data.id, data.member);
  }
  add_all(entry, index, std::move(made));
}

/// Adds what the soil around a pipe gives, or a foundation of unknown stiffness.
void FoundationList::add_pipe(const Value& entry, std::size_t index) {
  PipeEntry data = read_pipe(entry);
  json made = report_.covers(entry.pointer()) ? json() : foundations_of_pipe(entry, data);
  if (made.is_null() || !reacts(entry, made)) {
    return add_unknown(index, data.pipe.id, data.pipe.member);
  }
  add_all(entry, index, std::move(made));
}

/// Returns the foundations of a pipe; null after a report, and when its member is unreadable.
json FoundationList::foundations_of_pipe(const Value& entry, PipeEntry& data) {
  const json* member = member_of(entry, data.pipe.id, data.pipe.member);
  if (member == nullptr) {
    return {};
  }
  const auto diameter = data.diameter ? data.diameter : diameter_of(entry, *member);
  if (!diameter) {
    return {};
  }
  data.pipe.diameter = *diameter;
  if (!is_buried(entry, data.pipe)) {
    return {};
  }
  if (data.plane == PipePlane::horizontal) {
    return soil::write_pipe_in_plan(data.pipe);
  }
  const auto up_is_left = above_is_left(entry, *member);
  return up_is_left ? soil::write_pipe_in_elevation(data.pipe, *up_is_left) : json();
}

/// Returns whether the depth of a pipe is one for which its soil's reactions are given; else reports it.
bool FoundationList::is_buried(const Value& entry, const soil::BuriedPipe& pipe) {
  const double depth = pipe.depth / pipe.diameter;
  if (depth >= soil::kLeastPipeDepth && depth <= soil::kLargestPipeDepth) {
    return true;
  }
  entry.member("pipe")->member("depth")->report(
      "out_of_range", "the depth of a pipe's axis must be from " + checks::text(soil::kLeastPipeDepth) +
                          " to " + checks::text(soil::kLargestPipeDepth) + " diameters, got " +
                          checks::text(depth));
  return false;
}

/// Returns whether the reactions around a pipe and their displacements are positive and finite; else reports
/// it.
bool FoundationList::reacts(const Value& entry, const json& made) {
  for (const json& one : made) {
    for (const json& number : one.at("law").at("points").back()) {
      const double value = number.get<double>();
      if (!(value >= std::numeric_limits<double>::min() && value <= kMaxMagnitude)) {
        entry.member("pipe")->report(
            "out_of_range", "the soil's reactions and their displacements must be positive and finite");
        return false;
      }
    }
  }
  return true;
}

/// Returns whether the soil above a nearly horizontal member lies on its left; nullopt when its nodes are
/// unreadable, and after a report.
std::optional<bool> FoundationList::above_is_left(const Value& entry, const json& member) {
  const json* start = nodes_.named_by(member, "start");
  const json* end = nodes_.named_by(member, "end");
  if (start == nullptr || end == nullptr) {
    return std::nullopt;
  }
  const double dx = ById::number(*end, "x") - ById::number(*start, "x");
  const double dy = ById::number(*end, "y") - ById::number(*start, "y");
  if (!std::isfinite(dx) || !std::isfinite(dy)) {
    return std::nullopt;
  }
  const json* curve = ById::field(member, "curve");
  const json* type = curve != nullptr ? ById::field(*curve, "type") : nullptr;
  if ((type != nullptr && *type != "line") || std::abs(dy) > kLargestPipeSlope * std::abs(dx)) {
    entry.member("member")->report("not_supported",
                                   "a pipe in a vertical plane must be straight, with a slope of at most " +
                                       checks::text(kLargestPipeSlope));
    return std::nullopt;
  }
  return dx > 0.0;
}

/// Adds the foundations that an entry gives, with its displacement of the ground.
void FoundationList::add_all(const Value& entry, std::size_t index, json made) {
  for (json& foundation : made) {
    if (const json* displacement = ById::field(entry.json(), "displacement")) {
      foundation["displacement"] = *displacement;
    }
    listed_.foundations.push_back({index, std::move(foundation)});
  }
}

/// Adds a foundation without stiffness and law for an entry with a mistake.
void FoundationList::add_unknown(std::size_t index, const std::string& id, const std::string& member) {
  report_.mark_unreadable(model_.pointer() + "/foundations/" + std::to_string(index));
  json unknown{{"id", id}, {"member", member}};
  listed_.foundations.push_back({index, std::move(unknown)});
}

/// Adds the springs at the lower end of a pile; false after a report.
bool FoundationList::add_base(const Value& entry, std::size_t index, const GivenSoil& soil,
                              const Shaft& shaft) {
  json springs = soil::write_base(profile_of(soil), shaft.pile, {shaft.lower, shaft.across, shaft.down});
  if (springs.empty()) {
    entry.member("base")->report(
        "not_supported",
        "the soil at the lower end of the member has no base resistance: soil of PISA "
        "has, and layers with end_bearing");
    return false;
  }
  for (json& spring : springs) {
    listed_.springs.push_back({index, std::move(spring)});
  }
  return true;
}

/// Returns the soil that an entry names; null when it is unknown or has a mistake.
const GivenSoil* FoundationList::soil_of(const Value& entry, const SoilEntry& data) {
  const auto found =
      std::find_if(soils_.begin(), soils_.end(), [&](const GivenSoil& one) { return one.id == data.soil; });
  if (found != soils_.end()) {
    return report_.covers(pointer_of(*found)) ? nullptr : &*found;
  }
  if (!report_.covers(model_.pointer() + "/soils")) {
    entry.member("soil")->report("unknown_reference", "there is no soil " + checks::in_quotes(data.soil));
  }
  return nullptr;
}

/// Returns the member of an entry, by depths below the ground's surface; nullopt when it or its nodes are
/// unknown or unreadable, and after a report.
std::optional<Shaft> FoundationList::shaft_of(const Value& entry, const SoilEntry& data) {
  const Value name = *entry.member("member");
  const json* member = member_of(entry, data.id, data.member);
  const json* start = member != nullptr ? nodes_.named_by(*member, "start") : nullptr;
  const json* end = member != nullptr ? nodes_.named_by(*member, "end") : nullptr;
  if (start == nullptr || end == nullptr) {
    return std::nullopt;
  }
  const json* curve = ById::field(*member, "curve");
  if (const json* type = curve != nullptr ? ById::field(*curve, "type") : nullptr;
      type != nullptr && *type != "line") {
    name.report("not_supported", "a member in soil must be straight");
    return std::nullopt;
  }
  const double y0 = ById::number(*start, "y"), y1 = ById::number(*end, "y");
  const double dx = ById::number(*end, "x") - ById::number(*start, "x");
  const double length = std::hypot(dx, y1 - y0);
  if (!(std::abs(y0) <= kMaxMagnitude && std::abs(y1) <= kMaxMagnitude && length <= kMaxMagnitude)) {
    return std::nullopt;
  }
  if (std::abs(y1 - y0) <= kMinRelativeChord * length) {
    name.report("not_supported", "a member in soil must not be horizontal");
    return std::nullopt;
  }
  const std::optional<double> diameter = data.diameter ? data.diameter : diameter_of(entry, *member);
  if (!diameter) {
    return std::nullopt;
  }
  Shaft shaft;
  soil::Pile& pile = shaft.pile;
  pile.id = data.id;
  pile.member = data.member;
  pile.diameter = *diameter;
  pile.length = std::abs(y1 - y0);
  pile.head_is_start = y0 > y1;
  pile.head_depth = data.ground_level - std::max(y0, y1);
  pile.force_factor = data.force_factor;
  pile.displacement_factor = data.displacement_factor;
  const double sense = pile.head_is_start ? 1.0 : -1.0;
  shaft.across = {(y0 - y1) / length, dx / length};
  shaft.down = {sense * dx / length, sense * (y1 - y0) / length};
  shaft.upper = ById::field(pile.head_is_start ? *start : *end, "id")->get<std::string>();
  shaft.lower = ById::field(pile.head_is_start ? *end : *start, "id")->get<std::string>();
  return shaft;
}

/// Returns the member of an entry, and checks the entry's id; null when the member is unknown.
const json* FoundationList::member_of(const Value& entry, const std::string& id, const std::string& member) {
  std::vector<Finding> findings;
  checks::Ids("foundation").add(checks::Place(PointerPath(entry.pointer() + "/id"), findings), id);
  for (Finding& finding : findings) {
    report_.add(finding.pointer, finding.code, std::move(finding.detail));
  }
  const json* found = members_.find(member);
  if (found == nullptr && !report_.covers(model_.pointer() + "/members")) {
    entry.member("member")->report("unknown_reference", "there is no member " + checks::in_quotes(member));
  }
  return found;
}

/// Returns the outer diameter of the tube that is a member's section; nullopt after a report, and when the
/// section is unreadable.
std::optional<double> FoundationList::diameter_of(const Value& entry, const json& member) {
  const json* section = sections_.named_by(member, "section");
  const json* shape = section != nullptr ? ById::field(*section, "shape") : nullptr;
  const json* type = shape != nullptr ? ById::field(*shape, "type") : nullptr;
  if (type != nullptr && *type == "tube") {
    const double diameter = ById::number(*shape, "diameter");
    return diameter > 0.0 && diameter <= kMaxMagnitude ? std::optional(diameter) : std::nullopt;
  }
  if (section != nullptr) {
    entry.report(
        "missing_field",
        "a foundation in soil needs the diameter of its pile or pipe when the member's section is no "
        "tube given by its shape");
  }
  return std::nullopt;
}

/// Returns whether a pile stands in the ground, and the soil reaches its tip; reports which does not hold.
bool FoundationList::reaches(const Value& entry, const GivenSoil& soil, const SoilEntry& data,
                             const soil::Pile& pile) {
  const std::string member = "member " + checks::in_quotes(data.member);
  const double tolerance = kMinRelativeChord * pile.length;
  if (pile.tip_depth() <= tolerance) {
    entry.member("member")->report("out_of_range", member + " is above ground, whose surface is at y = " +
                                                       checks::text(data.ground_level));
    return false;
  }
  if (soil.bottom() < pile.tip_depth() - tolerance) {
    report_.add(pointer_of(soil) + "/layers/" + std::to_string(soil.layers.size() - 1) + "/bottom",
                "out_of_range",
                "the layers must reach the lower end of " + member + " at depth " +
                    checks::text(pile.tip_depth()) + ", got " + checks::text(soil.bottom()));
    return false;
  }
  return true;
}

/// Returns the foundations of a pile; null after a report.
json FoundationList::foundations_of(const GivenSoil& soil, const soil::Pile& pile) {
  std::vector<Finding> findings;
  json made = soil::write_foundations(profile_of(soil), pile, numbers_by_depth_, findings);
  for (Finding& finding : findings) {
    report_.add(pointer_of(soil) + finding.pointer, finding.code,
                "foundation " + checks::in_quotes(pile.id) + ": " + finding.detail);
  }
  return findings.empty() ? made : json();
}

}  // namespace

bool has_soil(const json& model) {
  if (!model.is_object()) {
    return false;
  }
  const json* entries = ById::field(model, "foundations");
  return model.contains("soils") || (entries != nullptr && entries->is_array() &&
                                     std::any_of(entries->begin(), entries->end(), [](const json& one) {
                                       return names_soil(one) || has_pipe(one);
                                     }));
}

ListedSupports list_foundations(const Value& model) { return FoundationList(model).list(); }

}  // namespace snapthrough::api
