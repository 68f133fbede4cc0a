#pragma once
/// @file
/// The life of a job: its states and the one table of what may follow what.
///
///     accepted --claim--> running --finish--> successful
///     accepted --dismiss--> dismissed
///     running --fail--> failed
///     running --requeue--> accepted
///     running --dismiss--> dismissed
///
/// Successful, failed and dismissed are final.

#include <array>
#include <optional>
#include <string_view>

namespace snapthrough::server {

enum class JobState { accepted, running, successful, failed, dismissed };

inline constexpr std::array kJobStates{JobState::accepted, JobState::running, JobState::successful,
                                       JobState::failed, JobState::dismissed};

/// What happens to a job.
enum class JobEvent { claim, finish, fail, requeue, dismiss };

/// One legal change of state.
struct JobTransition {
  JobEvent event;
  JobState from;
  JobState to;
};

/// Every legal change; what is not here is refused.
inline constexpr std::array kJobTransitions{
    JobTransition{JobEvent::claim, JobState::accepted, JobState::running},
    JobTransition{JobEvent::finish, JobState::running, JobState::successful},
    JobTransition{JobEvent::fail, JobState::running, JobState::failed},
    JobTransition{JobEvent::requeue, JobState::running, JobState::accepted},
    JobTransition{JobEvent::dismiss, JobState::accepted, JobState::dismissed},
    JobTransition{JobEvent::dismiss, JobState::running, JobState::dismissed},
};

/// The state that follows, or nothing when the event is not legal in that state.
[[nodiscard]] std::optional<JobState> next_state(JobState from, JobEvent event);

/// Whether nothing can happen to a job in this state any more.
[[nodiscard]] bool is_final(JobState state);

/// The state's name in the interface and in the database: "accepted", "running", ...
[[nodiscard]] std::string_view to_string(JobState state);

/// The state of that name, or nothing.
[[nodiscard]] std::optional<JobState> job_state_from(std::string_view name);

}  // namespace snapthrough::server
