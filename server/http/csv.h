#pragma once
/// @file
/// Tables as CSV (RFC 4180).

#include <string>

#include "server/jobs/job.h"

namespace snapthrough::server::http {

/// @brief The points of all paths of a result, one a row, under a header line.
///
/// Columns: branch, point, load_factor, arc_length, negative_eigenvalues, one for each monitor (its id) and
/// one for each base (contact_fraction:<id>). Numbers have the digits that read back to the same value; what
/// a branch does not have is empty.
[[nodiscard]] std::string path_csv(const StoredPath& path);

}  // namespace snapthrough::server::http
