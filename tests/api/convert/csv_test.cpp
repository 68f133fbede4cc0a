/// Tables of nodes, members and sections, and what is refused by file, line and column.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "api/convert/convert.h"
#include "solver/model/limits.h"
#include "tests/findings.h"

namespace snapthrough::api {
namespace {

using nlohmann::json;
using snapthrough::testing::is_finding;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const char* const kNodes = "id,x,y\na,0,0\nb,3,4\n";
const char* const kMembers = "id,start,end,section\nab,a,b,pipe\n";

Conversion convert(const std::string& nodes, const std::string& members) {
  return convert_csv({{"nodes.csv", nodes}, {"members.csv", members}, std::nullopt});
}

json converted(const std::string& nodes, const std::string& members) {
  const Conversion conversion = convert(nodes, members);
  EXPECT_THAT(conversion.findings, IsEmpty());
  return conversion.document == nullptr ? json::object() : *conversion.document;
}

TEST(ConvertCsv, RowsBecomeNodesMembersAndSections) {
  const json expected = json::parse(R"({
    "nodes": [{"id": "a", "x": 0.0, "y": 0.0}, {"id": "b", "x": 3.0, "y": 4.0}],
    "members": [{"id": "ab", "start": "a", "end": "b", "section": "pipe"}],
    "sections": [{"id": "pipe"}]
  })");
  EXPECT_EQ(converted(kNodes, kMembers), expected);
}

TEST(ConvertCsv, ArcsHaveASweep) {
  const json parts =
      converted(kNodes, "id,start,end,section,sweep_degrees\n1,a,b,s,-60\n2,a,b,s,\n3,a,b,s,0\n");
  EXPECT_EQ(parts["members"][0]["curve"], json::parse(R"({"type": "arc", "sweep_degrees": -60.0})"));
  EXPECT_FALSE(parts["members"][1].contains("curve"));
  EXPECT_FALSE(parts["members"][2].contains("curve"));
}

TEST(ConvertCsv, SectionsHaveTheColumnsThatAreFilled) {
  const Conversion conversion =
      convert_csv({{"n", kNodes}, {"m", kMembers}, CsvFile{"s", "EI,EA,id,GA\n2,1e3,pipe,\n7,8,rod,9\n"}});
  ASSERT_THAT(conversion.findings, IsEmpty());
  EXPECT_EQ(
      (*conversion.document)["sections"],
      json::parse(
          R"([{"id": "pipe", "EA": 1000.0, "EI": 2.0}, {"id": "rod", "EA": 8.0, "EI": 7.0, "GA": 9.0}])"));
}

TEST(ConvertCsv, SectionsOfTheirTableMustBeThere) {
  const Conversion conversion =
      convert_csv({{"n", kNodes}, {"m.csv", kMembers}, CsvFile{"s", "id,EA,EI\nrod,1,1\n"}});
  EXPECT_THAT(conversion.findings, ElementsAre(is_finding("m.csv:2:section", "unknown_reference")));
}

// RFC 4180 and what spreadsheets add: a byte order mark, blanks, empty lines, columns in any order, no last
// line end.
TEST(ConvertCsv, FormsOfTheSameTableGiveTheSameParts) {
  const json expected = converted("id,x,y\n\"left, \"\"old\"\"\",0,0\nb,-3.5,1e2\n",
                                  "id,start,end,section\n1,\"left, \"\"old\"\"\",b,s\n");
  EXPECT_EQ(expected["nodes"][0]["id"], "left, \"old\"");
  EXPECT_EQ(converted("\xEF\xBB\xBFy,id,x\r\n0,\"left, \"\"old\"\"\",0\r\n\r\n1e2, b ,-3.5",
                      "id,start,end,section\r\n1,\"left, \"\"old\"\"\",b,s\r\n"),
            expected);
}

struct Mistake {
  const char* name;
  std::string nodes, members;
  const char* place;
  const char* code;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

class ConvertCsvRefuses : public ::testing::TestWithParam<Mistake> {};

TEST_P(ConvertCsvRefuses, ByLineColumnAndRule) {
  const Conversion conversion = convert(GetParam().nodes, GetParam().members);
  EXPECT_EQ(conversion.document, nullptr);
  EXPECT_THAT(conversion.findings, ElementsAre(is_finding(GetParam().place, GetParam().code)));
}

std::string too_many_nodes() {
  std::string text = "id,x,y\n";
  for (std::size_t i = 0; i <= kMaxNodes; ++i) {
    text += std::to_string(i) + ",0," + std::to_string(i) + "\n";
  }
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    Tables, ConvertCsvRefuses,
    ::testing::Values(
        Mistake{"number", "id,x,y\na,0,0\nb,three,4\n", kMembers, "nodes.csv:3:x", "wrong_type"},
        Mistake{"missing_number", "id,x,y\na,0,0\nb,,4\n", kMembers, "nodes.csv:3:x", "wrong_type"},
        Mistake{"no_finite_number", "id,x,y\na,0,0\nb,inf,4\n", kMembers, "nodes.csv:3:x", "out_of_range"},
        Mistake{"decimal_comma", "id,x,y\na,0,0\nb,\"3,5\",4\n", kMembers, "nodes.csv:3:x", "wrong_type"},
        Mistake{"repeated_id", "id,x,y\na,0,0\nb,3,4\na,3,4\n", kMembers, "nodes.csv:4:id", "duplicate_id"},
        Mistake{"empty_id", "id,x,y\na,0,0\nb,3,4\n,3,4\n", kMembers, "nodes.csv:4:id", "bad_id"},
        Mistake{"missing_column", "id,x\na,0\nb,3\n", kMembers, "nodes.csv:1", "missing_field"},
        Mistake{"unknown_column", "id,x,y,z\na,0,0,0\nb,3,4,0\n", kMembers, "nodes.csv:1", "unknown_field"},
        Mistake{"repeated_column", "id,x,y,x\na,0,0,0\n", kMembers, "nodes.csv:1", "duplicate"},
        Mistake{"short_row", "id,x,y\na,0,0\nb,3\n", kMembers, "nodes.csv:3", "malformed"},
        Mistake{"open_quote", "id,x,y\n\"a,0,0\nb,3,4\n", kMembers, "nodes.csv:2", "malformed"},
        Mistake{"quote_in_a_field", "id,x,y\na\"b,0,0\n", kMembers, "nodes.csv:2", "malformed"},
        Mistake{"text_behind_a_quote", "id,x,y\n\"a\"b,0,0\n", kMembers, "nodes.csv:2", "malformed"},
        Mistake{"line_after_a_quoted_line_end", "id,x,y\n\"b\",0,0\na,0,x\n", kMembers, "nodes.csv:3:y",
                "wrong_type"},
        Mistake{"no_utf8", "id,x,y\n\xE4,0,0\n", kMembers, "nodes.csv:1", "malformed"},
        Mistake{"too_many", too_many_nodes(), kMembers, "nodes.csv:20002", "too_many"},
        Mistake{"unknown_node", kNodes, "id,start,end,section\nab,a,c,s\n", "members.csv:2:end",
                "unknown_reference"},
        Mistake{"sweep", kNodes, "id,start,end,section,sweep_degrees\nab,a,b,s,360\n",
                "members.csv:2:sweep_degrees", "out_of_range"},
        Mistake{"section", kNodes, "id,start,end,section\nab,a,b,\n", "members.csv:2:section", "bad_id"}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

// Any text gives parts or findings, and neither harm nor an exception.
TEST(ConvertCsv, AnyTextIsAnswered) {
  std::mt19937 random(3);
  const auto edited = [&random](std::string text) {
    for (unsigned edits = random() % 4; edits > 0; --edits) {
      text[random() % text.size()] = "0123,,\"\"\n\r-.ab\xFF"[random() % 15];
    }
    text.resize(random() % 4 == 0 ? random() % text.size() : text.size());
    return text;
  };
  for (int i = 0; i < 3000; ++i) {
    const std::string nodes = edited(kNodes);
    const std::string members = edited(kMembers);
    const Conversion conversion = convert(nodes, members);
    EXPECT_EQ(conversion.document == nullptr, !conversion.findings.empty()) << nodes << members;
  }
}

TEST(ConvertCsv, AnEmptyTableLacksItsColumns) {
  EXPECT_EQ(convert("", kMembers).findings.size(), 3U);
  EXPECT_EQ(convert("id;x;y\n1;2;3\n", kMembers).findings.size(), 4U) << "semicolons do not separate columns";
}

}  // namespace
}  // namespace snapthrough::api
