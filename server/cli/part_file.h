#pragma once
/// @file
/// Files with the rows of a part of a sweep: processes and hosts can share a sweep, which can be interrupted
/// and resumed.
///
/// A part file is NDJSON: a head `{"snapthrough_part": 1, "program", "part", "parts", "sweep"}` with the
/// sweep document, then a line for each point in their order: `{"point": N, "outputs": [...]}`, or
/// `{"point": N, "code": "...", "detail": "..."}` for a failed point.

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "api/point_outcome.h"
#include "api/sweep.h"
#include "server/descriptor.h"

namespace snapthrough::server::cli {

/// Part `number` of `count`, counted from 1.
struct SweepPart {
  std::uint64_t number = 1;
  std::uint64_t count = 1;

  bool operator==(const SweepPart&) const = default;
};

/// Parses a part such as "3/16"; nullopt unless 1 <= number <= count.
[[nodiscard]] std::optional<SweepPart> sweep_part_from(std::string_view text);

/// Items `first` to `end` - 1.
struct ItemRange {
  std::uint64_t first = 0;
  std::uint64_t end = 0;

  bool operator==(const ItemRange&) const = default;
};

/// @brief Returns the consecutive items of a part. Sizes of parts differ by at most one item; with more parts
/// than items, some parts are empty.
[[nodiscard]] ItemRange items_of(const SweepPart& part, const api::Sweep& sweep);

/// @brief Reads a part file from its beginning. Not thread-safe. Functions throw std::runtime_error with the
/// file's name when the file's content is invalid.
class PartReader {
 public:
  /// Reads the head. @throws std::runtime_error when the file is unreadable or of another version of the
  /// program
  explicit PartReader(std::string path);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const SweepPart& part() const { return part_; }
  [[nodiscard]] const nlohmann::json& document() const { return document_; }

  /// Sets the number of outputs that a row must have: next() refuses others from then on.
  void require_outputs(std::size_t count) { outputs_ = count; }
  /// Returns the next row; nullopt after the last complete row.
  [[nodiscard]] std::optional<std::pair<std::uint64_t, api::PointOutcome>> next();
  /// Returns the number of bytes read: the head and complete rows.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::optional<std::string> next_line();
  [[noreturn]] void refuse(const std::string& why) const;

  std::string path_;
  std::ifstream file_;
  SweepPart part_;
  nlohmann::json document_;
  std::optional<std::size_t> outputs_;
  std::uint64_t bytes_ = 0;
};

/// @brief Creates or extends a part file. The file is locked while it is open, so that two processes cannot
/// write it. Not thread-safe.
class PartWriter {
 public:
  /// @brief Keeps the rows of complete items that the file has, and truncates the file after them.
  /// @throws std::runtime_error when the file is in use, cannot be written, or holds another part, another
  /// sweep or rows of another version of the program; the file is then unchanged
  PartWriter(std::string path, const nlohmann::json& document, const api::Sweep& sweep,
             const SweepPart& part);

  /// Return the number of outcomes (Sweep::size()) and of rows that the file had at first.
  [[nodiscard]] std::uint64_t points_before() const { return points_; }
  [[nodiscard]] const api::RowCounts& counts_before() const { return counts_; }

  /// Appends the line of a point to `text`.
  static void append_row(std::uint64_t point, const api::PointOutcome& outcome, std::string& text);
  /// @throws std::runtime_error when the write fails
  void write(std::string_view text);

 private:
  void take_over(const nlohmann::json& document, const api::Sweep& sweep, const SweepPart& part);

  std::string path_;
  Descriptor file_;
  std::uint64_t points_ = 0;
  api::RowCounts counts_;
};

}  // namespace snapthrough::server::cli
