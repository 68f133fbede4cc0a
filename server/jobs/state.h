#pragma once
/// @file
/// States of jobs and sweeps, and the table of legal changes of a job.
///
/// This table and the table of sweeps (sweep_state.h) are the only lists of legal changes. Drivers of stores
/// make their SQL of them (server/store/driver.h). Tests try every change on every driver, and compare both
/// tables with the schemas, the OpenAPI document and docs/service.md.

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace snapthrough::server {

/// State of a job or sweep.
enum class JobState { accepted, running, successful, failed, dismissed };

inline constexpr std::array kJobStates{JobState::accepted, JobState::running, JobState::successful,
                                       JobState::failed, JobState::dismissed};

/// Names in the interface and in databases, in the order of JobState.
inline constexpr std::array<std::string_view, kJobStates.size()> kJobStateNames{
    "accepted", "running", "successful", "failed", "dismissed"};

/// Event in the life of a job.
enum class JobEvent { claim, finish, fail, requeue, dismiss };

/// Names in databases and documents, in the order of JobEvent.
inline constexpr std::array<std::string_view, 5> kJobEventNames{"claim", "finish", "fail", "requeue",
                                                                "dismiss"};

/// A legal change of state.
template <class Event>
struct Transition {
  Event event;
  JobState from;
  JobState to;
};

/// Every legal change of a job.
inline constexpr std::array<Transition<JobEvent>, 6> kJobTransitions{{
    {JobEvent::claim, JobState::accepted, JobState::running},
    {JobEvent::finish, JobState::running, JobState::successful},
    {JobEvent::fail, JobState::running, JobState::failed},
    {JobEvent::requeue, JobState::running, JobState::accepted},
    {JobEvent::dismiss, JobState::accepted, JobState::dismissed},
    {JobEvent::dismiss, JobState::running, JobState::dismissed},
}};

constexpr std::string_view to_string(JobState state) {
  return kJobStateNames.at(static_cast<std::size_t>(state));
}
constexpr std::string_view to_string(JobEvent event) {
  return kJobEventNames.at(static_cast<std::size_t>(event));
}
constexpr const auto& transitions_of(JobEvent /*event*/) { return kJobTransitions; }

/// The state of that name, or nothing.
constexpr std::optional<JobState> job_state_from(std::string_view name) {
  for (const JobState state : kJobStates) {
    if (to_string(state) == name) {
      return state;
    }
  }
  return std::nullopt;
}

/// The state that follows, or nothing when the event is not legal in that state.
template <class Event>
constexpr std::optional<JobState> next_state(JobState from, Event event) {
  for (const Transition<Event>& row : transitions_of(event)) {
    if (row.from == from && row.event == event) {
      return row.to;
    }
  }
  return std::nullopt;
}

/// The state that an event leads to, the same from every state in which it is legal.
template <class Event>
constexpr JobState state_after(Event event) {
  for (const Transition<Event>& row : transitions_of(event)) {
    if (row.event == event) {
      return row.to;
    }
  }
  return JobState::accepted;  // not reached: every event has a row
}

/// Whether no event of a job is legal in this state: nothing is computed for a job or sweep in it.
constexpr bool is_final(JobState state) {
  return std::none_of(kJobTransitions.begin(), kJobTransitions.end(),
                      [&](const Transition<JobEvent>& row) { return row.from == state; });
}

}  // namespace snapthrough::server
