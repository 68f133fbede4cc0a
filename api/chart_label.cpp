#include "api/chart_label.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "api/names.h"

namespace snapthrough::api {
namespace {

/// Counts changes of sign along the members; values below 1e-6 of the largest one have no sign.
int reversals_of(const Mode& mode) {
  double largest = 0.0;
  for (const MemberMode& member : mode.members) {
    for (const double rotation : member.rotation) {
      largest = std::max(largest, std::abs(rotation));
    }
  }
  int count = 0;
  for (const MemberMode& member : mode.members) {
    double last = 0.0;
    for (const double rotation : member.rotation) {
      if (std::abs(rotation) > 1e-6 * largest) {
        count += last * rotation < 0.0 ? 1 : 0;
        last = rotation;
      }
    }
  }
  return count;
}

/// Returns the index in the token that follows the name of a list; 0 for other outputs.
std::size_t number_in(const SweepOutput& output, std::size_t token) {
  return output.tokens.size() > token ? array_index(output.tokens[token]).value_or(0) : 0;
}

const CriticalPoint* point_of(const Result& result, const SweepOutput& output) {
  const auto& points = result.critical_points;
  if (output.tokens[0] == "critical_points") {
    const std::size_t number = number_in(output, 1);
    return number < points.size() ? &points[number] : nullptr;
  }
  const auto found = std::find_if(points.begin(), points.end(), [&](const CriticalPoint& point) {
    return result.summary.critical_load_factor && point.load_factor == *result.summary.critical_load_factor;
  });
  return found != points.end() ? &*found : nullptr;
}

std::map<std::string, int> contact_at(const Result& result, const CriticalPoint& point) {
  std::map<std::string, int> zones;
  for (const ContactEvent& event : result.contact_events) {
    if (event.branch == point.branch && event.arc_length <= point.arc_length) {
      zones[event.id] = event.zones_after;
    }
  }
  return zones;
}

std::string or_none(const std::string& text) { return text.empty() ? "none" : text; }

void add(std::string& all, const std::string& part) { all += (all.empty() ? "" : ", ") + part; }

std::string contact_change(const ChartLabel& before, const ChartLabel& after) {
  std::set<std::string> ids;
  for (const ChartLabel* label : {&before, &after}) {
    for (const auto& [id, zones] : label->contact) {
      ids.insert(id);
    }
  }
  const auto text = [](const ChartLabel& label, const std::string& id) {
    const auto found = label.contact.find(id);
    return found == label.contact.end() ? std::string("as without load") : std::to_string(found->second);
  };
  std::string all;
  for (const std::string& id : ids) {
    if (text(before, id) != text(after, id)) {
      add(all, "contact of " + id + ": " + text(before, id) + " to " + text(after, id) + " zones");
    }
  }
  return all;
}

}  // namespace

std::string ChartLabel::kind() const { return failure + ';' + type + ';' + std::to_string(reversals); }

ChartLabel label_of(const Result& result, const SweepOutput& output) {
  ChartLabel label;
  if (result.buckling) {
    const std::size_t number = number_in(output, 2);
    if (number < result.buckling->modes.size()) {
      label.reversals = reversals_of(result.buckling->modes[number]);
    }
    return label;
  }
  if (const CriticalPoint* point = point_of(result, output)) {
    label.type = name_of(kCriticalTypes, point->type);
    label.contact = contact_at(result, *point);
  }
  return label;
}

std::string change_between(const ChartLabel& before, const ChartLabel& after, bool jumps,
                           bool has_value_before, bool has_value_after) {
  std::string all;
  if (!has_value_after && has_value_before) {
    add(all, "no value");
  } else if (has_value_after && !has_value_before) {
    add(all, "value begins");
  }
  if (jumps) {
    add(all, "jump");
  }
  if (before.failure != after.failure) {
    add(all, "failure: " + or_none(before.failure) + " to " + or_none(after.failure));
  }
  if (before.type != after.type) {
    add(all, "type: " + or_none(before.type) + " to " + or_none(after.type));
  }
  if (before.reversals != after.reversals) {
    add(all, "mode: " + std::to_string(before.reversals) + " to " + std::to_string(after.reversals) +
                 " turning points");
  }
  if (const std::string contact = contact_change(before, after); !contact.empty()) {
    add(all, contact);
  }
  return all;
}

}  // namespace snapthrough::api
