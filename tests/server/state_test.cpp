#include "server/jobs/state.h"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace snapthrough::server {
namespace {

constexpr std::array kEvents{JobEvent::claim, JobEvent::finish, JobEvent::fail, JobEvent::requeue,
                             JobEvent::dismiss};

TEST(JobState, OnlyTheTransitionsOfTheContractAreLegal) {
  const std::set<std::tuple<JobState, JobEvent, JobState>> contract{
      {JobState::accepted, JobEvent::claim, JobState::running},
      {JobState::accepted, JobEvent::dismiss, JobState::dismissed},
      {JobState::running, JobEvent::finish, JobState::successful},
      {JobState::running, JobEvent::fail, JobState::failed},
      {JobState::running, JobEvent::requeue, JobState::accepted},
      {JobState::running, JobEvent::dismiss, JobState::dismissed},
  };
  std::set<std::tuple<JobState, JobEvent, JobState>> legal;
  for (const JobState from : kJobStates) {
    for (const JobEvent event : kEvents) {
      if (const auto to = next_state(from, event)) {
        legal.emplace(from, event, *to);
      }
    }
  }
  EXPECT_EQ(legal, contract);
}

TEST(JobState, AnEventHasOneOutcomeInAState) {
  std::set<std::pair<JobState, JobEvent>> seen;
  for (const JobTransition& row : kJobTransitions) {
    EXPECT_TRUE(seen.emplace(row.from, row.event).second) << to_string(row.from);
  }
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

std::string read_source(const char* path) {
  std::ifstream file(std::string(SNAPTHROUGH_SOURCE_DIR) + "/" + path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string_view event_name(JobEvent event) {
  static constexpr std::array<std::string_view, 5> kNames{"claim", "finish", "fail", "requeue", "dismiss"};
  return kNames[static_cast<std::size_t>(event)];
}

TEST(JobState, DiagramCodeAndDatabaseSayTheSame) {
  std::set<std::string> code;
  for (const JobTransition& row : kJobTransitions) {
    code.insert(std::string(event_name(row.event)) + " " + std::string(to_string(row.from)) + " " +
                std::string(to_string(row.to)));
  }
  std::set<std::string> diagram;
  const std::string header = read_source("server/jobs/state.h");
  const std::regex arrow(R"((\w+) --(\w+)--> (?=(\w+)))");
  for (auto it = std::sregex_iterator(header.begin(), header.end(), arrow); it != std::sregex_iterator();
       ++it) {
    diagram.insert((*it)[2].str() + " " + (*it)[1].str() + " " + (*it)[3].str());
  }
  std::set<std::string> database;
  const std::string sql = read_source("migrations/sqlite/0002_leases_owners_reuse.sql");
  const std::regex row(R"(\('(\w+)', '(\w+)', '(\w+)'\))");
  for (auto it = std::sregex_iterator(sql.begin(), sql.end(), row); it != std::sregex_iterator(); ++it) {
    database.insert((*it)[1].str() + " " + (*it)[2].str() + " " + (*it)[3].str());
  }
  EXPECT_EQ(diagram, code);
  EXPECT_EQ(database, code);
}

}  // namespace
}  // namespace snapthrough::server
