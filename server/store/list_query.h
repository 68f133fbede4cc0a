#pragma once
/// @file
/// Which jobs or sweeps to list.

#include <cstdint>
#include <optional>
#include <string>

#include "server/environment.h"
#include "server/jobs/state.h"

namespace snapthrough::server {

/// An entry's place in a list, which is in the order of creation, newest first.
struct ListPlace {
  Time created;
  std::int64_t number = 0;  ///< order of arrival, for those of the same microsecond
};

/// Which jobs or sweeps to list: those that meet every condition that is set.
struct ListQuery {
  int limit = 20;                            ///< > 0
  std::optional<ListPlace> before = {};      ///< `next` of the page before; empty: from the newest
  std::optional<JobState> state = {};        ///< only these
  std::string owner = {};                    ///< only of this owner
  std::optional<std::string> label = {};     ///< only with this label
  std::optional<std::string> analysis = {};  ///< only of this type
  std::optional<Time> created_after = {};    ///< later than this
  std::optional<Time> created_before = {};   ///< earlier than this
};

}  // namespace snapthrough::server
