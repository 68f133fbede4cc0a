#pragma once
/// @file
/// The low priority of threads and processes that give way to others.

#include <sys/resource.h>

namespace snapthrough::server {

/// Nice value of a thread or process that gives way: it has a tenth of the time of another one.
inline constexpr int kGivesWay = 10;

/// Lets the calling thread give way to all others, for good.
inline void give_way_from_now_on() { ::setpriority(PRIO_PROCESS, 0, kGivesWay); }

}  // namespace snapthrough::server
