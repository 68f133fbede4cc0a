#include "server/jobs/state.h"

#include <algorithm>

namespace snapthrough::server {
namespace {

/// In the order of JobState.
constexpr std::array<std::string_view, kJobStates.size()> kNames{"accepted", "running", "successful",
                                                                 "failed", "dismissed"};

}  // namespace

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

std::string_view to_string(JobState state) { return kNames.at(static_cast<std::size_t>(state)); }

std::optional<JobState> job_state_from(std::string_view name) {
  const auto* found = std::find(kNames.begin(), kNames.end(), name);
  return found == kNames.end() ? std::nullopt : std::optional(static_cast<JobState>(found - kNames.begin()));
}

}  // namespace snapthrough::server
