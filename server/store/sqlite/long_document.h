#pragma once
/// @file
/// Result documents in pieces: the first is its row of `results`, what follows are rows of `result_pieces`.

#include <cstdint>
#include <string_view>

#include "server/store/sqlite/connection.h"
#include "server/store/store.h"

namespace snapthrough::server::sqlite {

/// What is stored in `results`.
[[nodiscard]] std::string_view first_piece(std::string_view document);

/// Inserts what follows it. Throws Error.
void insert_document_rest(Connection& connection, std::int64_t job, std::string_view document);

/// @brief Some of a document that is stored, as of Store::result_piece(). Throws Error.
/// @pre the job has a result
[[nodiscard]] DocumentPiece read_document_piece(const Connection& connection, std::int64_t job,
                                                std::size_t offset, std::size_t most);

}  // namespace snapthrough::server::sqlite
