/// The C interface, seen as a program outside sees it: only its header and the shared library.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "snapthrough.h"

namespace {

using nlohmann::json;
using ::testing::HasSubstr;

struct Free {
  void operator()(snapthrough_document* document) const { snapthrough_free(document); }
};
using Document = std::unique_ptr<snapthrough_document, Free>;

struct FreeStop {
  void operator()(snapthrough_stop* stop) const { snapthrough_stop_free(stop); }
};
using Stop = std::unique_ptr<snapthrough_stop, FreeStop>;

Document solve(const std::string& request, const snapthrough_options* options = nullptr,
               snapthrough_callback callback = nullptr, void* user = nullptr) {
  return Document(snapthrough_solve(request.data(), request.size(), options, callback, user));
}

Document sweep(const std::string& document, std::uint64_t first, std::uint64_t count,
               const snapthrough_options* options = nullptr, snapthrough_callback callback = nullptr,
               void* user = nullptr) {
  return Document(snapthrough_sweep(document.data(), document.size(), first, count, options, callback, user));
}

std::string contents_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string text_of(const std::string& example) {
  const std::string text = contents_of(std::string(SNAPTHROUGH_SOURCE_DIR) + "/examples/" + example);
  EXPECT_FALSE(text.empty()) << example;
  return text;
}

/// What the command line writes to its standard output.
std::string command_line(const std::string& arguments) {
  const std::string command = std::string(SNAPTHROUGH_EXECUTABLE) + " " + arguments + " 2>/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 65536> buffer{};
  for (std::size_t size = 0; (size = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    text.append(buffer.data(), size);
  }
  pclose(pipe);
  return text;
}

/// The document without the one number that is no function of the request.
json timeless(const std::string& document) {
  json result = json::parse(document);
  result.at("diagnostics").erase("wall_time_s");
  return result;
}

/// An analysis that takes long: thousands of elements, and many steps.
std::string long_request() {
  json request = json::parse(text_of("arch_deep_215.json"));
  request["analysis"] = {{"type", "path"},
                         {"discretization", {{"elements", 4000}, {"order", 1}}},
                         {"stop", {{"steps", 100000}}}};
  return request.dump();
}

TEST(Library, TellsItsVersion) { EXPECT_STREQ(snapthrough_version(), SNAPTHROUGH_VERSION); }

TEST(Library, SolvesEachExample) {
  for (const char* name :
       {"arch_no_base.json", "buried_pipe.json", "column_winkler.json", "frame_portal.json"}) {
    const Document document = solve(text_of(name));
    ASSERT_NE(document, nullptr);
    EXPECT_EQ(document->status, SNAPTHROUGH_DONE) << document->text;
    EXPECT_EQ(document->text[document->length], '\0');
    EXPECT_EQ(std::string(document->text).size(), document->length);
    EXPECT_TRUE(timeless(document->text).contains("summary"));
  }
}

/// The requests that every client answers alike (tests/clients/README.md).
class SharedRequests : public ::testing::Test {
 protected:
  static constexpr const char* kFolder = SNAPTHROUGH_SOURCE_DIR "/tests/clients/";

  static std::string path(const std::string& name) {
    return std::string(kFolder) + "requests/" + name + ".json";
  }
  static json expected() { return json::parse(contents_of(std::string(kFolder) + "expected.json")); }
};

TEST_F(SharedRequests, HaveTheNumbersOfTheCommandLine) {
  int compared = 0;
  const json all = expected();
  for (const auto& [name, expectation] : all.items()) {
    const std::string outcome = expectation.at("outcome");
    if (outcome == "wrong" || outcome == "cancelled") {
      continue;
    }
    const Document document = solve(contents_of(path(name)));
    EXPECT_EQ(document->status, outcome == "done" ? SNAPTHROUGH_DONE : SNAPTHROUGH_NOT_COMPLETED) << name;
    const json result = timeless(document->text);
    EXPECT_EQ(result, timeless(command_line("solve " + path(name)))) << name;
    EXPECT_EQ(result.contains("failure"), outcome == "failed") << name;
    if (outcome == "failed") {
      EXPECT_EQ(result.at("failure").at("code"), expectation.at("code")) << name;
    }
    const json warnings = expectation.value("warnings", json::array());
    for (const json& code : warnings) {
      EXPECT_THAT(result.at("warnings").dump(), HasSubstr(code.dump())) << name;
    }
    ++compared;
  }
  EXPECT_EQ(compared, 11);
}

TEST_F(SharedRequests, TellMistakesByTheirPlaces) {
  const Document document = solve(contents_of(path("wrong")));
  EXPECT_EQ(document->status, SNAPTHROUGH_WRONG_REQUEST);
  json found = json::array();
  const json problem = json::parse(document->text);
  for (const json& error : problem.at("errors")) {
    found.push_back({error.at("pointer"), error.at("code")});
  }
  json wanted = expected().at("wrong").at("errors");
  std::sort(found.begin(), found.end());
  std::sort(wanted.begin(), wanted.end());
  EXPECT_EQ(found, wanted);
}

TEST_F(SharedRequests, CanBeCancelled) {
  int steps = 0;
  const auto stop_at_fifth = [](const snapthrough_progress*, void* user) {
    return ++*static_cast<int*>(user) == 5 ? 1 : 0;
  };
  const Document document = solve(contents_of(path("cancelled")), nullptr, stop_at_fifth, &steps);
  EXPECT_EQ(document->status, SNAPTHROUGH_CANCELLED);
  EXPECT_FALSE(json::parse(document->text).at("branches").empty());
}

TEST_F(SharedRequests, GiveTheTableOfTheCommandLineByteForByte) {
  const std::string file = std::string(kFolder) + "sweep_500.json";
  const Document table = sweep(contents_of(file), 0, 500);
  const std::string head = "{\"total\": 500, \"unit\": 1, ";
  ASSERT_TRUE(std::string(table->text).starts_with(head));
  EXPECT_EQ("{" + std::string(table->text).substr(head.size()), command_line("sweep " + file));
}

TEST(Library, ListsTheMistakesOfARequest) {
  json request = json::parse(text_of("arch_no_base.json"));
  request["model"]["sections"][0]["EI"] = -1;
  const Document document = solve(request.dump());
  EXPECT_EQ(document->status, SNAPTHROUGH_WRONG_REQUEST);
  const json problem = json::parse(document->text);
  EXPECT_EQ(problem.at("type"), "urn:snapthrough:problem:invalid-request");
  EXPECT_EQ(problem.at("status"), 422);
  EXPECT_EQ(problem.at("errors").at(0).at("pointer"), "/model/sections/0/EI");
}

TEST(Library, RefusesATextThatIsNoJson) {
  for (const std::string text : {"", "{", "\xff\xfe", "nul"}) {
    const Document document = solve(text);
    EXPECT_EQ(document->status, SNAPTHROUGH_WRONG_REQUEST);
    EXPECT_EQ(json::parse(document->text).at("type"), "urn:snapthrough:problem:malformed-json");
  }
  EXPECT_EQ(Document(snapthrough_solve(nullptr, 0, nullptr, nullptr, nullptr))->status,
            SNAPTHROUGH_WRONG_REQUEST);
}

TEST(Library, GivesWhatAFailedAnalysisReached) {
  json request = json::parse(text_of("arch_no_base.json"));
  request["analysis"] = {{"type", "static"}, {"load_factors", {1, 1e9}}};
  const Document document = solve(request.dump());
  ASSERT_EQ(document->status, SNAPTHROUGH_NOT_COMPLETED) << document->text;
  const json result = json::parse(document->text);
  EXPECT_FALSE(result.at("failure").at("code").get<std::string>().empty());
  EXPECT_TRUE(result.contains("static"));
}

TEST(Library, TellsWhichArgumentIsWrong) {
  snapthrough_options options{1, nullptr};
  const Document small = solve("{}", &options);
  EXPECT_EQ(small->status, SNAPTHROUGH_WRONG_USE);
  EXPECT_THAT(small->text, HasSubstr("options->size"));
  EXPECT_EQ(Document(snapthrough_solve(nullptr, 5, nullptr, nullptr, nullptr))->status,
            SNAPTHROUGH_WRONG_USE);
  EXPECT_EQ(Document(snapthrough_check(nullptr, 5))->status, SNAPTHROUGH_WRONG_USE);
  const std::string rows = text_of("sweeps/frame_bays.json");
  EXPECT_EQ(sweep(rows, 7, 1)->status, SNAPTHROUGH_WRONG_USE);
  const std::string curve = text_of("sweeps/ring_followed.json");
  EXPECT_THAT(sweep(curve, 1, 1)->text, HasSubstr("multiples of the sweep's unit"));
  snapthrough_free(nullptr);
  snapthrough_stop_free(nullptr);
  snapthrough_stop_request(nullptr);
}

/// A caller of a later version has more options than this library knows.
TEST(Library, TakesLargerOptions) {
  struct {
    snapthrough_options known;
    void* later;
  } options{{sizeof options, nullptr}, nullptr};
  EXPECT_EQ(solve(text_of("arch_no_base.json"), &options.known)->status, SNAPTHROUGH_DONE);
}

TEST(Library, TellsTheSizeOfWhatItWouldSolve) {
  const std::string request = text_of("arch_no_base.json");
  const Document one(snapthrough_check(request.data(), request.size()));
  EXPECT_EQ(one->status, SNAPTHROUGH_DONE);
  EXPECT_EQ(json::parse(one->text).at("size").at("points"), 1);
  const std::string rows = text_of("sweeps/frame_bays.json");
  const Document many(snapthrough_check(rows.data(), rows.size()));
  EXPECT_EQ(json::parse(many->text).at("size").at("points"), 7);
  const Document wrong(snapthrough_check("{}", 2));
  EXPECT_EQ(wrong->status, SNAPTHROUGH_WRONG_REQUEST);
  EXPECT_FALSE(json::parse(wrong->text).at("errors").empty());
}

TEST(Library, TheCallbackSeesEachStepAndCanStop) {
  struct Seen {
    std::uint64_t calls = 0;
    double load_factor = 0.0;
  } seen;
  const auto stop_at_third = [](const snapthrough_progress* progress, void* user) {
    auto& counted = *static_cast<Seen*>(user);
    EXPECT_EQ(progress->size, sizeof(snapthrough_progress));
    counted.load_factor = progress->load_factor;
    return ++counted.calls == 3 ? 1 : 0;
  };
  const Document document = solve(long_request(), nullptr, stop_at_third, &seen);
  EXPECT_EQ(document->status, SNAPTHROUGH_CANCELLED) << document->text;
  EXPECT_EQ(json::parse(document->text).at("failure").at("code"), "cancelled");
  EXPECT_EQ(seen.calls, 3U);
  EXPECT_NE(seen.load_factor, 0.0);
}

TEST(Library, TheCallbackSeesThePointsOfThePath) {
  using Points = std::map<double, double>;  // value of the monitor by arc length
  Points told;
  const auto tell = [](const snapthrough_progress* now, void* user) {
    EXPECT_EQ(now->monitor_count, 1U);
    if (now->monitor_count == 1) {
      static_cast<Points*>(user)->emplace(now->arc_length, now->monitors[0]);
    }
    return 0;
  };
  const Document document = solve(text_of("arch_no_base.json"), nullptr, tell, &told);
  ASSERT_EQ(document->status, SNAPTHROUGH_DONE) << document->text;
  const json branch = json::parse(document->text).at("branches").at(0);
  int common = 0;  // the result has critical points, too, which are no steps
  for (std::size_t i = 0; i < branch.at("arc_length").size(); ++i) {
    const auto found = told.find(branch.at("arc_length")[i].get<double>());
    if (found != told.end()) {
      EXPECT_EQ(found->second, branch.at("monitors").at("crown")[i].get<double>());
      ++common;
    }
  }
  EXPECT_GE(common, 3);
}

TEST(Library, AnotherThreadStopsACall) {
  const Stop stop(snapthrough_stop_new());
  const snapthrough_options options{sizeof options, stop.get()};
  std::atomic<bool> begun = false;  // or ended without a step
  const auto tell = [](const snapthrough_progress*, void* user) {
    static_cast<std::atomic<bool>*>(user)->store(true);
    return 0;
  };
  const std::jthread other([&] {
    while (!begun) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    snapthrough_stop_request(stop.get());
  });
  const Document stopped = solve(long_request(), &options, tell, &begun);
  begun = true;
  EXPECT_EQ(stopped->status, SNAPTHROUGH_CANCELLED) << stopped->text;
  EXPECT_EQ(solve(text_of("arch_no_base.json"), &options)->status, SNAPTHROUGH_CANCELLED) << "stays stopped";
}

TEST(Library, FourThreadsGetTheSameNumbers) {
  const std::string request = text_of("buried_pipe.json");
  const json alone = timeless(solve(request)->text);
  std::array<json, 4> results;
  {
    std::vector<std::jthread> threads;
    for (json& result : results) {
      threads.emplace_back([&request, &result] {
        for (int i = 0; i < 5; ++i) {
          result = timeless(solve(request)->text);
        }
      });
    }
  }
  for (const json& result : results) {
    EXPECT_EQ(result, alone);
  }
}

TEST(Library, RowsOfASweepDoNotDependOnTheChunk) {
  const std::string document = text_of("sweeps/frame_bays.json");
  const json whole = json::parse(sweep(document, 0, 7)->text);
  EXPECT_EQ(whole.at("total"), 7);
  EXPECT_EQ(whole.at("unit"), 1);
  json rows = json::array();
  for (std::uint64_t first = 0; first < 7; first += 3) {
    const json chunk = json::parse(sweep(document, first, 3)->text);
    EXPECT_EQ(chunk.at("points").at(0), first);
    rows.insert(rows.end(), chunk.at("rows").begin(), chunk.at("rows").end());
  }
  EXPECT_EQ(rows, whole.at("rows"));
  EXPECT_TRUE(json::parse(sweep(document, 0, 0)->text).at("rows").empty());
}

TEST(Library, AStoppedSweepKeepsItsRows) {
  const auto stop_at_second = [](const snapthrough_progress* progress, void*) {
    EXPECT_EQ(progress->total, 7U);
    return progress->done == 2 ? 1 : 0;
  };
  const Document document = sweep(text_of("sweeps/frame_bays.json"), 0, 7, nullptr, stop_at_second);
  EXPECT_EQ(document->status, SNAPTHROUGH_CANCELLED);
  EXPECT_EQ(json::parse(document->text).at("rows").size(), 2U);
}

TEST(Library, APointThatFailsHasItsRow) {
  json document = json::parse(text_of("sweeps/frame_bays.json"));
  document["parameters"][0].erase("range");
  document["parameters"][0]["values"] = {18.6, -5.0};
  const json table = json::parse(sweep(document.dump(), 0, 2)->text);
  EXPECT_EQ(table.at("rows").at(0).back(), nullptr);
  EXPECT_EQ(table.at("rows").size(), 2U);
}

Document plot(const std::string& document, const std::string& choices) {
  return Document(snapthrough_plot(document.data(), document.size(), choices.data(), choices.size()));
}

TEST(Library, DrawsAsTheCommandLineDoes) {
  const std::string request = std::string(SNAPTHROUGH_SOURCE_DIR) + "/examples/buried_pipe.json";
  const std::string result = command_line("solve " + request);
  const Document path = plot(result, R"({"kind": "path", "dark": true, "width": 500})");
  ASSERT_EQ(path->status, SNAPTHROUGH_DONE) << path->text;
  const std::string file = ::testing::TempDir() + "/result_" + std::to_string(getpid()) + ".json";
  std::ofstream(file) << result;
  EXPECT_EQ(path->text, command_line("plot --kind path --dark --width 500 " + file));
  const json choices{{"kind", "shape"}, {"solved_request", json::parse(contents_of(request))}};
  EXPECT_EQ(plot(result, choices.dump())->text,
            command_line("plot --kind shape --request " + request + " " + file));
  std::remove(file.c_str());
  const Document whole = sweep(text_of("sweeps/frame_bays.json"), 0, 7);
  EXPECT_THAT(plot(whole->text, R"({"x": "last column"})")->text, HasSubstr("<svg"));
}

TEST(Library, TellsWhichChoiceOfAFigureIsWrong) {
  const Document result = solve(text_of("arch_no_base.json"));
  const auto first_error = [&](const std::string& choices) -> json {
    const Document answer = plot(result->text, choices);
    EXPECT_EQ(answer->status, SNAPTHROUGH_WRONG_REQUEST) << choices;
    return json::parse(answer->text).at("errors").at(0);
  };
  EXPECT_EQ(first_error(R"({"kind": "pie"})").at("pointer"), "choices:/kind");
  EXPECT_EQ(first_error(R"({"colour": 1})").at("code"), "unknown_field");
  EXPECT_EQ(first_error(R"({"width": 1})").at("pointer"), "choices:/width");
  EXPECT_EQ(first_error(R"({"state": -1})").at("pointer"), "choices:/state");
  EXPECT_EQ(first_error(R"({"where": {"a": 1}})").at("pointer"), "choices:/where");
  EXPECT_EQ(first_error("[]").at("pointer"), "choices:");
  EXPECT_EQ(first_error("{").at("code"), "malformed");
  EXPECT_EQ(first_error(R"({"kind": "shape", "state": 4711})").at("code"), "no_figure");
  EXPECT_EQ(plot("{}", "{}")->status, SNAPTHROUGH_WRONG_REQUEST);
  EXPECT_EQ(plot("", "{}")->status, SNAPTHROUGH_WRONG_REQUEST);
}

}  // namespace
