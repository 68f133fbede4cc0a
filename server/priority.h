#pragma once
/// @file
/// The low priority of threads and processes that give way to others.

#include <sys/resource.h>

#include <chrono>

namespace snapthrough::server {

/// Nice value of a thread or process that gives way: where both want the same processor without a pause, it
/// has it for a tenth of the time that one of nice value 0 has it.
inline constexpr int kGivesWay = 10;

/// Longest duration of short work. A job, or an item of a sweep, that takes longer gives way to short ones
/// from then on: its process gets a lower priority.
inline constexpr std::chrono::milliseconds kShort{1000};

/// Lets the calling thread give way to all others, for good.
inline void give_way_from_now_on() { ::setpriority(PRIO_PROCESS, 0, kGivesWay); }

}  // namespace snapthrough::server
