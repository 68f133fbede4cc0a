#pragma once
/// @file
/// The table of legal changes of a sweep.

#include "server/jobs/state.h"

namespace snapthrough::server {

/// Event in the life of a sweep. `finish` and `fail` come with the row of its last point.
enum class SweepEvent { claim, finish, fail, dismiss, retry };

/// Names in documents, in the order of SweepEvent.
inline constexpr std::array<std::string_view, 5> kSweepEventNames{"claim", "finish", "fail", "dismiss",
                                                                  "retry"};

/// Every legal change of a sweep.
inline constexpr std::array<Transition<SweepEvent>, 8> kSweepTransitions{{
    {SweepEvent::claim, JobState::accepted, JobState::running},
    {SweepEvent::claim, JobState::running, JobState::running},
    {SweepEvent::finish, JobState::running, JobState::successful},
    {SweepEvent::fail, JobState::running, JobState::failed},
    {SweepEvent::dismiss, JobState::accepted, JobState::dismissed},
    {SweepEvent::dismiss, JobState::running, JobState::dismissed},
    {SweepEvent::retry, JobState::failed, JobState::accepted},
    {SweepEvent::retry, JobState::dismissed, JobState::accepted},
}};

constexpr std::string_view to_string(SweepEvent event) {
  return kSweepEventNames.at(static_cast<std::size_t>(event));
}
constexpr const auto& transitions_of(SweepEvent /*event*/) { return kSweepTransitions; }

}  // namespace snapthrough::server
