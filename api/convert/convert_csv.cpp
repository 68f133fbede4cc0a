/// Reads nodes, members and sections from tables.

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "api/convert/convert.h"
#include "api/convert/csv_table.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api {

namespace convert {
namespace {

using nlohmann::json;

constexpr std::array<Column, 3> kNodeColumns{{{"id"}, {"x"}, {"y"}}};
constexpr std::array<Column, 5> kMemberColumns{
    {{"id"}, {"start"}, {"end"}, {"section"}, {"sweep_degrees", false}}};
constexpr std::array<Column, 9> kSectionColumns{{{"id"},
                                                 {"EA", false},
                                                 {"EI", false},
                                                 {"GA", false},
                                                 {"E", false},
                                                 {"A", false},
                                                 {"I", false},
                                                 {"nu", false},
                                                 {"shear_area", false}}};

/// Tables of a structure, read one after the other: members refer to nodes and sections.
class TableReader {
 public:
  explicit TableReader(std::vector<Finding>& findings) : findings_(findings) {}

  json nodes(const CsvFile& file);
  json sections(const CsvFile& file);
  /// @param sections list that gets an id for each section that members name first; null: only known ids
  json members(const CsvFile& file, json* sections);

 private:
  [[nodiscard]] checks::Place place(const CsvTable& table, std::size_t row, std::string_view column) const {
    return {PointerPath(table.place(row, column)), findings_};
  }

  std::vector<Finding>& findings_;
  checks::Ids nodes_{"node"};
  checks::Ids sections_{"section"};
};

json TableReader::nodes(const CsvFile& file) {
  const CsvTable table(file, kNodeColumns, kMaxNodes, findings_);
  json nodes = json::array();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    WorkLimit::poll();
    nodes_.add(place(table, row, "id"), table.text(row, "id"));
    nodes.push_back({{"id", table.text(row, "id")},
                     {"x", table.number(row, "x", true).value_or(0.0)},
                     {"y", table.number(row, "y", true).value_or(0.0)}});
  }
  return nodes;
}

json TableReader::sections(const CsvFile& file) {
  const CsvTable table(file, kSectionColumns, kMaxSections, findings_);
  json sections = json::array();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    WorkLimit::poll();
    sections_.add(place(table, row, "id"), table.text(row, "id"));
    json section{{"id", table.text(row, "id")}};
    for (const Column& column : kSectionColumns) {
      if (column.is_required) {
        continue;
      }
      if (const auto value = table.number(row, column.name, false)) {
        section[std::string(column.name)] = *value;
      }
    }
    sections.push_back(std::move(section));
  }
  return sections;
}

json TableReader::members(const CsvFile& file, json* sections) {
  const CsvTable table(file, kMemberColumns, kMaxMembers, findings_);
  json members = json::array();
  checks::Ids ids("member");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    WorkLimit::poll();
    json member;
    for (const char* column : {"id", "start", "end", "section"}) {
      member[column] = table.text(row, column);
    }
    ids.add(place(table, row, "id"), table.text(row, "id"));
    nodes_.require(place(table, row, "start"), table.text(row, "start"));
    nodes_.require(place(table, row, "end"), table.text(row, "end"));
    const std::string& section = table.text(row, "section");
    if (sections == nullptr) {
      sections_.require(place(table, row, "section"), section);
    } else if (!sections_.contains(section)) {
      sections_.add(place(table, row, "section"), section);
      sections->push_back({{"id", section}});
    }
    if (const auto sweep = table.number(row, "sweep_degrees", false); sweep && *sweep != 0.0) {
      if (std::abs(*sweep) >= 360.0) {
        place(table, row, "sweep_degrees")
            .report("out_of_range",
                    "sweep_degrees must be above -360 and below 360, got " + checks::text(*sweep));
      }
      member["curve"] = {{"type", "arc"}, {"sweep_degrees", *sweep}};
    }
    members.push_back(std::move(member));
  }
  return members;
}

}  // namespace
}  // namespace convert

Conversion convert_csv(const CsvFiles& files) {
  Conversion conversion;
  convert::TableReader reader(conversion.findings);
  nlohmann::json parts;
  parts["nodes"] = reader.nodes(files.nodes);
  parts["sections"] = files.sections ? reader.sections(*files.sections) : nlohmann::json::array();
  // References into a table with mistakes would be reported as unknown, too.
  if (conversion.findings.empty()) {
    parts["members"] = reader.members(files.members, files.sections ? nullptr : &parts["sections"]);
  }
  if (conversion.findings.empty()) {
    conversion.document = std::make_shared<nlohmann::json>(std::move(parts));
  }
  return conversion;
}

}  // namespace snapthrough::api
