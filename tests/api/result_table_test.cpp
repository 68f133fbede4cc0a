/// Tables of results: columns, rows, and which analysis has which.

#include "api/result_table.h"
#include "api/csv_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace snapthrough::api {
namespace {

using nlohmann::json;

TEST(ResultTable, EachTypeOfAnalysisHasItsTables) {
  EXPECT_EQ(table_names(tables_of("path")), "points, critical_points, states");
  EXPECT_EQ(table_names(tables_of("critical")), "critical_points, states");
  EXPECT_EQ(table_names(tables_of("static")), "static, states");
  EXPECT_EQ(table_names(tables_of("buckling")), "buckling");
  EXPECT_EQ(tables_of("vibration").front(), ResultTable::vibrations);
  EXPECT_EQ(table_names(tables_of("vibration")), "static, vibrations, states");
  EXPECT_TRUE(tables_of("").empty());
  EXPECT_EQ(tables_of("static").front(), ResultTable::static_rows);
  EXPECT_EQ(result_table_from("static"), ResultTable::static_rows);
  EXPECT_FALSE(result_table_from("statics"));
}

TEST(ResultTable, StaticRowsHaveMonitorsAndContact) {
  const json result = json::parse(R"({"static": {
    "load_factor": [0.5, 1], "monitors": {"tip": [-0.25, -0.5], "a,b": [1e-300, 3]},
    "negative_eigenvalues": [0, null], "contact_fraction": {"soil": [1, 0.75]}, "state": [0, null]}})");
  EXPECT_EQ(result_csv(result, ResultTable::static_rows),
            "load_factor,negative_eigenvalues,state,\"a,b\",tip,contact_fraction:soil\r\n"
            "0.5,0,0,1e-300,-0.25,1\r\n"
            "1,,,3,-0.5,0.75\r\n");
}

TEST(ResultTable, BucklingLoadsAreNumberedFromOne) {
  const json result =
      json::parse(R"({"buckling": {"load_factors": [9.5, 21.25], "error_estimates": [1e-7, null]}})");
  EXPECT_EQ(result_csv(result, ResultTable::buckling),
            "mode,load_factor,error_estimate\r\n1,9.5,1e-07\r\n2,21.25,\r\n");
}

TEST(ResultTable, VibrationsHaveARowForEachMotion) {
  const json result = json::parse(R"({"vibrations": [
    {"load_factor": 0, "frequencies": {"omega_squared": [2.5, 4]}, "error_estimates": [1e-7, null], "modes": []},
    {"load_factor": 1, "frequencies": {"omega_squared": [3, 3], "imaginary": [-0.5, 0.5]},
     "error_estimates": [null, null], "modes": []}]})");
  EXPECT_EQ(result_csv(result, ResultTable::vibrations),
            "load_factor,mode,omega_squared,imaginary,error_estimate\r\n0,1,2.5,0,1e-07\r\n0,2,4,0,\r\n"
            "1,1,3,-0.5,\r\n1,2,3,0.5,\r\n");
}

TEST(ResultTable, RowsHaveTheirFrequencies) {
  const json result = json::parse(R"({"static": {
    "load_factor": [0.5, 1], "negative_eigenvalues": [0, null], "state": [0, null],
    "frequencies": [null, {"omega_squared": [2, 5], "imaginary": [0, 0]}]}})");
  EXPECT_EQ(
      result_csv(result, ResultTable::static_rows),
      "load_factor,negative_eigenvalues,state,omega_squared:1,omega_squared:2,imaginary:1,imaginary:2\r\n"
      "0.5,0,0,,,,\r\n1,,,2,5,0,0\r\n");
  Branch branch;
  branch.load_factor = {0.0, 1.0};
  branch.arc_length = {0.0, 0.5};
  branch.frequencies = {Frequencies{{2.0, 5.0}}, std::nullopt};
  std::string csv;
  EXPECT_FALSE(PointsTable({branch}).append_rows(csv, 1U << 20U));
  EXPECT_THAT(csv, ::testing::HasSubstr(",omega_squared:1,omega_squared:2\r\n0,0,0,"));
  EXPECT_THAT(csv, ::testing::HasSubstr(",2,5\r\n0,1,1,"));
  EXPECT_THAT(csv, ::testing::EndsWith(",,\r\n"));
}

TEST(ResultTable, CriticalPointsHaveTheirMonitors) {
  const json result = json::parse(R"({"critical_points": [
    {"branch": 0, "type": "limit_max", "cause": "smooth", "load_factor": 2.5, "error_estimate": null,
     "confirmed": true, "arc_length": 1.5, "negative_before": 0, "negative_after": 1, "multiplicity": 1,
     "state": 0, "member": "arch", "monitors": {"crown": -0.3}}]})");
  EXPECT_EQ(
      result_csv(result, ResultTable::critical_points),
      "branch,type,cause,load_factor,error_estimate,confirmed,arc_length,negative_before,negative_after,"
      "multiplicity,state,member,crown\r\n0,limit_max,smooth,2.5,,true,1.5,0,1,1,0,arch,-0.3\r\n");
  EXPECT_EQ(result_csv(json::object(), ResultTable::critical_points).find('\n'),
            result_csv(json::object(), ResultTable::critical_points).size() - 1)
      << "a header alone";
}

/// Names that a spreadsheet would compute are marked as texts; numbers stay as they are.
TEST(CsvField, TextsThatLookLikeFormulasAreMarked) {
  std::string text;
  for (const char* name : {"=1+1", "+a", "-a", "@a", "\ta", "a=b", "", "=\"x\", y"}) {
    append_csv_text(text, name);
    text += ';';
  }
  append_csv_field(text, "-1.5");
  EXPECT_EQ(text, "'=1+1;'+a;'-a;'@a;'\ta;a=b;;\"'=\"\"x\"\", y\";-1.5");
}

/// White space and signs in full width do not hide a formula.
TEST(CsvField, HiddenFormulasAreMarked) {
  for (const std::string name : {"\n=1", " =1", "\v@a", "\uFF1D1", "\uFF0Ba", "\uFF0Da", " \uFF20a"}) {
    std::string text;
    append_csv_text(text, name);
    EXPECT_THAT(text, testing::AnyOf(testing::StartsWith("'"), testing::StartsWith("\"'"))) << name;
  }
  std::string text;
  append_csv_text(text, "a\n=1");
  EXPECT_EQ(text, "\"a\n=1\"") << "a cell is one text";
}

TEST(ResultTable, StatesAreRowsAlongTheMembers) {
  const json result = json::parse(R"({"states": [{"branch": 0, "load_factor": 2, "members": {
    "m": {"s": [0, 1], "x": [0, 0.5], "y": [0, 0.25], "rotation": [0, -1], "axial_force": [1, 2],
          "shear_force": [3, 4], "bending_moment": [5, 6], "x0": [0, 1], "y0": [0, 0], "u": [0, -0.5], "v": [0, 0.25],
          "utilisation_left": [0.5, 0.75], "utilisation_right": [-0.5, -0.25]},
    "n": {"s": [0]}}}]})");
  EXPECT_EQ(result_csv(result, ResultTable::states),
            "state,branch,load_factor,member,s,x0,y0,x,y,u,v,rotation,axial_force,shear_force,bending_moment,"
            "utilisation_left,utilisation_right\r\n"
            "0,0,2,m,0,0,0,0,0,0,0,0,1,3,5,0.5,-0.5\r\n"
            "0,0,2,m,1,1,0,0.5,0.25,-0.5,0.25,-1,2,4,6,0.75,-0.25\r\n"
            "0,0,2,n,0,,,,,,,,,,,,\r\n");
}

/// The values that are cut out of a document that comes in pieces of so many characters.
std::vector<std::string> values_of(const std::string& document, const char* name, JsonPart part,
                                   std::size_t size) {
  JsonPieces pieces(name, part);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < document.size(); i += size) {
    pieces.append(std::string_view(document).substr(i, size));
    while (std::optional<std::string> value = pieces.next()) {
      values.push_back(*std::move(value));
    }
  }
  return values;
}

TEST(JsonPieces, AreThoseOfTheWholeDocument) {
  const json document = json::parse(R"({"first": {"list": [1, 2], "a": "list"}, "text": "list", "last": [],
    "list": [{"b": "]},\"[{"}, [], [[1], 2], -1.5e3, "a, b", null, {"list": [7]}], "after": {"list": [9]}})");
  for (const std::string& text : {document.dump(), document.dump(2)}) {
    for (const std::size_t size : {1UL, 2UL, 7UL, text.size()}) {
      for (const auto& [name, value] : document.items()) {
        const std::vector<std::string> whole = values_of(text, name.c_str(), JsonPart::value, size);
        ASSERT_EQ(whole.size(), 1U) << name;
        EXPECT_EQ(json::parse(whole.front()), value) << name;
      }
      json list = json::array();
      for (const std::string& element : values_of(text, "list", JsonPart::elements, size)) {
        list.push_back(json::parse(element));
      }
      EXPECT_EQ(list, document["list"]) << size;
      EXPECT_TRUE(values_of(text, "last", JsonPart::elements, size).empty());
      EXPECT_TRUE(values_of(text, "none", JsonPart::value, size).empty());
    }
  }
}

TEST(ResultTable, OfADocumentInPiecesIsTheSame) {
  const json result =
      json::parse(R"({"critical_points": [{"branch": 0, "type": "limit_max", "monitors": {"m": 1}}],
    "static": {"load_factor": [1, 2], "negative_eigenvalues": [0, 0], "state": [null, 0], "monitors": {"m": [3, 4]}},
    "buckling": {"load_factors": [1, 2]},
    "vibrations": [{"load_factor": 1, "frequencies": {"omega_squared": [1, 2]}}],
    "states": [{"branch": 0, "load_factor": 2, "members": {"m": {"s": [0, 1], "x": [0, 0.5]}}},
               {"branch": 1, "load_factor": 3, "members": {"m": {"s": [0, 1], "x": [0, 0.25]}}}]})");
  const std::string text = result.dump();
  for (const ResultTable table : {ResultTable::critical_points, ResultTable::static_rows,
                                  ResultTable::buckling, ResultTable::vibrations, ResultTable::states}) {
    for (const std::size_t size : {1UL, 50UL, text.size()}) {
      ResultTableReader reader(table);
      std::string csv;
      for (std::size_t i = 0; i < text.size(); i += size) {
        reader.append(std::string_view(text).substr(i, size), csv);
      }
      reader.end(csv);
      EXPECT_EQ(csv, result_csv(result, table)) << size;
    }
  }
}

}  // namespace
}  // namespace snapthrough::api
