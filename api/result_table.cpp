#include "api/result_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "api/csv_field.h"
#include "api/names.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

constexpr const char* kLineEnd = "\r\n";
/// All but the first are also the members of a result that have what they need.
constexpr Named<ResultTable> kResultTables[] = {{"points", ResultTable::points},
                                                {"critical_points", ResultTable::critical_points},
                                                {"static", ResultTable::static_rows},
                                                {"buckling", ResultTable::buckling},
                                                {"states", ResultTable::states}};

void append(std::string& text, double value) {
  std::array<char, 40> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end);
}

void append(std::string& text, const Json& value) {
  if (value.is_number_float()) {
    append(text, value.get<double>());
  } else if (value.is_string()) {
    append_csv_text(text, value.get<std::string>());
  } else if (!value.is_null()) {
    append_csv_field(text, value.dump());
  }
}

/// The member, or null.
const Json& member(const Json& object, const std::string& key) {
  static const Json none;
  const auto found = object.is_object() ? object.find(key) : object.end();
  return object.is_object() && found != object.end() ? *found : none;
}

/// The element, or null where the list has ended.
const Json& element(const Json& list, std::size_t i) {
  static const Json none;
  return list.is_array() && i < list.size() ? list[i] : none;
}

/// The ids of all branches, each once, in the order they come.
std::vector<std::string> ids_of(const std::vector<Branch>& branches,
                                std::vector<NamedSeries> Branch::*series) {
  std::vector<std::string> ids;
  for (const Branch& branch : branches) {
    for (const NamedSeries& one : branch.*series) {
      if (std::find(ids.begin(), ids.end(), one.id) == ids.end()) {
        ids.push_back(one.id);
      }
    }
  }
  return ids;
}

void append_value(std::string& text, const std::vector<NamedSeries>& series, const std::string& id,
                  std::size_t point) {
  text += ',';
  const auto found =
      std::find_if(series.begin(), series.end(), [&](const NamedSeries& one) { return one.id == id; });
  if (found != series.end() && point < found->values.size()) {
    append(text, found->values[point]);
  }
}

/// A header line and rows, each as many fields.
class Rows {
 public:
  explicit Rows(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  /// More columns, named by the keys of an object.
  void add_columns(const Json& object, const std::string& prefix = "") {
    for (const auto& item : object.items()) {
      columns_.push_back(prefix + item.key());
    }
  }
  void begin() {
    for (const std::string& column : columns_) {
      text_ += text_.empty() ? "" : ",";
      append_csv_text(text_, column);
    }
    text_ += kLineEnd;
  }
  Rows& field(const Json& value) {
    text_ += filled_++ == 0 ? "" : ",";
    append(text_, value);
    return *this;
  }
  void end_row() {
    text_ += kLineEnd;
    filled_ = 0;
  }
  std::string take() { return std::move(text_); }

 private:
  std::vector<std::string> columns_;
  std::string text_;
  std::size_t filled_ = 0;
};

std::string critical_points_csv(const Json& result) {
  const std::vector<std::string> fields{"branch",         "type",         "cause",      "load_factor",
                                        "error_estimate", "confirmed",    "arc_length", "negative_before",
                                        "negative_after", "multiplicity", "state",      "member"};
  const Json& points = member(result, "critical_points");
  Rows rows(fields);
  const Json monitors = points.empty() ? Json() : member(points.front(), "monitors");
  rows.add_columns(monitors);
  rows.begin();
  for (const Json& point : points) {
    for (const std::string& field : fields) {
      rows.field(member(point, field));
    }
    for (const auto& monitor : monitors.items()) {
      rows.field(member(member(point, "monitors"), monitor.key()));
    }
    rows.end_row();
  }
  return rows.take();
}

std::string static_csv(const Json& result) {
  const std::vector<std::string> fields{"load_factor", "negative_eigenvalues", "state"};
  const Json& table = member(result, "static");
  const Json& monitors = member(table, "monitors");
  const Json& contact = member(table, "contact_fraction");
  Rows rows(fields);
  rows.add_columns(monitors);
  rows.add_columns(contact, "contact_fraction:");
  rows.begin();
  for (std::size_t i = 0; i < member(table, "load_factor").size(); ++i) {
    for (const std::string& field : fields) {
      rows.field(element(member(table, field), i));
    }
    for (const Json* series : {&monitors, &contact}) {
      for (const Json& one : *series) {
        rows.field(element(one, i));
      }
    }
    rows.end_row();
  }
  return rows.take();
}

std::string buckling_csv(const Json& result) {
  const Json& buckling = member(result, "buckling");
  Rows rows({"mode", "load_factor", "error_estimate"});
  rows.begin();
  const Json& loads = member(buckling, "load_factors");
  for (std::size_t i = 0; i < loads.size(); ++i) {
    rows.field(i + 1).field(loads[i]).field(element(member(buckling, "error_estimates"), i)).end_row();
  }
  return rows.take();
}

constexpr std::array kAlongMembers{
    "s", "x0", "y0", "x", "y", "u", "v", "rotation", "axial_force", "shear_force", "bending_moment"};

Rows rows_of_states() {
  std::vector<std::string> columns{"state", "branch", "load_factor", "member"};
  columns.insert(columns.end(), kAlongMembers.begin(), kAlongMembers.end());
  return Rows(std::move(columns));
}

void add_state(const Json& state, std::size_t number, Rows& rows) {
  for (const auto& [id, along] : member(state, "members").items()) {
    for (std::size_t place = 0; place < member(along, "s").size(); ++place) {
      rows.field(number).field(member(state, "branch")).field(member(state, "load_factor")).field(id);
      for (const char* name : kAlongMembers) {
        rows.field(element(member(along, name), place));
      }
      rows.end_row();
    }
  }
}

std::string states_csv(const Json& result) {
  Rows rows = rows_of_states();
  rows.begin();
  const Json& states = member(result, "states");
  for (std::size_t i = 0; i < states.size(); ++i) {
    add_state(states[i], i, rows);
  }
  return rows.take();
}

/// The member of a result that has what the table needs.
std::string source_of(ResultTable table) {
  if (table == ResultTable::points) {
    throw std::invalid_argument("the points of paths are a PointsTable");
  }
  return std::string(name_of(kResultTables, table));
}

}  // namespace

std::optional<ResultTable> result_table_from(std::string_view name) { return value_of(kResultTables, name); }

std::span<const ResultTable> tables_of(std::string_view analysis_type) {
  static constexpr std::array kPath{ResultTable::points, ResultTable::critical_points, ResultTable::states};
  static constexpr std::array kCritical{ResultTable::critical_points, ResultTable::states};
  static constexpr std::array kStatic{ResultTable::static_rows, ResultTable::states};
  static constexpr std::array kBuckling{ResultTable::buckling};
  const std::optional<AnalysisType> type = value_of(kAnalysisTypes, analysis_type);
  if (!type) {
    return {};
  }
  switch (*type) {
    case AnalysisType::path:
      return kPath;
    case AnalysisType::critical:
      return kCritical;
    case AnalysisType::static_:
      return kStatic;
    case AnalysisType::buckling:
      return kBuckling;
  }
  return {};
}

std::string table_names(std::span<const ResultTable> tables) {
  std::string names;
  for (const Named<ResultTable>& row : kResultTables) {
    if (std::find(tables.begin(), tables.end(), row.value) != tables.end()) {
      names.append(names.empty() ? "" : ", ").append(row.name);
    }
  }
  return names;
}

PointsTable::PointsTable(std::vector<Branch> branches)
    : branches_(std::move(branches)),
      monitors_(ids_of(branches_, &Branch::monitors)),
      bases_(ids_of(branches_, &Branch::contact_fraction)) {}

void PointsTable::append_head(std::string& csv) const {
  csv += "branch,point,load_factor,arc_length,negative_eigenvalues,stiffness_ratio";
  for (const std::string& id : monitors_) {
    append_csv_text(csv += ',', id);
  }
  for (const std::string& id : bases_) {
    append_csv_field(csv += ',', "contact_fraction:" + id);
  }
  csv += kLineEnd;
}

void PointsTable::append_row(const Branch& branch, std::size_t point, std::string& csv) const {
  csv += std::to_string(branch.id) + "," + std::to_string(point) + ",";
  append(csv, branch.load_factor[point]);
  append(csv += ',', branch.arc_length[point]);
  csv += "," + std::to_string(branch.negative_eigenvalues[point]) + ",";
  if (point < branch.stiffness_ratio.size() && branch.stiffness_ratio[point]) {
    append(csv, *branch.stiffness_ratio[point]);
  }
  for (const std::string& id : monitors_) {
    append_value(csv, branch.monitors, id, point);
  }
  for (const std::string& id : bases_) {
    append_value(csv, branch.contact_fraction, id, point);
  }
  csv += kLineEnd;
}

bool PointsTable::append_rows(std::string& csv, std::size_t bytes) {
  const std::size_t before = csv.size();
  if (!std::exchange(begun_, true)) {
    append_head(csv);
  }
  for (; branch_ < branches_.size(); ++branch_, point_ = 0) {
    for (; point_ < branches_[branch_].load_factor.size(); ++point_) {
      if (csv.size() - before >= bytes) {
        return true;
      }
      append_row(branches_[branch_], point_, csv);
    }
  }
  return false;
}

std::size_t PointsTable::held_bytes() const {
  std::size_t numbers = 0;
  for (const Branch& branch : branches_) {
    numbers += branch.load_factor.size() * (5 + branch.monitors.size() + branch.contact_fraction.size());
  }
  return numbers * sizeof(double);
}

ResultTableReader::ResultTableReader(ResultTable table)
    : table_(table),
      source_(source_of(table), table == ResultTable::states ? JsonPart::elements : JsonPart::value) {}

void ResultTableReader::append(std::string_view piece, std::string& csv) {
  source_.append(piece);
  if (table_ != ResultTable::states) {
    return;
  }
  Rows rows = rows_of_states();
  if (!std::exchange(begun_, true)) {
    rows.begin();
  }
  while (const std::optional<std::string> state = source_.next()) {
    add_state(Json::parse(*state), states_++, rows);
  }
  csv += rows.take();
}

void ResultTableReader::end(std::string& csv) {
  if (table_ == ResultTable::states) {
    return;
  }
  const std::optional<std::string> value = source_.next();
  csv += result_csv({{source_of(table_), value ? Json::parse(*value) : Json(nullptr)}}, table_);
}

std::string result_csv(const Json& result, ResultTable table) {
  switch (table) {
    case ResultTable::critical_points:
      return critical_points_csv(result);
    case ResultTable::static_rows:
      return static_csv(result);
    case ResultTable::buckling:
      return buckling_csv(result);
    case ResultTable::states:
      return states_csv(result);
    case ResultTable::points:
      break;
  }
  throw std::invalid_argument("the points of paths are a PointsTable");
}

}  // namespace snapthrough::api
