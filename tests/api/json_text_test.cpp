/// The bounds of the parser: what it refuses, where it says that it stopped, and that no text breaks it.

#include "api/json_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "tests/api/documents.h"

namespace snapthrough::api {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

std::string repeat(const std::string& part, std::size_t times) {
  std::string text;
  for (std::size_t i = 0; i < times; ++i) {
    text += part;
  }
  return text;
}

TEST(ParseJson, GivesTheDocument) {
  const ParsedText parsed = parse_json(R"({"a": [1, -2, 2.5, true, null, "x\u00e9"], "b": {}})");
  ASSERT_NE(parsed.document, nullptr);
  const nlohmann::json expected = {{"a", {1, -2, 2.5, true, nullptr, "x\u00e9"}},
                                   {"b", nlohmann::json::object()}};
  EXPECT_EQ(*parsed.document, expected);
  EXPECT_THAT(parsed.findings, SizeIs(0));
}

TEST(ParseJson, AgreesWithTheLibraryOnAnOrdinaryDocument) {
  const ParsedText parsed = parse_json(testing::full_model());
  ASSERT_NE(parsed.document, nullptr);
  EXPECT_EQ(*parsed.document, nlohmann::json::parse(testing::full_model()));
}

struct Refused {
  const char* name;
  std::string text;
  const char* pointer;
  const char* code;
  const char* detail;
};
void PrintTo(const Refused& r, std::ostream* out) { *out << r.name; }

class ParseJsonRefuses : public ::testing::TestWithParam<Refused> {};

TEST_P(ParseJsonRefuses, WithOneFinding) {
  const ParsedText parsed = parse_json(GetParam().text);
  EXPECT_EQ(parsed.document, nullptr);
  ASSERT_THAT(parsed.findings, SizeIs(1));
  EXPECT_EQ(parsed.findings[0].pointer, GetParam().pointer);
  EXPECT_EQ(parsed.findings[0].code, GetParam().code);
  EXPECT_THAT(parsed.findings[0].detail, HasSubstr(GetParam().detail));
}

const Refused kRefused[] = {
    {"Empty", "", "", "malformed", "unexpected end of input"},
    {"Cut", "{\"a\": [1,", "/a/1", "malformed", "line 1, column 10 (byte 10)"},
    {"SecondLine", "{\n  \"a\": tru\n}", "/a", "malformed", "line 2, column 11 (byte 13)"},
    {"TrailingComma", "[1, 2,]", "/2", "malformed", "column 7"},
    {"TwoDocuments", "{} {}", "", "malformed", "column 4"},
    {"Comment", "[1] // x", "", "malformed", "column 5"},
    {"InsideSecondItem", R"({"m": [{}, {"x": [0, {"y": ?}]}]})", "/m/1/x/1/y", "malformed", "column 28"},
    {"NotANumber", "[NaN]", "/0", "malformed", "column 2"},
    {"Overflow", "{\"x\": 1e999}", "/x", "malformed", "number overflow"},
    {"BadUtf8", "[\"\xff\"]", "/0", "malformed", "ill-formed UTF-8"},
    {"LoneSurrogate", R"(["\ud800"])", "/0", "malformed", "surrogate"},
    {"DuplicateKey", R"({"a": {"b/c": 1, "b/c": 2}})", "/a/b~1c", "duplicate_key", "twice"},
    {"TooDeep", repeat("[", 65) + repeat("]", 65), "", "too_deep", "64"},
    {"HugeNest", repeat("[", 200'000), "", "too_deep", "64"},
    {"HugeObjectNest", repeat("{\"a\":", 200'000), "", "too_deep", "64"},
};
INSTANTIATE_TEST_SUITE_P(Text, ParseJsonRefuses, ::testing::ValuesIn([] {
                           std::vector<Refused> all(std::begin(kRefused), std::end(kRefused));
                           static const std::string array_nest = repeat("/0", 64);
                           static const std::string object_nest = repeat("/a", 64);
                           for (Refused& r : all) {
                             if (std::string_view(r.code) == "too_deep") {
                               r.pointer = r.text[0] == '[' ? array_nest.c_str() : object_nest.c_str();
                             }
                           }
                           return all;
                         }()),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

TEST(ParseJson, DepthLimitItselfIsAllowed) {
  EXPECT_NE(parse_json(repeat("[", 64) + repeat("]", 64)).document, nullptr);
  EXPECT_NE(parse_json("[[]]", {.depth = 2}).document, nullptr);
  EXPECT_EQ(parse_json("[[[]]]", {.depth = 2}).document, nullptr);
}

TEST(ParseJson, CountsValuesOfEveryKind) {
  EXPECT_NE(parse_json("[1, {\"a\": 2}, 3]", {.values = 5}).document, nullptr);
  const ParsedText refused = parse_json("[1, {\"a\": 2}, 3, 4]", {.values = 5});
  ASSERT_THAT(refused.findings, SizeIs(1));
  EXPECT_EQ(refused.findings[0].code, "too_many_values");
  EXPECT_EQ(refused.findings[0].pointer, "/3");
}

TEST(ParseJson, CountsTheKeysOfAllObjects) {
  EXPECT_NE(parse_json(R"([{"a": 1}, {"b": {"c": 2}}])", {.keys = 3}).document, nullptr);
  const ParsedText refused = parse_json(R"([{"a": 1}, {"b": {"c": 2, "d": 3}}])", {.keys = 3});
  ASSERT_THAT(refused.findings, SizeIs(1));
  EXPECT_EQ(refused.findings[0].code, "too_many_keys");
  EXPECT_EQ(refused.findings[0].pointer, "/1/b/d");
  EXPECT_THAT(refused.findings[0].detail, HasSubstr("json_keys"));
}

TEST(ParseJson, AllDuplicateKeysAreReported) {
  const ParsedText parsed = parse_json(R"({"a": 1, "a": 2, "b": {"c": 1, "c": 2}})");
  ASSERT_THAT(parsed.findings, SizeIs(2));
  EXPECT_EQ(parsed.findings[0].pointer, "/a");
  EXPECT_EQ(parsed.findings[1].pointer, "/b/c");
}

TEST(ParseJson, DuplicateKeysDoNotFillTheMemory) {
  EXPECT_LE(parse_json("{" + repeat("\"a\": 1, ", 10'000) + "\"a\": 1}").findings.size(), 100U);
}

TEST(ParseJson, DetailIsPrintableAndShort) {
  const ParsedText parsed = parse_json("[\"" + repeat("\xc3\xa9", 5000) + "\x01\"]");
  ASSERT_THAT(parsed.findings, SizeIs(1));
  EXPECT_LE(parsed.findings[0].detail.size(), 400U);
  EXPECT_NO_THROW((void)nlohmann::json(parsed.findings[0].detail).dump());
}

/// Spoils a good document at random bytes: whatever comes out, it is a document or findings, never both,
/// never none.
TEST(ParseJson, RandomDamageNeverBreaksIt) {
  const std::string good = testing::full_model();
  std::mt19937 random(20240613);
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = good;
    for (int i = 0; i < 3; ++i) {
      text[random() % text.size()] = static_cast<char>(random() % 256);
    }
    text.resize(trial % 3 == 0 ? random() % text.size() : text.size());
    const ParsedText parsed = parse_json(text);
    ASSERT_NE(parsed.document == nullptr, parsed.findings.empty()) << "trial " << trial;
    for (const Finding& finding : parsed.findings) {
      ASSERT_NO_THROW((void)nlohmann::json(finding.detail).dump()) << "trial " << trial;
    }
  }
}

}  // namespace
}  // namespace snapthrough::api
