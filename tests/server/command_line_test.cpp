/// @file
/// The real program: Ctrl-C, tables, terminals, and the scripts that the documents show.

#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "server/cli/interruption.h"
#include "tests/server/support/client.h"
#include "tests/server/support/process.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/temp_dir.h"
#include "tests/server/support/terminal.h"

namespace snapthrough::server::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class CommandLine : public testing::Test {
 protected:
  int run(const std::vector<std::string>& arguments, const std::string& input = "") {
    Process process(folder_, arguments, input);
    const int status = process.wait();
    out_ = process.out();
    err_ = process.err();
    return status;
  }
  std::string file(const std::string& name, const std::string& text) {
    write_file(folder_.file(name), text);
    return folder_.file(name);
  }
  /// Starts it, and interrupts it once it has computed for half a second and, if asked for, has written
  /// something.
  int run_interrupted(const std::vector<std::string>& arguments, int signal, bool until_output) {
    Process process(folder_, arguments);
    EXPECT_TRUE(eventually([&] {
      return process.processor_seconds() > 0.5 && (!until_output || process.out().size() >= 10'000);
    }));
    process.signal(signal);
    const int status = process.wait();
    out_ = process.out();
    err_ = process.err();
    return status;
  }

  TempDir folder_;
  std::string out_;
  std::string err_;
};

/// A path of many small steps, which takes minutes.
std::string long_request() {
  json request = json::parse(column_request());
  request["analysis"]["discretization"] = {{"elements", 20}, {"order", 4}};
  request["analysis"]["step"] = {{"initial", 1e-6}, {"max", 1e-6}};
  request["analysis"]["stop"] = {{"steps", 1'000'000}};
  return request.dump();
}

TEST_F(CommandLine, CtrlCOnSolveLeavesWhatWasReached) {
  const std::string request = file("long.json", long_request());
  EXPECT_EQ(run_interrupted({"solve", request}, SIGINT, false), 128 + SIGINT) << err_;
  const json result = json::parse(out_);
  EXPECT_EQ(result.at("failure").at("code"), "cancelled");
  EXPECT_GT(result.at("branches")[0].at("load_factor").size(), 1U);
  EXPECT_EQ(run_interrupted({"solve", "--csv", request}, SIGTERM, false), 128 + SIGTERM) << err_;
  EXPECT_THAT(
      out_,
      StartsWith("branch,point,load_factor,arc_length,negative_eigenvalues,stiffness_ratio,tip\r\n0,0,"));
  EXPECT_THAT(err_, HasSubstr("[cancelled]"));
}

TEST_F(CommandLine, CtrlCOnASweepLeavesWholeRowsAndSaysHowMany) {
  const std::string sweep = file("sweep.json", column_sweep(1'000'000));
  EXPECT_EQ(run_interrupted({"sweep", sweep, "--threads", "2"}, SIGINT, true), 128 + SIGINT) << err_;
  const json table = json::parse(out_);
  const std::size_t rows = table.at("rows").size();
  EXPECT_GT(rows, 10U);
  EXPECT_EQ(err_, "interrupted: " + std::to_string(rows) + " of 1000000 rows were written\n");
  for (const json& row : table.at("rows")) {
    EXPECT_TRUE(row.back().is_null()) << "no row of a point that was stopped: " << row;
  }
  EXPECT_EQ(run_interrupted({"sweep", sweep, "--csv"}, SIGTERM, true), 128 + SIGTERM) << err_;
  EXPECT_EQ(out_.back(), '\n');
}

TEST(InterruptionDeathTest, ASecondSignalEndsTheProcessAtOnce) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const cli::Interruption interruption;
        ::kill(::getpid(), SIGINT);
        while (!interruption.token().stop_requested()) {
          std::this_thread::yield();
        }
        ::kill(::getpid(), SIGINT);
        std::this_thread::sleep_for(std::chrono::seconds(20));
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST_F(CommandLine, SolveGivesTheTableOfTheAnalysis) {
  json request = json::parse(column_request());
  EXPECT_EQ(run({"solve", "--csv", "-"}, request.dump()), 0) << err_;
  EXPECT_THAT(out_,
              StartsWith("branch,point,load_factor,arc_length,negative_eigenvalues,stiffness_ratio,tip\r\n"));
  EXPECT_EQ(run({"solve", "--table", "critical_points", "-"}, request.dump()), 0) << err_;
  EXPECT_THAT(out_, StartsWith("branch,type,cause,load_factor,"));
  EXPECT_THAT(out_, HasSubstr("\r\n0,bifurcation,smooth,2.46"));  // pi^2 / 4
  request["analysis"]["type"] = "buckling";
  EXPECT_EQ(run({"solve", "--csv", "-"}, request.dump()), 0) << err_;
  EXPECT_THAT(out_, StartsWith("mode,load_factor,error_estimate\r\n1,2.46"));
  request["analysis"]["type"] = "static";
  EXPECT_EQ(run({"solve", "--table", "states", "-"}, request.dump()), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("\r\n0,0,1,m,0,"));
  EXPECT_EQ(run({"solve", "--csv", "-"}, request.dump()), 0) << err_;
  EXPECT_THAT(out_, StartsWith("load_factor,negative_eigenvalues,state,tip\r\n1,0,0,"));
}

// A frame whose bays are not alike passes the bifurcation of the frame with equal bays at a stiffness of a
// few hundredths and ends at a limit load far above it.
TEST_F(CommandLine, SolveWarnsOfAStructureThatIsNearlyUnstable) {
  const std::string request = SNAPTHROUGH_SOURCE_DIR "/examples/frame_nearly_unstable.json";
  ASSERT_EQ(run({"solve", request}), 0) << err_;
  const json result = json::parse(out_);
  ASSERT_EQ(result.at("warnings").size(), 1U);
  const std::string detail = result.at("warnings")[0].at("detail").get<std::string>();
  EXPECT_EQ(err_, "Warning: " + detail + " [nearly_unstable]\n");
  EXPECT_THAT(detail, StartsWith("nearly unstable: at load factor 10"));
  ASSERT_EQ(run({"solve", "--csv", request}), 0);
  EXPECT_THAT(err_, HasSubstr("[nearly_unstable]"));
}

TEST_F(CommandLine, ATableThatAnAnalysisDoesNotHaveIsRefused) {
  EXPECT_EQ(run({"solve", "--table", "buckling", "-"}, column_request()), 1);
  EXPECT_THAT(
      err_, HasSubstr("an analysis of type path has no such table; it has points, critical_points, states"));
  EXPECT_THAT(out_, IsEmpty());
  EXPECT_EQ(run({"solve", "--table", "tables", "-"}, column_request()), 1);
}

/// The command line and the service write the same bytes.
TEST_F(CommandLine, TablesAreThoseOfTheService) {
  Process service(folder_, {"serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db")});
  const int port = listening_port(service);
  const std::string result = post(port, "/v1/jobs", column_request()).header("Location") + "/result";
  for (const std::string table : {"points", "critical_points", "states"}) {
    const Reply reply = get(port, result + "?format=csv&table=" + table);
    EXPECT_EQ(reply.status, 200) << reply.body;
    TempDir other;
    Process command(other, {"solve", "--table", table, "-"}, column_request());
    EXPECT_EQ(command.wait(), 0);
    EXPECT_EQ(command.out(), reply.body) << table;
  }
  EXPECT_EQ(get(port, result + "?table=points").body, get(port, result + "?format=csv").body);
  EXPECT_NE(get(port, result + "?table=states").header("ETag"),
            get(port, result + "?format=csv").header("ETag"));
  for (const char* query : {"?format=csv&table=static", "?table=tables", "?format=json&table=points"}) {
    const Reply reply = get(port, result + query);
    EXPECT_EQ(reply.status, 400) << query;
    EXPECT_THAT(reply.body, HasSubstr("points, critical_points, states")) << query;
  }
}

TEST_F(CommandLine, APointOfASweepIsARequest) {
  const std::string sweep = file("sweep.json", column_sweep(3));
  ASSERT_EQ(run({"sweep", sweep, "--point", "2"}), 0) << err_;
  const std::string request = out_;
  EXPECT_EQ(json::parse(request)["model"]["sections"][0]["EI"], 3.0);
  EXPECT_EQ(run({"solve", "-"}, request), 0) << err_;
  EXPECT_EQ(run({"sweep", sweep, "--point", "3"}), 1);
  EXPECT_THAT(err_, HasSubstr("0 to 2"));
}

TEST_F(CommandLine, TheSweepsOfTheExamplesAreValid) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SNAPTHROUGH_SOURCE_DIR "/examples/sweeps")) {
    EXPECT_EQ(run({"check", entry.path()}), 0) << err_;
    ++count;
  }
  EXPECT_GE(count, 4);
  ASSERT_EQ(run({"sweep", "--csv", SNAPTHROUGH_SOURCE_DIR "/examples/sweeps/lining_thickness.json"}), 0)
      << err_;
  EXPECT_THAT(out_, HasSubstr("\n0.1,clamped,2851.3"));  // as docs/sweeps.md shows it
}

TEST_F(CommandLine, BarAndRowsNeverShareATerminal) {
  const std::string sweep = file("sweep.json", column_sweep(200));
  const std::string both = run_on_terminal({"sweep", sweep, "--csv"});
  EXPECT_THAT(both, Not(HasSubstr("[#")));
  EXPECT_THAT(both, HasSubstr("200.0,"));
  const std::string bar = run_on_terminal({"sweep", sweep, "--csv"}, folder_.file("rows.csv"));
  EXPECT_THAT(bar, HasSubstr("200/200"));
  EXPECT_THAT(read_file(folder_.file("rows.csv")), Not(HasSubstr("[#")));
}

TEST_F(CommandLine, ABackupLeavesNothingButTheCopy) {
  {
    Process service(folder_, {"serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db")});
    ASSERT_GT(listening_port(service), 0);
    TempDir other;
    std::filesystem::create_directory(folder_.file("copies"));
    Process backup(other, {"backup", "--store", folder_.file("jobs.db"), folder_.file("copies/copy.db")});
    EXPECT_EQ(backup.wait(), 0) << backup.err();
  }
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.file("copies"))) {
    names.push_back(entry.path().filename());
  }
  EXPECT_THAT(names, testing::ElementsAre("copy.db"));
  EXPECT_EQ(run({"backup", "--store", folder_.file("jobs.db"), folder_.file("no/copy.db")}), 1);
}

TEST_F(CommandLine, ACopyOfWhatIsNotThereIsRefusedAndLeavesNothing) {
  EXPECT_EQ(run({"copy", folder_.file("nowhere.db"), folder_.file("copy.db")}), 1);
  EXPECT_FALSE(std::filesystem::exists(folder_.file("nowhere.db")));
  EXPECT_FALSE(std::filesystem::exists(folder_.file("copy.db")));
  EXPECT_EQ(run({"migrate", "--store", folder_.file("new.db")}), 0);
  EXPECT_EQ(run({"copy", folder_.file("new.db"), folder_.file("copy.db")}), 0);
  EXPECT_EQ(run({"work", "--store", folder_.file("new.db")}), 1) << "nobody else could use it";
}

/// The block of a document that begins with a line and ends with three backquotes.
std::string block_of(const std::string& document, const std::string& first_line) {
  const std::string text = read_file(std::string(SNAPTHROUGH_SOURCE_DIR "/") + document);
  const std::size_t begin = text.find(first_line);
  EXPECT_NE(begin, std::string::npos) << document << " has no " << first_line;
  return begin == std::string::npos ? "" : text.substr(begin, text.find("\n```", begin) + 1 - begin);
}

/// Runs a shell script that a document shows. @return its exit status; 124 after 120 seconds
int run_script(const TempDir& folder, const std::string& arguments, int port) {
  const std::string command = "cd " + folder.file(".") +
                              " && SNAPTHROUGH=http://127.0.0.1:" + std::to_string(port) +
                              " timeout 120 sh script.sh " + arguments + " > script.out 2> script.err";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// docs/sweeps.md, as it stands there: a table, or a message and an exit status, never a loop.
TEST_F(CommandLine, TheShellScriptOfTheDocumentEndsWhateverTheServiceSays) {
  Process service(folder_, {"serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db")});
  const int port = listening_port(service);
  TempDir work;
  write_file(work.file("script.sh"), block_of("docs/sweeps.md", "#!/bin/sh"));
  write_file(work.file("sweep.json"), column_sweep(3));
  EXPECT_EQ(run_script(work, "sweep.json table.csv", port), 0) << read_file(work.file("script.err"));
  EXPECT_THAT(read_file(work.file("table.csv")), StartsWith("EI,/summary/critical_load_factor,"));
  json wrong = json::parse(column_sweep(3));
  wrong["outputs"] = {"/summary/critical_load"};
  write_file(work.file("wrong.json"), wrong.dump());
  EXPECT_EQ(run_script(work, "wrong.json none.csv", port), 1);
  EXPECT_THAT(read_file(work.file("script.err")), HasSubstr("did you mean /summary/critical_load_factor?"));
  EXPECT_FALSE(std::filesystem::exists(work.file("none.csv")));
  json failing = json::parse(column_sweep(3));
  failing["parameters"][0]["range"]["from"] = -1;  // not a stiffness
  write_file(work.file("failing.json"), failing.dump());
  EXPECT_EQ(run_script(work, "failing.json failed.csv", port), 3);
  EXPECT_THAT(read_file(work.file("failed.csv")), HasSubstr("wrong_request"));
  EXPECT_EQ(run_script(work, "missing.json none.csv", port), 1);
  service.signal(SIGTERM);
  service.wait();
  EXPECT_EQ(run_script(work, "sweep.json none.csv", port), 1);
}

/// The blocks of the README, as they stand there: every command of the first, and the service and what asks
/// it.
TEST_F(CommandLine, TheCommandsOfTheReadmeRun) {
  const std::string program = "build/release/snapthrough ";
  const auto runs = [&](std::string line) {
    const std::string built = std::string(SNAPTHROUGH_EXECUTABLE) + " ";
    for (std::size_t at = line.find(program); at != line.npos; at = line.find(program, at + built.size())) {
      line.replace(at, program.size(), built);
    }
    const std::string command = "cd " SNAPTHROUGH_SOURCE_DIR " && timeout 120 " +
                                line.substr(0, line.find('#')) + " > " + folder_.file("out");
    EXPECT_EQ(std::system(command.c_str()), 0) << line;
  };
  std::istringstream lines(block_of("README.md", program + "check"));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    runs(line);
  }
  EXPECT_GE(count, 3);
  EXPECT_THAT(block_of("README.md", program + "serve"), Not(HasSubstr("curl"))) << "it does not come back";
  Process service(folder_, {"serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db")});
  std::string ask = block_of("README.md", "curl -H");
  const std::string address = "127.0.0.1:8080";
  ASSERT_NE(ask.find(address), std::string::npos);
  ask.replace(ask.find(address), address.size(), "127.0.0.1:" + std::to_string(listening_port(service)));
  ask.pop_back();
  const std::string command = "cd " SNAPTHROUGH_SOURCE_DIR " && " + ask + " -sf > " + folder_.file("answer");
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(json::parse(read_file(folder_.file("answer"))).contains("summary"));
}

TEST_F(CommandLine, ThePythonScriptOfTheDocumentPrintsTheTable) {
  Process service(folder_, {"serve", "--listen", "127.0.0.1:0", "--store", folder_.file("jobs.db")});
  const int port = listening_port(service);
  TempDir work;
  std::string script = block_of("docs/sweeps.md", "import json, sys, urllib.request");
  const std::string address = "http://127.0.0.1:8080";
  ASSERT_NE(script.find(address), std::string::npos);
  script.replace(script.find(address), address.size(), "http://127.0.0.1:" + std::to_string(port));
  write_file(work.file("script.py"), script);
  write_file(work.file("sweep.json"), column_sweep(3));
  const std::string command =
      "cd " + work.file(".") + " && timeout 120 python3 script.py sweep.json > out 2> err";
  EXPECT_EQ(std::system(command.c_str()), 0) << read_file(work.file("err"));
  EXPECT_THAT(read_file(work.file("out")), HasSubstr("'EI': 3.0"));
}

}  // namespace
}  // namespace snapthrough::server::test
