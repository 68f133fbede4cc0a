#include "server/store/sqlite/long_document.h"

#include <algorithm>

namespace snapthrough::server::sqlite {
namespace {

constexpr std::size_t kStoredBytes = std::size_t{1} << 20;

}  // namespace

std::string_view first_piece(std::string_view document) {
  std::size_t end = std::min(kStoredBytes, document.size());
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  while (end < document.size() && end > 0 && continues(document[end])) {
    --end;  // a text ends with a whole character
  }
  return document.substr(0, end);
}

void insert_document_rest(Connection& connection, std::int64_t job, std::string_view document) {
  std::string_view rest = document.substr(first_piece(document).size());
  for (std::int64_t number = 0; !rest.empty(); ++number) {
    const std::string_view bytes = rest.substr(0, kStoredBytes);
    connection.prepare("INSERT INTO result_pieces (job, number, bytes) VALUES (?, ?, ?)")
        .bind(job)
        .bind(number)
        .bind_blob(bytes)
        .run();
    rest.remove_prefix(bytes.size());
  }
}

DocumentPiece read_document_piece(const Connection& connection, std::int64_t job, std::size_t offset,
                                  std::size_t most) {
  DocumentPiece piece;
  std::size_t first = 0;
  piece.bytes = connection.part("results", "document", job, offset, most, first);
  Statement rest = connection.prepare("SELECT sum(length(bytes)) FROM result_pieces WHERE job = ?");
  rest.bind(job).step();
  piece.size = first + static_cast<std::size_t>(rest.integer(0));
  if (offset < first || offset >= piece.size) {
    return piece;
  }
  const std::size_t beyond = offset - first;
  Statement row = connection.prepare("SELECT seq FROM result_pieces WHERE job = ? AND number = ?");
  row.bind(job).bind(static_cast<std::int64_t>(beyond / kStoredBytes)).step();
  std::size_t size = 0;
  piece.bytes = connection.part("result_pieces", "bytes", row.integer(0), beyond % kStoredBytes, most, size);
  return piece;
}

}  // namespace snapthrough::server::sqlite
