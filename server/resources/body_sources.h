#pragma once
/// @file
/// Bodies that are read from the store in pieces while they are sent: no reader holds a transaction longer
/// than one piece takes, and no body is in memory as a whole.

#include <memory>
#include <string>

#include "api/result_table.h"
#include "api/sweep_table.h"
#include "server/resources/message.h"
#include "server/store/store.h"

namespace snapthrough::server::http {

/// @brief Returns the rows of a sweep's table in the order of points, each as stored when its piece is read.
///
/// The body of a complete table ends with an error when the sweep is retried in the meantime, the body of any
/// table when the sweep is deleted.
/// @param sweep record of the sweep at the beginning
[[nodiscard]] std::shared_ptr<BodySource> table_source(SweepStore& store, const SweepRecord& sweep,
                                                       api::TableWriter writer, const PointQuery& query);

/// @brief Returns the result document of a successful job. `conflict` when the job is deleted meanwhile.
[[nodiscard]] std::shared_ptr<BodySource> result_source(Store& store, const std::string& job);

/// Returns a table of a job's result as CSV. `conflict` when the job is deleted meanwhile.
[[nodiscard]] StatusOr<std::shared_ptr<BodySource>> result_table_source(Store& store, const std::string& job,
                                                                        api::ResultTable table);

/// @brief Returns a response (200) that begins with the body's first piece; `rest` has the others, if any.
/// Returns the source's status when the first piece fails.
[[nodiscard]] StatusOr<Response> begin_body(std::shared_ptr<BodySource> source);

}  // namespace snapthrough::server::http
