/// @file
/// Sessions of the Model Context Protocol: messages, versions, questions, and the documents that are kept.

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "server/mcp/digest.h"
#include "server/mcp/missing_values.h"
#include "server/mcp/session.h"
#include "server/mcp/shelf.h"
#include "server/worker/local_runner.h"
#include "solver/solve.h"
#include "tests/server/support/samples.h"

namespace snapthrough::server::mcp {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

Surroundings surroundings() {
  const SolveFunction solver = [](const Model& model, const Analysis& analysis, const Hooks& hooks) {
    return solve_checked(model, analysis, hooks);
  };
  return {local_runners(solver),
          [](const std::string&, std::string&) { return std::string("no converter"); }};
}

/// What the program says to a client that sends these lines and then closes its side.
std::vector<json> said_to(const std::string& lines) {
  std::istringstream in(lines);
  std::ostringstream out;
  serve_session(in, out, surroundings());
  std::vector<json> said;
  std::istringstream read(out.str());
  for (std::string line; std::getline(read, line);) {
    said.push_back(json::parse(line));
  }
  return said;
}

std::string request(int id, const std::string& method, const json& params) {
  return json({{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", params}}).dump() + "\n";
}

std::string call(int id, const std::string& tool, const json& arguments) {
  return request(id, "tools/call", {{"name", tool}, {"arguments", arguments}});
}

json document_in(const json& message) {
  return json::parse(message.at("result").at("content").at(0).at("text").get<std::string>());
}

int code_of(const json& message) { return message.at("error").at("code").get<int>(); }

TEST(McpSession, KnowsTheClientsVersionOrTellsItsLatest) {
  EXPECT_EQ(said_to(request(1, "initialize", {{"protocolVersion", "2024-11-05"}}))[0].at("result").at(
                "protocolVersion"),
            "2024-11-05");
  EXPECT_EQ(said_to(request(1, "initialize", {{"protocolVersion", "1999-01-01"}}))[0].at("result").at(
                "protocolVersion"),
            "2025-11-25");
}

TEST(McpSession, TellsWhatItCannotRead) {
  const std::vector<json> said = said_to(
      "{\"jsonrpc\"\n[]\n\n" + request(4, "no/method", json::object()) + call(5, "none", json::object()) +
      request(6, "tools/call", {{"name", "check"}, {"arguments", 3}}) +
      R"({"jsonrpc":"2.0","method":"notifications/other"})" + "\n" +
      R"({"jsonrpc":"2.0","id":99,"result":{}})" + "\n" + request(7, "ping", json::object()));
  ASSERT_EQ(said.size(), 6U);
  EXPECT_EQ(code_of(said[0]), -32700);
  EXPECT_EQ(code_of(said[1]), -32600);
  EXPECT_EQ(code_of(said[2]), -32601);
  EXPECT_EQ(code_of(said[3]), -32602);
  EXPECT_EQ(code_of(said[4]), -32602);
  EXPECT_EQ(said[5].at("result"), json::object());
}

TEST(McpSession, AnswersTheCallsThatWaitWhenTheClientClosesItsSide) {
  const json column = json::parse(test::column_request());
  const std::vector<json> said =
      said_to(call(1, "solve", column) + call(2, "read", {{"id", "result-1"}, {"pointer", "/summary"}}));
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(document_in(said[0]).at("id"), "result-1");
  EXPECT_EQ(document_in(said[1]).at("value").at("critical_load_factor"),
            document_in(said[0]).at("summary").at("critical_load_factor"));
}

TEST(McpSession, AFigureThatNoProgramConvertsIsSvgWithTheReason) {
  const json column = json::parse(test::column_request());
  const std::vector<json> said = said_to(call(1, "plot", {{"model", column.at("model")}}));
  const json content = said.at(0).at("result").at("content");
  EXPECT_THAT(content.at(0).at("resource").at("text").get<std::string>(), HasSubstr("</svg>"));
  EXPECT_EQ(content.at(1).at("text"), "SVG: no converter");
}

TEST(McpSession, AnArgumentThatNoToolHasIsRefused) {
  const std::vector<json> said =
      said_to(call(1, "read", {{"id", "result-1"}, {"pointer", ""}, {"coun", 3}}) +
              call(2, "convert", json::object()) + call(3, "plot", {{"kind", "rose"}}) +
              call(4, "convert", {{"drawing", ""}, {"layers", 3}}));
  for (const json& one : said) {
    EXPECT_TRUE(one.at("result").at("isError")) << one;
  }
  EXPECT_EQ(document_in(said.at(0)).at("errors").at(0).at("pointer"), "/coun");
}

/// A drawing of a beam and a post that stands on it, with the post drawn twice.
const std::string kTee =
    "0\nSECTION\n2\nENTITIES\n"
    "0\nLINE\n8\nwall\n10\n0\n20\n0\n11\n6\n21\n0\n"
    "0\nLINE\n8\nwall\n10\n3\n20\n0\n11\n3\n21\n4\n"
    "0\nLINE\n8\nwall\n10\n3\n20\n4\n11\n3\n21\n0\n"
    "0\nENDSEC\n0\nEOF\n";

TEST(McpSession, WarningsOfADrawingStandBesideTheParts) {
  const std::vector<json> said = said_to(
      call(1, "convert", {{"drawing", kTee}}) + call(2, "convert", {{"drawing", kTee}, {"join_tees", true}}) +
      call(3, "convert",
           {{"nodes", "id,x,y\na,0,0\nb,1,0\n"}, {"members", "id,start,end,section\nab,a,b,s\n"}}));
  ASSERT_EQ(said.size(), 3U);
  const std::vector<std::vector<std::string>> codes{{"tee_unjoined", "duplicates_dropped"},
                                                    {"duplicates_dropped"}};
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const json& content = said[i].at("result").at("content");
    EXPECT_FALSE(said[i].at("result").contains("isError"));
    ASSERT_EQ(content.size(), 2U);
    EXPECT_EQ(content[1].at("type"), "text");
    const json warnings = json::parse(content[1].at("text").get<std::string>()).at("warnings");
    ASSERT_EQ(warnings.size(), codes[i].size());
    for (std::size_t k = 0; k < warnings.size(); ++k) {
      EXPECT_EQ(warnings[k].at("code"), codes[i][k]);
    }
    const json parts = document_in(said[i]);
    EXPECT_EQ(parts.size(), 3U);  // nodes, members and sections, which a model takes as they are
    EXPECT_EQ(parts.at("members").size(), 2U + i);
    EXPECT_EQ(parts.at("nodes").size(), 4U);
  }
  EXPECT_THAT(said[0].at("result").at("content").at(1).at("text").get<std::string>(),
              HasSubstr("; join_tees divides the segments there"));
  EXPECT_EQ(said[2].at("result").at("content").size(), 1U);
}

TEST(McpSession, AWrongChoiceForADrawingIsToldByItsArgument) {
  const std::vector<json> said = said_to(call(1, "convert", {{"drawing", kTee}, {"join_tees", "yes"}}) +
                                         call(2, "convert", {{"drawing", kTee}, {"tolerance", 1e151}}) +
                                         call(3, "convert", {{"drawing", kTee}, {"layers", {"roof"}}}));
  const std::vector<std::string> pointers{"/join_tees", "/tolerance", "/layers"};
  ASSERT_EQ(said.size(), pointers.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_TRUE(said[i].at("result").at("isError")) << said[i];
    EXPECT_EQ(document_in(said[i]).at("errors").at(0).at("pointer"), pointers[i]);
  }
  EXPECT_EQ(document_in(said[0]).at("errors").at(0).at("detail"), "must be true or false");
}

TEST(McpDigest, NamesTheListsThatItLeavesOut) {
  const json document = {
      {"short", {1, 2}}, {"long", {1, 2, 3}}, {"in/side", {{{"long", {1, 2, 3, 4}}, {"kept", 7}}}}};
  const json digest = digest_of(document, 2);
  EXPECT_EQ(digest.at("short"), json({1, 2}));
  EXPECT_FALSE(digest.contains("long"));
  EXPECT_EQ(digest.at("in/side").at(0), json({{"kept", 7}}));
  EXPECT_EQ(digest.at("left_out"),
            json({{{"pointer", "/in~1side/0/long"}, {"items", 4}}, {{"pointer", "/long"}, {"items", 3}}}));
  EXPECT_EQ(digest_of({{"a", 1}}, 2), json({{"a", 1}}));
}

TEST(McpShelf, TheOldestDocumentsGoFirst) {
  Shelf shelf;
  const auto document = std::make_shared<const json>(1);
  const std::string first = shelf.add("result", document, document, 1).id;
  const std::string second = shelf.add("table", document, document, Shelf::kMostBytes).id;
  EXPECT_EQ(shelf.find(first), nullptr);
  ASSERT_NE(shelf.find(second), nullptr);
  EXPECT_THAT(shelf.ids(), ElementsAre("table-2"));
}

TEST(McpMissingValues, AsksForPlainValuesOnly) {
  const Finding number{"/model/sections/0/EA", "missing_field", ""};
  const std::optional<Question> question = question_about({number}, "Request");
  ASSERT_TRUE(question);
  EXPECT_EQ(question->schema->at("properties").at(number.pointer).at("type"), "number");
  EXPECT_FALSE(question_about({number, {"/model/nodes", "missing_field", ""}}, "Request"));
  EXPECT_FALSE(question_about({number, {"/model/members/0/section", "unknown_reference", ""}}, "Request"));
  EXPECT_FALSE(question_about({}, "Request"));
  json document = json::parse(R"({"model": {"sections": [{"id": "a"}]}})");
  EXPECT_EQ(take_answer({{number.pointer, 5}}, *question, document), "");
  EXPECT_EQ(document.at("model").at("sections").at(0).at("EA"), 5);
  EXPECT_THAT(take_answer({{number.pointer, "x"}}, *question, document), HasSubstr(number.pointer));
  EXPECT_THAT(take_answer(json::object(), *question, document), HasSubstr(number.pointer));
}

}  // namespace
}  // namespace snapthrough::server::mcp
