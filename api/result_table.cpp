#include "api/result_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "api/csv_field.h"
#include "api/field_json.h"
#include "api/names.h"
#include "api/result_fields.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

constexpr const char* kLineEnd = "\r\n";
/// All but the first are also the members of a result that have what they need.
constexpr Named<ResultTable> kResultTables[] = {
    {"points", ResultTable::points},         {"critical_points", ResultTable::critical_points},
    {"static", ResultTable::static_rows},    {"buckling", ResultTable::buckling},
    {"vibrations", ResultTable::vibrations}, {"states", ResultTable::states}};

void append(std::string& text, double value) {
  std::array<char, 40> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end);
}

void append(std::string& text, int value) { text += std::to_string(value); }

template <class T>
void append(std::string& text, const std::optional<T>& value) {
  if (value) append(text, *value);
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

/// The value of a series at a point; nothing where the branch has no such series.
void append_value(std::string& text, const std::vector<NamedSeries>& all, const std::string& id,
                  std::size_t point) {
  const auto series =
      std::find_if(all.begin(), all.end(), [&](const NamedSeries& one) { return one.id == id; });
  if (series != all.end() && point < series->values.size()) {
    append(text, series->values[point]);
  }
}

/// Appends so many fields, the last ones empty where there are fewer values.
void append_padded(std::string& text, const std::vector<double>& values, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    text += ',';
    if (i < values.size()) append(text, values[i]);
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

/// Elements of a list; none where the value is no list.
std::span<const Json> elements(const Json& list) {
  return list.is_array() ? std::span(list.get_ref<const Json::array_t&>()) : std::span<const Json>();
}

template <class T>
inline constexpr bool kIsScalar =
    std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>;
template <class T>
inline constexpr bool kIsScalar<std::optional<T>> = kIsScalar<T>;

/// The type of one row's value: that of an element of a list.
template <class T>
struct InRow {
  using Type = T;
};
template <class T>
struct InRow<std::vector<T>> {
  using Type = T;
};

template <class T>
inline constexpr bool kIsById =
    std::is_same_v<T, std::vector<NamedSeries>> || std::is_same_v<T, std::vector<NamedValue>> ||
    std::is_same_v<T, std::optional<std::vector<NamedValue>>>;

/// Calls visit(field) for the fields of T that tables have a column for: numbers and texts, or lists of them.
template <class T, class Visit>
void for_each_column(const Visit& visit) {
  constexpr bool are_lists =
      std::is_same_v<T, Branch> || std::is_same_v<T, StaticTable> || std::is_same_v<T, MemberState>;
  for_each_field<T>([&](const auto& one) {
    using Value = ValueOf<T, FieldOf<decltype(one)>>;
    if constexpr (!FieldOf<decltype(one)>::is(kInternal) && !FieldOf<decltype(one)>::is(kKey) &&
                  !FieldOf<decltype(one)>::is(kNoColumn) && are_lists == kIsVector<Value> &&
                  kIsScalar<typename InRow<Value>::Type>) {
      visit(one);
    }
  });
}

/// Calls visit() for each field that has a column for each id.
template <class T, class Visit>
void for_each_column_by_id(const Visit& visit) {
  for_each_field<T>([&](const auto& one) {
    if constexpr (!FieldOf<decltype(one)>::is(kInternal) && !FieldOf<decltype(one)>::is(kNoColumn) &&
                  kIsById<ValueOf<T, FieldOf<decltype(one)>>>)
      visit(one);
  });
}

template <class T>
std::vector<std::string> columns_of() {
  std::vector<std::string> names;
  for_each_column<T>([&](const auto& one) { names.emplace_back(one.name); });
  return names;
}

/// A column is named by the id alone where it is a monitor's displacement, else "field:id".
std::string column_name(std::string_view field, const std::string& id) {
  return field == "monitors" ? id : std::string(field) + ":" + id;
}

/// A header line and rows, each as many fields.
class Rows {
 public:
  explicit Rows(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  void add_column(std::string name) { columns_.push_back(std::move(name)); }
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

/// Field and id of the columns by id of a table.
using Columns = std::vector<std::pair<std::string, std::string>>;

/// Adds the columns by id of a table; the ids of a field are the keys of the first object that has any.
template <class T>
Columns columns_by_id(std::span<const Json> objects, Rows& rows) {
  Columns columns;
  for_each_column_by_id<T>([&](const auto& one) {
    const std::string name(one.name);
    for (const Json& object : objects) {
      if (member(object, name).empty()) continue;
      for (const auto& item : member(object, name).items()) {
        rows.add_column(column_name(name, item.key()));
        columns.emplace_back(name, item.key());
      }
      return;
    }
  });
  return columns;
}

std::string critical_points_csv(const Json& result) {
  const std::vector<std::string> fields = columns_of<CriticalPoint>();
  const Json& points = member(result, "critical_points");
  Rows rows(fields);
  const Columns columns = columns_by_id<CriticalPoint>(elements(points), rows);
  rows.begin();
  for (const Json& point : points) {
    for (const std::string& field : fields) {
      rows.field(member(point, field));
    }
    for (const auto& [field, id] : columns) {
      rows.field(member(member(point, field), id));
    }
    rows.end_row();
  }
  return rows.take();
}

/// Names of the columns of frequencies.
std::vector<std::string> frequency_columns(std::size_t squares, std::size_t imaginary) {
  std::vector<std::string> out;
  for (std::size_t i = 1; i <= squares; ++i) out.push_back("omega_squared:" + std::to_string(i));
  for (std::size_t i = 1; i <= imaginary; ++i) out.push_back("imaginary:" + std::to_string(i));
  return out;
}

std::string static_csv(const Json& result) {
  const std::vector<std::string> fields = columns_of<StaticTable>();
  const Json& table = member(result, "static");
  Rows rows(fields);
  std::vector<const Json*> series;
  series.reserve(fields.size());
  for (const std::string& field : fields) series.push_back(&member(table, field));
  for (const auto& [field, id] : columns_by_id<StaticTable>({&table, 1}, rows)) {
    series.push_back(&member(member(table, field), id));
  }
  const Json& frequencies = member(table, "frequencies");
  std::size_t squares = 0;
  std::size_t imaginary = 0;
  for (const Json& one : elements(frequencies)) {
    squares = std::max(squares, member(one, "omega_squared").size());
    imaginary = std::max(imaginary, member(one, "imaginary").size());
  }
  for (std::string& name : frequency_columns(squares, imaginary)) rows.add_column(std::move(name));
  rows.begin();
  for (std::size_t i = 0; i < member(table, "load_factor").size(); ++i) {
    for (const Json* one : series) {
      rows.field(element(*one, i));
    }
    const Json& here = element(frequencies, i);
    for (std::size_t k = 0; k < squares; ++k) rows.field(element(member(here, "omega_squared"), k));
    for (std::size_t k = 0; k < imaginary; ++k) rows.field(element(member(here, "imaginary"), k));
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

std::string vibrations_csv(const Json& result) {
  Rows rows({"load_factor", "mode", "omega_squared", "imaginary", "error_estimate"});
  rows.begin();
  for (const Json& vibration : elements(member(result, "vibrations"))) {
    const Json& frequencies = member(vibration, "frequencies");
    const Json& squares = member(frequencies, "omega_squared");
    const Json& imaginary = member(frequencies, "imaginary");
    for (std::size_t i = 0; i < squares.size(); ++i) {
      rows.field(member(vibration, "load_factor")).field(i + 1).field(squares[i]);
      rows.field(imaginary.is_null() ? Json(0.0) : element(imaginary, i));
      rows.field(element(member(vibration, "error_estimates"), i)).end_row();
    }
  }
  return rows.take();
}

const std::vector<std::string>& columns_along_members() {
  static const std::vector<std::string> kColumns = columns_of<MemberState>();
  return kColumns;
}

Rows rows_of_states() {
  std::vector<std::string> columns{"state", "branch", "load_factor", "member"};
  columns.insert(columns.end(), columns_along_members().begin(), columns_along_members().end());
  return Rows(std::move(columns));
}

void add_state(const Json& state, std::size_t number, Rows& rows) {
  for (const auto& [id, along] : member(state, "members").items()) {
    for (std::size_t place = 0; place < member(along, "s").size(); ++place) {
      rows.field(number).field(member(state, "branch")).field(member(state, "load_factor")).field(id);
      for (const std::string& name : columns_along_members()) {
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
  static constexpr std::array kVibration{ResultTable::vibrations, ResultTable::static_rows,
                                         ResultTable::states};
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
    case AnalysisType::vibration:
      return kVibration;
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

PointsTable::PointsTable(std::vector<Branch> branches) : branches_(std::move(branches)) {
  for_each_column_by_id<Branch>([&](const auto& one) {
    for (const Branch& branch : branches_) {
      for (const NamedSeries& series : std::invoke(one.get, branch)) {
        const std::pair column(std::string(one.name), series.id);
        if (std::find(by_id_.begin(), by_id_.end(), column) == by_id_.end()) {
          by_id_.push_back(column);
        }
      }
    }
  });
  for (const Branch& branch : branches_) {
    for (const auto& point : branch.frequencies) {
      squares_ = std::max(squares_, point ? point->squares.size() : 0);
      imaginary_ = std::max(imaginary_, point ? point->imaginary.size() : 0);
    }
  }
}

void PointsTable::append_head(std::string& csv) const {
  csv += "branch,point";
  for_each_column<Branch>([&](const auto& one) { csv.append(1, ',').append(one.name); });
  for (const auto& [field, id] : by_id_) {
    append_csv_text(csv += ',', column_name(field, id));
  }
  for (const std::string& name : frequency_columns(squares_, imaginary_)) csv.append(1, ',').append(name);
  csv += kLineEnd;
}

void PointsTable::append_row(const Branch& branch, std::size_t point, std::string& csv) const {
  csv += std::to_string(branch.id) + "," + std::to_string(point);
  for_each_column<Branch>([&](const auto& one) {
    csv += ',';
    const auto& values = std::invoke(one.get, branch);
    if (point < values.size()) {
      append(csv, values[point]);
    }
  });
  for (const auto& [name, of_id] : by_id_) {
    csv += ',';
    for_each_column_by_id<Branch>([&, &field = name, &id = of_id](const auto& one) {
      if (one.name == field) {
        append_value(csv, std::invoke(one.get, branch), id, point);
      }
    });
  }
  const bool known = point < branch.frequencies.size() && branch.frequencies[point];
  const Frequencies here = known ? *branch.frequencies[point] : Frequencies();
  append_padded(csv, here.squares, squares_);
  append_padded(csv, here.imaginary, imaginary_);
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
    numbers += branch.load_factor.size() * (5 + by_id_.size() + squares_ + imaginary_);
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
    case ResultTable::vibrations:
      return vibrations_csv(result);
    case ResultTable::states:
      return states_csv(result);
    case ResultTable::points:
      break;
  }
  throw std::invalid_argument("the points of paths are a PointsTable");
}

}  // namespace snapthrough::api
