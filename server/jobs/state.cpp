#include "server/jobs/state.h"

#include <algorithm>

namespace snapthrough::server {

std::optional<JobState> next_state(JobState from, JobEvent event) {
  const auto* row = std::find_if(kJobTransitions.begin(), kJobTransitions.end(),
                                 [&](const JobTransition& t) { return t.from == from && t.event == event; });
  if (row == kJobTransitions.end()) {
    return std::nullopt;
  }
  return row->to;
}

bool is_final(JobState state) {
  return std::none_of(kJobTransitions.begin(), kJobTransitions.end(),
                      [&](const JobTransition& t) { return t.from == state; });
}

std::string_view to_string(JobState state) {
  switch (state) {
    case JobState::accepted:
      return "accepted";
    case JobState::running:
      return "running";
    case JobState::successful:
      return "successful";
    case JobState::failed:
      return "failed";
    case JobState::dismissed:
      return "dismissed";
  }
  return "";
}

std::optional<JobState> job_state_from(std::string_view name) {
  const auto* state = std::find_if(kJobStates.begin(), kJobStates.end(),
                                   [&](JobState candidate) { return to_string(candidate) == name; });
  if (state == kJobStates.end()) {
    return std::nullopt;
  }
  return *state;
}

}  // namespace snapthrough::server
