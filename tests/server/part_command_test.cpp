/// `sweep --part I/N --out FILE` and `merge`: a sweep that is shared out, interrupted and resumed is the
/// sweep.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "server/cli/app.h"
#include "server/cli/part_file.h"
#include "server/cli/streams.h"

namespace snapthrough::server::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

struct Outcome {
  int exit_status;
  std::string out;
  std::string err;
};

Outcome run_with(std::vector<std::string> arguments, const std::string& input = "") {
  arguments.insert(arguments.begin(), "snapthrough");
  std::vector<const char*> texts;
  for (const std::string& argument : arguments) {
    texts.push_back(argument.c_str());
  }
  std::istringstream in(input);
  std::ostringstream out;
  std::ostringstream err;
  const int status = run(static_cast<int>(texts.size()), texts.data(), {in, out, err});
  return {status, out.str(), err.str()};
}

/// Nine columns; the fourth has no valid stiffness, so that a row fails.
json columns() {
  return json::parse(R"({
    "model": {
      "nodes": [{"id": "foot", "x": 0, "y": 0}, {"id": "head", "x": 0, "y": 1}],
      "sections": [{"id": "shaft", "EA": 1e9, "EI": 1}],
      "members": [{"id": "column", "start": "foot", "end": "head", "section": "shaft"}],
      "supports": [{"node": "foot", "fixed": ["x", "y"]}, {"node": "head", "fixed": ["x"]}],
      "foundations": [{"id": "soil", "member": "column", "stiffness": 0}],
      "loads": [{"type": "point", "at": {"node": "head"}, "force": [0, -1]}]
    },
    "analysis": {"type": "buckling", "discretization": {"elements": 4, "order": 5}},
    "parameters": [{"name": "K", "targets": [{"pointer": "/model/foundations/0/stiffness"}],
                    "values": [0, 1, 2, -3, 10, 20, 30, 40.1, 50.7]}],
    "design": "grid",
    "outputs": ["/buckling/load_factors/0", "/summary/critical_type"]
  })");
}

class PartCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "part_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    document_ = (folder_ / "sweep.json").string();
    std::ofstream(document_) << columns().dump();
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::string contents(const std::string& name) const {
    std::ifstream stream(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] Outcome compute(const std::string& part, const std::string& name) const {
    return run_with({"sweep", document_, "--part", part, "--out", file(name)});
  }

  fs::path folder_;
  std::string document_;
};

TEST_F(PartCommand, MergedPartsAreTheTableByteForByte) {
  for (const char* part : {"3/4", "1/4", "4/4", "2/4"}) {
    const Outcome outcome = compute(part, std::string(1, part[0]));
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.exit_status, part[0] == '2' ? kNotCompleted : kDone) << part << outcome.err;
  }
  for (const std::vector<std::string>& form : {std::vector<std::string>{}, {"--csv"}, {"--ndjson"}}) {
    std::vector<std::string> merge{"merge", file("4"), file("2"), file("1"), file("3")};
    std::vector<std::string> sweep{"sweep", document_};
    merge.insert(merge.end(), form.begin(), form.end());
    sweep.insert(sweep.end(), form.begin(), form.end());
    const Outcome merged = run_with(merge);
    const Outcome whole = run_with(sweep);
    EXPECT_EQ(merged.out, whole.out);
    EXPECT_EQ(merged.exit_status, kNotCompleted);
    EXPECT_EQ(merged.err, whole.err);
  }
}

TEST_F(PartCommand, MorePartsThanPointsLeaveSomeEmpty) {
  std::vector<std::string> merge{"merge"};
  for (int part = 1; part <= 12; ++part) {
    const std::string name = std::to_string(part);
    EXPECT_NE(compute(name + "/12", name).exit_status, kOther);
    merge.push_back(file(name));
  }
  EXPECT_EQ(run_with(merge).out, run_with({"sweep", document_}).out);
}

/// Whatever byte it was cut at, the file is the same in the end, and whole rows are not computed again.
TEST_F(PartCommand, AFileThatWasCutIsGoneOnWith) {
  ASSERT_EQ(compute("1/1", "rows").exit_status, kNotCompleted);
  const std::string whole = contents("rows");
  const std::size_t head = whole.find('\n') + 1;
  for (std::size_t bytes = head; bytes < whole.size(); bytes += 13) {
    std::ofstream(file("rows"), std::ios::binary | std::ios::trunc) << whole.substr(0, bytes);
    ASSERT_EQ(compute("1/1", "rows").exit_status, kNotCompleted);
    ASSERT_EQ(contents("rows"), whole) << bytes;
  }
}

TEST_F(PartCommand, RowsThatAreThereAreKept) {
  ASSERT_EQ(compute("1/1", "rows").exit_status, kNotCompleted);
  std::string changed = contents("rows");
  const std::size_t at = changed.find("{\"point\":0,\"outputs\":[") + 22;
  changed.insert(at, "1");  // a row that no computation gives
  std::ofstream(file("rows"), std::ios::binary | std::ios::trunc) << changed.substr(0, changed.size() - 5);
  ASSERT_EQ(compute("1/1", "rows").exit_status, kNotCompleted);
  EXPECT_EQ(contents("rows"), changed);
}

TEST_F(PartCommand, MergeSaysWhatIsNotThere) {
  (void)compute("1/3", "1");
  (void)compute("3/3", "3");
  std::string rows = contents("3");
  rows.resize(rows.size() - 3);
  std::ofstream(file("3"), std::ios::binary | std::ios::trunc) << rows;
  const Outcome outcome = run_with({"merge", file("1"), file("3")});
  EXPECT_EQ(outcome.exit_status, kOther);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, HasSubstr("no file holds part 2/3"));
  EXPECT_THAT(outcome.err, HasSubstr("has 2 of 3 rows; `sweep SWEEP --part 3/3 --out "));
}

TEST_F(PartCommand, FilesThatDoNotBelongTogetherAreRefused) {
  (void)compute("1/2", "half");
  (void)compute("2/3", "third");
  EXPECT_THAT(run_with({"merge", file("half"), file("third")}).err,
              HasSubstr("parts of one split are merged"));
  EXPECT_THAT(run_with({"merge", file("half"), file("half")}).err, HasSubstr("are both part 1/2"));
  EXPECT_THAT(run_with({"merge", document_}).err, HasSubstr("is no part of a sweep"));
  EXPECT_THAT(run_with({"merge", file("absent")}).err, HasSubstr("cannot be read"));
  EXPECT_THAT(compute("2/2", "half").err, HasSubstr("holds part 1/2 of a sweep"));
  json other = columns();
  other["model"]["sections"][0]["EI"] = 2;
  std::ofstream(document_, std::ios::trunc) << other.dump();
  EXPECT_THAT(compute("1/2", "half").err, HasSubstr("holds rows of another sweep document"));
  (void)compute("2/2", "other half");
  EXPECT_THAT(run_with({"merge", file("half"), file("other half")}).err,
              HasSubstr("different sweep documents"));
}

/// Each would give a table that is no table.
TEST_F(PartCommand, MergeRefusesRowsThatTheProgramDoesNotWrite) {
  (void)compute("1/1", "rows");
  const std::string text = contents("rows");
  const std::size_t row = text.find("{\"point\":1,");
  const std::size_t end = text.find('\n', row);
  const std::string first = text.substr(row, end - row);
  ASSERT_THAT(first, HasSubstr(",\"bifurcation\"]}"));
  const std::string short_row = first.substr(0, first.find(",\"bifurcation\"")) + "]}";
  const std::string longer_row = first.substr(0, first.size() - 2) + ",1]}";
  const std::string other_member = first.substr(0, first.size() - 1) + ",\"more\":1}";
  for (const auto& [changed, why] :
       std::vector<std::pair<std::string, std::string>>{{first + "\r", "another end of the line"},
                                                        {other_member, "more than these"},
                                                        {short_row, "1 outputs instead of 2"},
                                                        {longer_row, "3 outputs instead of 2"}}) {
    std::ofstream(file("changed"), std::ios::binary | std::ios::trunc)
        << text.substr(0, row) + changed + text.substr(end);
    const Outcome outcome = run_with({"merge", file("changed")});
    EXPECT_EQ(outcome.exit_status, kOther) << changed;
    EXPECT_EQ(outcome.out, "") << changed;
    EXPECT_THAT(outcome.err, HasSubstr(why)) << changed;
  }
}

TEST_F(PartCommand, RowsOfAnotherVersionAreNotMixed) {
  (void)compute("1/1", "rows");
  std::string text = contents("rows");
  const std::string program = "\"program\":\"";
  text.insert(text.find(program) + program.size(), "9.");
  std::ofstream(file("rows"), std::ios::binary | std::ios::trunc) << text;
  const Outcome outcome = compute("1/1", "rows");
  EXPECT_EQ(outcome.exit_status, kOther);
  EXPECT_THAT(outcome.err, HasSubstr("rows of different versions are not mixed"));
  EXPECT_EQ(contents("rows"), text) << "the file is left as it is";
}

TEST_F(PartCommand, AFileIsWrittenByOneProcess) {
  const json document = columns();
  const api::SweepOutcome sweep = api::read_sweep_document(std::make_shared<json>(document));
  const PartWriter first(file("rows"), document, *sweep.sweep, {});
  EXPECT_THAT(compute("1/1", "rows").err, HasSubstr("is being written by another process"));
}

TEST_F(PartCommand, ADiskThatIsFullIsTold) {
  const Outcome outcome = run_with({"sweep", document_, "--out", "/dev/full"});
  EXPECT_EQ(outcome.exit_status, kOther);
  EXPECT_THAT(outcome.err, HasSubstr("cannot write /dev/full"));
}

TEST_F(PartCommand, APartIsTwoNumbers) {
  EXPECT_EQ(sweep_part_from("3/16"), (SweepPart{3, 16}));
  for (const char* text : {"", "3", "0/3", "4/3", "a/3", "1/", "/3", "1/3 ", "-1/3", "1/1000001"}) {
    EXPECT_EQ(sweep_part_from(text), std::nullopt) << text;
  }
  EXPECT_THAT(run_with({"sweep", document_, "--part", "4/3", "--out", file("rows")}).err,
              HasSubstr("1 <= I <= N"));
  EXPECT_THAT(run_with({"sweep", document_, "--part", "1/3"}).err, HasSubstr("--out"));
  EXPECT_THAT(run_with({"sweep", document_, "--csv", "--out", file("rows")}).err, HasSubstr("--csv"));
}

/// Two refined curves, each in a part of its own; the second has no valid section, so that all its points
/// fail.
TEST_F(PartCommand, PartsOfARefinedSweepAreMerged) {
  std::ifstream stream(std::string(SNAPTHROUGH_SOURCE_DIR) + "/examples/gallery/charts/film.json");
  json document = json::parse(stream);
  document["parameters"][0]["targets"] = {{{"pointer", "/model/foundations/0/stiffness"}, {"scale", 1e-4}}};
  document["parameters"][0]["range"] = {{"from", 0}, {"to", 1000}, {"count", 3}};
  const json bending = {
      {"name", "EI"}, {"targets", {{{"pointer", "/model/sections/0/EI"}}}}, {"values", {1, -1}}};
  document["parameters"].insert(document["parameters"].begin(), bending);
  document["refine"] = {{"output", "/buckling/load_factors/0"}};
  const std::string sweep = file("refined.json");
  std::ofstream(sweep) << document.dump();
  const Outcome whole = run_with({"sweep", sweep, "--csv"});
  EXPECT_EQ(whole.exit_status, 3);
  EXPECT_THAT(whole.err, HasSubstr(" points could not be completed"));
  for (const std::string part : {"1", "2"}) {
    run_with({"sweep", sweep, "--part", part + "/2", "--out", file("refined." + part)});
  }
  const Outcome merged = run_with({"merge", file("refined.1"), file("refined.2"), "--csv"});
  EXPECT_EQ(merged.exit_status, 3);
  EXPECT_EQ(merged.out, whole.out);
  EXPECT_EQ(merged.err, whole.err);
}

/// Curves are items: a part never cuts one.
TEST_F(PartCommand, PartsAreWholeCurves) {
  const std::string curve = std::string(SNAPTHROUGH_SOURCE_DIR) + "/examples/sweeps/ring_followed.json";
  std::ifstream stream(curve);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const api::SweepOutcome sweep = api::read_sweep(text);
  ASSERT_TRUE(sweep.sweep);
  std::uint64_t next = 0;
  for (std::uint64_t part = 1; part <= 5; ++part) {
    const ItemRange items = items_of({part, 5}, *sweep.sweep);
    EXPECT_EQ(items.first, next);
    next = items.end;
  }
  EXPECT_EQ(next, sweep.sweep->items());
}

}  // namespace
}  // namespace snapthrough::server::cli
