/// @file
/// The tables of legal changes of jobs and sweeps, and everything that has to agree with them.

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "server/jobs/sweep_state.h"
#include "server/store/driver.h"
#include "server/store/postgresql/connection.h"
#include "server/store/sqlite/connection.h"
#include "tests/server/support/postgresql.h"
#include "tests/server/support/samples.h"
#include "tests/server/support/store_driver.h"

namespace snapthrough::server::test {
namespace {

using testing::ElementsAreArray;

/// "event from to" of each row.
template <class Rows>
std::set<std::string> changes_in(const Rows& rows) {
  std::set<std::string> all;
  for (const auto& row : rows) {
    all.insert(std::string(to_string(row.event)) + " " + std::string(to_string(row.from)) + " " +
               std::string(to_string(row.to)));
  }
  EXPECT_EQ(all.size(), rows.size()) << "a row stands twice";
  return all;
}

std::string read_source(const std::string& path) {
  std::ifstream file(std::string(SNAPTHROUGH_SOURCE_DIR) + "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(JobState, OnlyTheTransitionsOfTheContractAreLegal) {
  EXPECT_EQ(changes_in(kJobTransitions),
            (std::set<std::string>{"claim accepted running", "finish running successful",
                                   "fail running failed", "requeue running accepted",
                                   "dismiss accepted dismissed", "dismiss running dismissed"}));
  EXPECT_EQ(
      changes_in(kSweepTransitions),
      (std::set<std::string>{"claim accepted running", "claim running running", "finish running successful",
                             "fail running failed", "dismiss accepted dismissed", "dismiss running dismissed",
                             "retry failed accepted", "retry dismissed accepted"}));
}

/// What an event leads to is one state: drivers write it without a look at the state before.
template <class Rows>
void expect_one_outcome(const Rows& rows) {
  for (const auto& row : rows) {
    EXPECT_EQ(state_after(row.event), row.to) << to_string(row.event);
    EXPECT_EQ(next_state(row.from, row.event), row.to) << to_string(row.event);
  }
}

TEST(JobState, AnEventHasOneOutcome) {
  expect_one_outcome(kJobTransitions);
  expect_one_outcome(kSweepTransitions);
}

TEST(JobState, FinalStatesAreThoseThatNothingFollows) {
  for (const JobState state : kJobStates) {
    const bool expected =
        state == JobState::successful || state == JobState::failed || state == JobState::dismissed;
    EXPECT_EQ(is_final(state), expected) << to_string(state);
  }
}

TEST(JobState, NamesReadBack) {
  for (const JobState state : kJobStates) {
    EXPECT_EQ(job_state_from(to_string(state)), state);
  }
  EXPECT_EQ(job_state_from("Running"), std::nullopt);
  EXPECT_EQ(job_state_from(""), std::nullopt);
}

TEST(JobState, ConditionsOfDriversComeFromTheTables) {
  EXPECT_EQ(may(JobEvent::claim), "status = 'accepted'");
  EXPECT_EQ(may(JobEvent::dismiss), "status IN ('accepted', 'running')");
  EXPECT_EQ(may(SweepEvent::retry), "status IN ('failed', 'dismissed')");
  EXPECT_EQ(becomes(SweepEvent::retry), "status = 'accepted'");
}

TEST(JobState, NoDriverSpellsAState) {
  const std::filesystem::path folder = std::string(SNAPTHROUGH_SOURCE_DIR) + "/server/store";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".cpp") {
      continue;  // headers have examples in comments
    }
    ++files;
    const std::string text = read_source(std::filesystem::relative(entry.path(), SNAPTHROUGH_SOURCE_DIR));
    for (const JobState state : kJobStates) {
      EXPECT_EQ(text.find(literal(state)), std::string::npos) << entry.path() << " " << to_string(state);
    }
  }
  EXPECT_GT(files, 15);
}

TEST(JobState, TheInterfaceHasTheStates) {
  const auto document = nlohmann::json::parse(read_source("api/openapi/openapi.json"));
  const auto names = document.at("components").at("schemas").at("Status").at("enum");
  EXPECT_THAT(names.get<std::vector<std::string>>(), ElementsAreArray(kJobStateNames));
}

/// "event from to" of each row of the first table after the text.
std::set<std::string> documented(const std::string& document, const std::string& after) {
  const std::size_t begin = document.find(after);
  EXPECT_NE(begin, std::string::npos) << after;
  const std::size_t end = document.find("\n\n", document.find("\n| `", begin));
  const std::string table = document.substr(begin, end - begin);
  const std::regex row(R"(\| `(\w+)` \| `(\w+)` \| `(\w+)` \|)");
  std::set<std::string> all;
  for (auto it = std::sregex_iterator(table.begin(), table.end(), row); it != std::sregex_iterator(); ++it) {
    all.insert((*it)[1].str() + " " + (*it)[2].str() + " " + (*it)[3].str());
  }
  return all;
}

TEST(JobState, TheDocumentHasTheTables) {
  const std::string document = read_source("docs/service.md");
  EXPECT_EQ(documented(document, "| a job: event |"), changes_in(kJobTransitions));
  EXPECT_EQ(documented(document, "| a sweep: event |"), changes_in(kSweepTransitions));
}

/// The schema of a driver, by statements that are the same for both.
class StateSchema : public StoreTest {
 protected:
  [[nodiscard]] bool is_postgresql() const { return GetParam().shared; }
  /// Three texts of each row, with blanks between.
  std::set<std::string> select(const std::string& sql) {
    std::set<std::string> all;
    if (is_postgresql()) {
      const postgresql::Rows rows = postgresql::Connection(postgresql_location(folder_.name())).run(sql);
      for (int row = 0; row < rows.count(); ++row) {
        all.insert(rows[row].text(0) + " " + rows[row].text(1) + " " + rows[row].text(2));
      }
      return all;
    }
    const sqlite::Connection connection(folder_.file("store.db"), sqlite::Access::read_only);
    sqlite::Statement row = connection.prepare(sql);
    while (row.step()) {
      all.insert(row.text(0) + " " + row.text(1) + " " + row.text(2));
    }
    return all;
  }
  /// The error of a statement; empty: none.
  std::string error_of(const std::string& sql) {
    try {
      if (is_postgresql()) {
        postgresql::Connection(postgresql_location(folder_.name())).execute(sql);
      } else {
        sqlite::Connection(folder_.file("store.db"), sqlite::Access::read_write).execute(sql);
      }
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  /// A statement that inserts a job or sweep in that state.
  static std::string insertion(const std::string& table, const std::string& state, int number) {
    const bool started = state != "accepted" && state != "dismissed";
    const bool ended = state != "accepted" && state != "running";
    const std::string count = state == "failed" ? "1" : "0";
    std::string columns = "id, status, created_us, started_us, finished_us";
    std::string values = "'" + id_number(number) + "', '" + state + "', 1, " + (started ? "2" : "NULL") +
                         ", " + (ended ? "3" : "NULL");
    columns += table == "jobs" ? ", title, analysis_type, attempt" : ", points";
    values += table == "jobs" ? std::string(", '', 'path', ") + (started ? "1" : "0") : ", 2";
    return "INSERT INTO " + table + " (" + columns + ") VALUES (" + values + ")";
  }
};

TEST_P(StateSchema, HasTheTransitionsOfJobs) {
  EXPECT_EQ(select("SELECT event, from_status, to_status FROM job_transitions"), changes_in(kJobTransitions));
}

TEST_P(StateSchema, RefusesEveryOtherChangeOfAJob) {
  int number = 0;
  for (const JobState from : kJobStates) {
    for (const JobState to : kJobStates) {
      if (from == to) {
        continue;
      }
      const std::string id = id_number(++number);
      ASSERT_EQ(error_of(insertion("jobs", std::string(to_string(from)), number)), "");
      const bool legal = std::any_of(kJobTransitions.begin(), kJobTransitions.end(),
                                     [&](const auto& row) { return row.from == from && row.to == to; });
      const std::string lease = is_postgresql() ? "" : ", worker = 'w', lease_until_us = 9";
      const std::string error =
          error_of("UPDATE jobs SET status = " + literal(to) + lease + " WHERE id = '" + id + "'");
      SCOPED_TRACE(std::string(to_string(from)) + " to " + std::string(to_string(to)) + ": " + error);
      if (legal) {  // may be refused for what the change lacks, e.g. a result
        EXPECT_EQ(error.find("a job cannot change"), std::string::npos);
      } else if (to != JobState::successful) {
        EXPECT_NE(error.find("a job cannot change"), std::string::npos);
      } else {
        EXPECT_NE(error, "");  // SQLite may miss the result before it looks at the transition
      }
    }
  }
}

TEST_P(StateSchema, KnowsNoOtherState) {
  const std::string unknown = insertion("jobs", "held", 1);
  EXPECT_NE(error_of(unknown), "");
  EXPECT_NE(error_of(insertion("sweeps", "held", 1)), "");
  int number = 1;
  for (const JobState state : kJobStates) {
    EXPECT_EQ(error_of(insertion("jobs", std::string(to_string(state)), ++number)), "") << to_string(state);
  }
}

INSTANTIATE_TEST_SUITE_P(Drivers, StateSchema, testing::ValuesIn(store_drivers()), driver_name);

}  // namespace
}  // namespace snapthrough::server::test
