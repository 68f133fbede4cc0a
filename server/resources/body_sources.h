#pragma once
/// @file
/// Bodies that are read from the store while they are sent, in pieces: no reader holds a transaction longer
/// than a piece takes, and no body is in memory as a whole.

#include <memory>
#include <string>

#include "api/result_table.h"
#include "api/sweep_table.h"
#include "server/resources/message.h"
#include "server/store/store.h"

namespace snapthrough::server::http {

/// @brief The rows of a sweep's table, in the order of points, each as it is when its piece is read.
///
/// A table that was complete at the beginning ends with an error when the sweep was tried again meanwhile,
/// any table when the sweep was removed.
/// @param sweep as it is at the beginning
[[nodiscard]] std::shared_ptr<BodySource> table_source(SweepStore& store, const SweepRecord& sweep,
                                                       api::TableWriter writer, const PointQuery& query);

/// @brief The result document of a successful job. Fails with `conflict` when the job is removed meanwhile.
[[nodiscard]] std::shared_ptr<BodySource> result_source(Store& store, const std::string& job);

/// A table of that job's result as CSV. Fails as result_source() does.
[[nodiscard]] StatusOr<std::shared_ptr<BodySource>> result_table_source(Store& store, const std::string& job,
                                                                        api::ResultTable table);

/// @brief The response (200) with this body: the whole of it when it is no more than a piece.
/// What the source says when its first piece fails.
[[nodiscard]] StatusOr<Response> begin_body(std::shared_ptr<BodySource> source);

}  // namespace snapthrough::server::http
