#include "api/plot/law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "api/list_foundations.h"

namespace snapthrough::api::plot {

AlongMember read_number_along(const Field& field) {
  const auto need_not_negative = [](const Field& place, double value) {
    if (value < 0) {
      place.fail("must not be negative");
    }
  };
  if (!field.json().is_object()) {
    const double value = field.number();
    need_not_negative(field, value);
    return value;
  }
  const Field along = field.at("along");
  Along<double> points;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const std::vector<double> pair = along.item(i).numbers(2);
    need_not_negative(along.item(i).item(1), pair[1]);
    if (!points.empty() && !(pair[0] > points.back().first)) {
      along.item(i).item(0).fail("must be more than the fraction before it");
    }
    points.emplace_back(pair[0], pair[1]);
  }
  if (points.empty()) {
    along.fail("must have a pair of a fraction and a number");
  }
  return AlongMember(std::move(points));
}

namespace {

/// Reads the points (w, p) of a table, whose displacements ascend from the origin.
std::vector<std::array<double, 2>> read_points(const Field& field) {
  std::vector<std::array<double, 2>> points;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const std::vector<double> pair = field.item(i).numbers(2);
    const bool is_origin = i == 0 && pair[0] == 0 && pair[1] == 0;
    const bool is_first = points.empty() || (points.size() == 1 && points[0][0] == 0);
    const std::array<double, 2> last = points.empty() ? std::array<double, 2>{} : points.back();
    if (!is_origin && !(pair[0] > last[0])) {
      field.item(i).item(0).fail("displacements must ascend from the origin (0, 0)");
    }
    if (!is_origin && !(is_first ? pair[1] > 0 : pair[1] >= 0)) {
      field.item(i).item(1).fail(is_first ? "the first force beside the origin must be positive"
                                          : "forces must not be negative");
    }
    points.push_back({pair[0], pair[1]});
  }
  if (points.empty() || points.back()[0] == 0) {
    field.fail("a table needs a point beside the origin");
  }
  return points;
}

}  // namespace

ReactionLaw read_reaction_law(const Field& field) {
  const Field type = field.at("type");
  const std::string name = type.text();
  ReactionLaw law;
  if (name == "table") {
    law.type = ReactionLaw::Type::table;
    law.points = read_points(field.at("points"));
    const std::optional<Field> factor = field.find("factor");
    law.factor = factor ? read_number_along(*factor) : AlongMember(1);
    const std::string between = text_or(field, "interpolation", "monotone_cubic");
    if (between != "monotone_cubic" && between != "linear") {
      field.at("interpolation").fail("must be monotone_cubic or linear");
    }
    law.interpolation =
        between == "linear" ? ReactionLaw::Interpolation::linear : ReactionLaw::Interpolation::monotone_cubic;
    return law;
  }
  law.stiffness = read_number_along(field.at("stiffness"));
  law.capacity = read_number_along(field.at("capacity"));
  if (name == "tanh") {
    law.type = ReactionLaw::Type::tanh;
  } else if (name == "hyperbolic") {
    law.type = ReactionLaw::Type::hyperbolic;
  } else if (name == "power") {
    law.type = ReactionLaw::Type::power;
    law.reference = field.at("reference").number();
    law.exponent = field.at("exponent").number();
    if (!(law.reference > 0)) {
      field.at("reference").fail("must be more than 0");
    }
    if (!(law.exponent > 0 && law.exponent < 1)) {
      field.at("exponent").fail("must be more than 0 and less than 1");
    }
  } else {
    type.fail("must be tanh, hyperbolic, power or table");
  }
  return law;
}

FoundationLaw law_in_units_of_model(const ReactionLaw& given) {
  Foundation foundation;
  foundation.law = given;
  return law_of(foundation, Scales{});
}

namespace {

/// Sets reach and ends of p = min(k w, P (w/w0)^n, P). The line meets the power before it meets the capacity
/// where k w0 > P.
void set_power_parts(const ReactionLaw& given, LawCurve& curve) {
  const double yielding = curve.law.capacity / curve.law.stiffness;
  curve.reach = std::max(yielding, given.reference);
  curve.ends = {yielding};
  if (yielding < given.reference) {
    curve.ends = {given.reference * std::pow(yielding / given.reference, 1 / (1 - given.exponent)),
                  given.reference};
  }
}

/// Returns the displacement of the first of the last points of a table that have the same force.
double constant_from(const std::vector<std::array<double, 2>>& points) {
  std::size_t first = points.size() - 1;
  while (first > 0 && points[first - 1][1] == points.back()[1]) {
    --first;
  }
  return points[first][0];
}

void set_parts(const ReactionLaw& given, LawCurve& curve) {
  if (!(curve.law.stiffness > 0 && curve.law.capacity > 0)) {
    curve.flat_from = curve.law.stiffness > 0 ? curve.flat_from : 0;  // linear, or zero
    return;
  }
  const double yielding = curve.law.capacity / curve.law.stiffness;
  if (given.type == ReactionLaw::Type::table) {
    for (const auto& [w, p] : given.points) {
      if (w > 0) {
        curve.ends.push_back(w);
      }
    }
    curve.reach = curve.ends.back();
    curve.flat_from = constant_from(given.points);
  } else if (given.type == ReactionLaw::Type::power) {
    set_power_parts(given, curve);
    curve.flat_from = curve.ends.back();
  } else if (given.type != ReactionLaw::Type::linear) {
    // nine tenths of the capacity: tanh 1.5 = 0.905, and 9 / (1 + 9) of laws that approach it slowly
    curve.reach = (given.type == ReactionLaw::Type::tanh ? 1.5 : 9.0) * yielding;
  }
}

}  // namespace

LawCurve law_curve_at(const ReactionLaw& given, const FoundationLaw& law, double fraction) {
  LawCurve curve{fraction, law.at(fraction), 0, {}};
  set_parts(given, curve);
  return curve;
}

std::pair<double, bool> read_gap_of_law(const Field& support, const std::string& reaction) {
  const std::optional<Field> gap = support.find("gap");
  if (!gap || reaction == "bilateral") {
    return {0, false};
  }
  if (gap->json().is_object()) {
    return {0, true};
  }
  const double value = gap->number();
  if (value < 0) {
    gap->fail("must not be negative");
  }
  return {value, false};
}

std::string read_reaction_sense(const Field& support) {
  const std::string reaction = text_or(support, "reaction", "bilateral");
  if (reaction != "bilateral" && reaction != "compression_only" && reaction != "tension_only") {
    support.at("reaction").fail("must be bilateral, compression_only or tension_only");
  }
  return reaction;
}

namespace {

/// Returns whether a number of the law varies along the member.
bool varies(const ReactionLaw& law) {
  return law.stiffness.varies() || law.capacity.varies() || law.factor.varies();
}

/// Reads the fractions of the member's length at which curves are drawn.
std::vector<double> read_fractions(const Field& support, bool law_varies) {
  const std::optional<Field> range = support.find("range");
  const std::vector<double> ends = range ? range->numbers(2) : std::vector<double>{0, 1};
  if (!law_varies) {
    return {ends[0]};
  }
  return {ends[0], 0.5 * (ends[0] + ends[1]), ends[1]};
}

SupportLaw read_support(const Field& support, bool is_spring) {
  SupportLaw out;
  out.id = support.at("id").text();
  out.type = support.at("law").at("type").text();
  out.is_spring = is_spring;
  const std::optional<Field> direction = support.find("direction");
  out.turns = is_spring ? direction && direction->json() == "rotation"
                        : text_or(support, "component", "normal") == "rotation";
  out.reaction = read_reaction_sense(support);
  std::tie(out.gap, out.gap_varies) = read_gap_of_law(support, out.reaction);
  const ReactionLaw given = read_reaction_law(support.at("law"));
  const FoundationLaw law = law_in_units_of_model(given);
  out.form = law.curve;
  double reach = 0;
  for (const double fraction : read_fractions(support, varies(given))) {
    out.curves.push_back(law_curve_at(given, law, fraction));
    reach = std::max(reach, out.curves.back().reach);
  }
  if (!(reach > 0 && std::isfinite(reach))) {
    support.at("law").fail("has a reaction of zero, or too large a displacement, wherever it would be drawn");
  }
  return out;
}

struct Candidate {
  Field support;
  bool is_spring;
  std::string id;
};

/// Returns the springs and the foundations of a model that have a law, or that have the given id.
std::vector<Candidate> candidates_of(const Field& model, const std::optional<std::string>& id) {
  std::vector<Candidate> found;
  for (const char* list : {"springs", "foundations"}) {
    const std::optional<Field> all = model.find(list);
    for (std::size_t i = 0; all && i < all->size(); ++i) {
      const Field support = all->item(i);
      const std::string name = support.at("id").text();
      if (support.find("law") || name == id) {
        found.push_back({support, list == std::string_view("springs"), name});
      }
    }
  }
  return found;
}

/// Throws the reason why a model has no law of the id.
[[noreturn]] void fail_without_law(const Field& model, const std::vector<Candidate>& all,
                                   const std::string& id) {
  std::string names;
  for (const Candidate& one : all) {
    if (one.id == id) {
      one.support.fail("has a stiffness and no law, and a figure of kind law draws a law");
    }
    names += (names.empty() ? "" : ", ") + one.id;
  }
  model.fail("has no spring or foundation with the id \"" + id + "\"; " +
             (names.empty() ? "none has a law" : "those with a law are: " + names));
}

}  // namespace

SupportLaw read_support_law(const Field& model, const std::optional<std::string>& id) {
  if (has_soil(model.json())) {
    const nlohmann::json made = with_laws_of_soil(model.json());
    return read_support_law(Field(made, PointerPath(model.pointer())), id);
  }
  const std::vector<Candidate> all = candidates_of(model, id);
  const auto chosen = std::find_if(all.begin(), all.end(), [&](const Candidate& one) {
    return (!id || one.id == *id) && one.support.find("law");
  });
  if (chosen != all.end()) {
    return read_support(chosen->support, chosen->is_spring);
  }
  if (id) {
    fail_without_law(model, all, *id);
  }
  model.fail("no spring and no foundation of the model has a law, which a figure of kind law draws");
}

}  // namespace snapthrough::api::plot
