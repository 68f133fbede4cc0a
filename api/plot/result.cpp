#include "api/plot/result.h"

#include <algorithm>

#include "api/plot/geometry.h"
#include "api/plot/plot_error.h"

namespace snapthrough::api::plot {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Returns the digits of the number at the beginning of a text, without leading zeros.
std::string_view leading_number(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) {
    ++end;
  }
  text = text.substr(0, end);
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
  return text;
}

bool comes_before(std::string_view a, std::string_view b) {
  const std::string_view first = a;
  const std::string_view second = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view p = leading_number(a);
      const std::string_view q = leading_number(b);
      if (p != q) {
        return p.size() != q.size() ? p.size() < q.size() : p < q;
      }
      const auto skip = [](std::string_view& text) {
        while (!text.empty() && is_digit(text[0])) {
          text.remove_prefix(1);
        }
      };
      skip(a);
      skip(b);
    } else if (a[0] != b[0]) {
      return a[0] < b[0];
    } else {
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return a.empty() != b.empty() ? a.empty() : first < second;
}

Monitors read_monitors(const Field& table, std::size_t rows) {
  Monitors monitors;
  if (const std::optional<Field> all = table.find("monitors")) {
    for (const auto& [id, values] : all->members()) {
      monitors.emplace(id, values.numbers(rows));
    }
  }
  return monitors;
}

/// Returns the indices of the rows of a branch at which an equilibrium was solved: all, where the document
/// does not tell.
std::vector<std::size_t> read_computed(const Field& branch, std::size_t rows) {
  std::vector<std::size_t> computed;
  const std::optional<Field> all = branch.find("computed");
  computed.reserve(all ? all->size() : rows);
  for (std::size_t i = 0; i < (all ? all->size() : rows); ++i) {
    computed.push_back(all ? all->item(i).index() : i);
    if (computed.back() >= rows) {
      all->item(i).fail("must be the index of one of the " + std::to_string(rows) + " rows");
    }
  }
  return computed;
}

Branch read_branch(const Field& field) {
  Branch branch;
  branch.load_factor = field.at("load_factor").numbers();
  const std::size_t rows = branch.load_factor.size();
  branch.arc_length = field.at("arc_length").increasing();
  if (branch.arc_length.size() != rows) {
    field.at("arc_length").fail("must have as many numbers as load_factor, " + std::to_string(rows));
  }
  branch.monitors = read_monitors(field, rows);
  branch.negative_eigenvalues = field.at("negative_eigenvalues").numbers(rows);
  branch.computed = read_computed(field, rows);
  if (const std::optional<Field> rates = field.find("rates")) {
    branch.rates = Rates{rates->at("load_factor").numbers(rows), read_monitors(*rates, rows)};
  }
  return branch;
}

Branch read_static(const Field& field) {
  Branch branch;
  branch.load_factor = field.at("load_factor").numbers();
  for (std::size_t i = 0; i < branch.load_factor.size(); ++i) {
    branch.arc_length.push_back(static_cast<double>(i));
  }
  branch.monitors = read_monitors(field, branch.load_factor.size());
  branch.negative_eigenvalues = field.at("negative_eigenvalues").numbers_or_none();
  if (branch.negative_eigenvalues.size() != branch.load_factor.size()) {
    field.at("negative_eigenvalues").fail("must have as many values as load_factor");
  }
  return branch;
}

Mark read_mark(const Field& field) {
  const std::optional<Mark> mark = mark_named(field.text());
  if (!mark) {
    field.fail("is a type that no figure knows");
  }
  return *mark;
}

/// Returns the index of the branch of a point. A static analysis has no branches; any index is then valid.
std::size_t read_branch_index(const Field& result, const Field& point) {
  const Field field = point.at("branch");
  const std::size_t index = field.index();
  const std::optional<Field> branches = result.find("branches");
  const std::size_t count = branches ? branches->size() : 0;
  if (count > 0 && index >= count) {
    field.fail("must be the index of one of the " + std::to_string(count) + " branches");
  }
  return index;
}

PeakRange read_peaks(const Field& field) {
  const auto peak = [](const Field& one) {
    return std::pair(one.at("s").number(), one.at("value").number());
  };
  return {peak(field.at("min")), peak(field.at("max"))};
}

MemberState read_member(const Field& field) {
  MemberState state;
  state.s = field.at("s").increasing();
  const std::size_t places = state.s.size();
  if (places < 2) {
    field.at("s").fail("must have two numbers or more");
  }
  const auto read = [&](const char* key) { return field.at(key).numbers(places); };
  state.x0 = read("x0");
  state.y0 = read("y0");
  state.x = read("x");
  state.y = read("y");
  state.u = read("u");
  state.v = read("v");
  state.axial_force = read("axial_force");
  state.shear_force = read("shear_force");
  state.bending_moment = read("bending_moment");
  if (const std::optional<Field> extremes = field.find("extremes")) {
    for (const char* name : {"axial_force", "shear_force", "bending_moment"}) {
      state.extremes.emplace(name, read_peaks(extremes->at(name)));
    }
  }
  return state;
}

Force read_force(const Field& field) {
  return {field.at("fx").number(), field.at("fy").number(), field.at("moment").number()};
}

FoundationState read_foundation(const Field& field) {
  FoundationState state;
  state.s = field.at("s").increasing();
  state.reaction = field.at("reaction").numbers(state.s.size());
  state.displacement = field.at("displacement").numbers(state.s.size());
  state.resultant = read_force(field.at("resultant"));
  if (const std::optional<Field> extremes = field.find("extremes"); extremes && !state.s.empty()) {
    const std::vector<double> places = state.s;
    add_peaks(read_peaks(*extremes), state.s, state.reaction);
    std::vector<double> displacement;
    displacement.reserve(state.s.size());
    for (const double s : state.s) {
      displacement.push_back(interpolate(places, state.displacement, s));
    }
    state.displacement = std::move(displacement);
  }
  const Field contact = field.at("contact");
  for (std::size_t i = 0; i < contact.size(); ++i) {
    const std::vector<double> ends = contact.item(i).increasing();
    if (ends.size() != 2) {
      contact.item(i).fail("must have two numbers");
    }
    state.contact.emplace_back(ends[0], ends[1]);
  }
  return state;
}

}  // namespace

void add_peaks(const PeakRange& peaks, std::vector<double>& s, std::vector<double>& values) {
  for (const auto& [place, value] : {peaks.min, peaks.max}) {
    const auto next = std::lower_bound(s.begin(), s.end(), place);
    if (next != s.end() && *next == place) {
      continue;
    }
    values.insert(values.begin() + (next - s.begin()), value);
    s.insert(next, place);
  }
}

std::vector<Branch> read_branches(const Field& result) {
  std::vector<Branch> branches;
  if (const std::optional<Field> all = result.find("branches")) {
    for (std::size_t i = 0; i < all->size(); ++i) {
      branches.push_back(read_branch(all->item(i)));
    }
  }
  const std::optional<Field> table = result.find("static");
  if (branches.empty() && table) {
    branches.push_back(read_static(*table));
  }
  return branches;
}

std::vector<CriticalPoint> read_critical_points(const Field& result) {
  std::vector<CriticalPoint> points;
  const std::optional<Field> all = result.find("critical_points");
  for (std::size_t i = 0; all && i < all->size(); ++i) {
    const Field field = all->item(i);
    CriticalPoint point;
    point.branch = read_branch_index(result, field);
    point.mark = read_mark(field.at("type"));
    point.load_factor = field.at("load_factor").number();
    point.arc_length = field.at("arc_length").number();
    point.confirmed = field.at("confirmed").flag();
    if (const std::optional<Field> monitors = field.find("monitors")) {
      for (const auto& [id, value] : monitors->members()) {
        point.monitors.emplace(id, value.number());
      }
    }
    if (const std::optional<Field> state = field.find("state")) {
      point.state = state->index();
    }
    points.push_back(std::move(point));
  }
  return points;
}

std::optional<Softest> read_softest(const Field& result) {
  const std::optional<Field> summary = result.find("summary");
  const std::optional<Field> softest = summary ? summary->find("softest") : std::nullopt;
  if (!softest) {
    return std::nullopt;
  }
  const Softest found{softest->at("load_factor").number(), softest->at("stiffness_ratio").number()};
  return found.ratio > 0 ? std::optional(found) : std::nullopt;  // ratio 0: a critical point
}

std::optional<FirstYield> read_first_yield(const Field& result) {
  const std::optional<Field> yield = result.find("first_yield");
  if (!yield) {
    return std::nullopt;
  }
  return FirstYield{yield->at("load_factor").number(), yield->at("arc_length").number()};
}

std::vector<ContactEvent> read_contact_events(const Field& result) {
  std::vector<ContactEvent> events;
  const std::optional<Field> all = result.find("contact_events");
  for (std::size_t i = 0; all && i < all->size(); ++i) {
    const Field field = all->item(i);
    events.push_back({read_branch_index(result, field), read_mark(field.at("type")),
                      field.at("load_factor").number(), field.at("arc_length").number()});
  }
  return events;
}

State read_state(const Field& result, std::size_t index) {
  const std::optional<Field> states = result.find("states");
  const std::size_t count = states ? states->size() : 0;
  if (index >= count) {
    throw PlotError("/states/" + std::to_string(index),
                    count == 0
                        ? "the result has no states; analysis.output.states of the request asks for them"
                        : "the result has states 0 to " + std::to_string(count - 1));
  }
  const Field field = states->item(index);
  State state;
  state.load_factor = field.at("load_factor").number();
  for (const auto& [id, member] : field.at("members").members()) {
    state.members.emplace(id, read_member(member));
  }
  if (state.members.empty()) {
    field.at("members").fail("has no member to draw");
  }
  const auto each = [&field](const char* key, const auto& take) {
    if (const std::optional<Field> all = field.find(key)) {
      for (const auto& [id, one] : all->members()) {
        take(id, one);
      }
    }
  };
  each("supports",
       [&](const std::string& id, const Field& one) { state.supports.emplace(id, read_force(one)); });
  each("foundations",
       [&](const std::string& id, const Field& one) { state.foundations.emplace(id, read_foundation(one)); });
  each("springs", [&](const std::string& id, const Field& one) {
    state.springs.emplace(id, SpringState{one.at("closed").flag()});
  });
  return state;
}

std::size_t chosen_state(const Field& result, const std::optional<std::size_t>& asked) {
  if (asked) {
    return *asked;
  }
  for (const CriticalPoint& point : read_critical_points(result)) {
    if (point.state) {
      return *point.state;
    }
  }
  const std::optional<Field> states = result.find("states");
  return states && states->size() > 0 ? states->size() - 1 : 0;
}

Mode read_mode(const Field& mode) {
  Mode shapes;
  for (const auto& [id, field] : mode.at("members").members()) {
    ModeShape shape;
    shape.s = field.at("s").increasing();
    if (shape.s.size() < 2) {
      field.at("s").fail("must have two numbers or more");
    }
    shape.u = field.at("u").numbers(shape.s.size());
    shape.v = field.at("v").numbers(shape.s.size());
    shapes.emplace(id, std::move(shape));
  }
  if (shapes.empty()) {
    mode.at("members").fail("has no member to draw");
  }
  return shapes;
}

Units read_units(const Field& result) {
  const std::optional<Field> model = result.find("model");
  return model ? read_model_units(*model) : Units{};
}

Units read_model_units(const Field& model) {
  const std::optional<Field> units = model.find("units");
  if (!units) {
    return {};
  }
  return {text_or(*units, "length", ""), text_or(*units, "force", ""), text_or(*units, "moment", "")};
}

std::string read_title(const Field& result) {
  const std::optional<Field> model = result.find("model");
  return model ? text_or(*model, "title", "") : "";
}

std::vector<std::string> naturally_sorted(std::vector<std::string> ids) {
  std::sort(ids.begin(), ids.end(),
            [](const std::string& a, const std::string& b) { return comes_before(a, b); });
  return ids;
}

}  // namespace snapthrough::api::plot
