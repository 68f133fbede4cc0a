#pragma once
/// @file
/// A step of the history of a store's schema.

#include <string_view>

namespace snapthrough::server {

/// One step, from the file migrations/<driver>/<name>.sql.
struct Migration {
  int version = 0;            ///< 1, 2, ... without gaps
  std::string_view name;      ///< file name without ending, e.g. "0001_jobs"
  std::string_view checksum;  ///< SHA-256 of the file, to notice that an applied step was edited later
  std::string_view sql;
};

}  // namespace snapthrough::server
