/// Tables of fields for documents.

#include "api/openapi/field_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace snapthrough::api {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(FieldTable, StandsBelowItsPlace) {
  const std::string text = with_field_tables("# Title\n\n<!-- fields of Softest -->\n\nafter\n");
  EXPECT_THAT(text, StartsWith("# Title\n\n<!-- fields of Softest -->\n\n| field | values | unit | what |\n"
                               "| --- | --- | --- | --- |\n| `load_factor` | number | dimensionless ("));
  EXPECT_THAT(text, HasSubstr("\n| `mode` | object or null |  | "));
  EXPECT_THAT(text, HasSubstr("\n| `mode.members.ID.s` | list of number >= 0 | length | "));
  EXPECT_TRUE(text.ends_with(" |\n\nafter\n"));
}

TEST(FieldTable, HasRangesDefaultsAndAlternatives) {
  const std::string text = with_field_tables("<!-- fields of Request -->\n");
  EXPECT_THAT(text, HasSubstr("\n| `model.nodes` | list (1 to 20000) of object |"));
  EXPECT_THAT(text,
              HasSubstr("\n| `model.monitors[].at.fraction` | number >= 0, <= 1 | fraction of the member's"));
  EXPECT_THAT(
      text,
      HasSubstr("\n| `model.foundations[].range` ? | [number >= 0, < 1, number > 0, <= 1] | fraction of the "
                "member's undeformed length | Part of the member that it lies along. Default: [0, 1]. / "));
  EXPECT_THAT(
      text,
      HasSubstr(
          "\n| `model.loads[].force` | [number, number] or [number, number] or object | force; force per "
          "length | Force [fx, fy] in global axes / Load per length, the same everywhere or varying along "
          "the member |"));
}

TEST(FieldTable, DocumentsWithoutAPlaceStay) {
  const std::string text = "# Title\n<!-- fields of nothing\n";
  EXPECT_EQ(with_field_tables(text), text);
}

TEST(FieldTable, AnUnknownSchemaIsAnError) {
  EXPECT_THROW((void)with_field_tables("<!-- fields of Nothing -->\n"), nlohmann::json::exception);
}

}  // namespace
}  // namespace snapthrough::api
