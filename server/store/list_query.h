#pragma once
/// @file
/// Query of a list of jobs or sweeps.

#include <cstdint>
#include <optional>
#include <string>

#include "server/environment.h"
#include "server/jobs/state.h"

namespace snapthrough::server {

/// Place of an entry in a list. Lists are in the order of creation, newest first.
struct ListPlace {
  Time created;
  std::int64_t number = 0;  ///< order of arrival, for entries of the same microsecond
};

/// Selects the jobs or sweeps that meet every condition that is set.
struct ListQuery {
  int limit = 20;                            ///< > 0
  std::optional<ListPlace> before = {};      ///< `next` of the page before; empty: from the newest
  std::optional<JobState> state = {};        ///< only entries in this state
  std::string owner = {};                    ///< only entries of this owner
  std::optional<std::string> label = {};     ///< only entries with this label
  std::optional<std::string> analysis = {};  ///< only entries with this type of analysis
  std::optional<Time> created_after = {};    ///< only entries created later
  std::optional<Time> created_before = {};   ///< only entries created earlier
};

}  // namespace snapthrough::server
