#include "server/jobs/state.h"

#include <gtest/gtest.h>

#include <set>

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

}  // namespace
}  // namespace snapthrough::server
