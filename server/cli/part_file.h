#pragma once
/// @file
/// Files that hold the rows of a part of a sweep, so that a sweep can be shared out among processes and
/// hosts, be interrupted and be resumed.
///
/// A part file is NDJSON: a head `{"snapthrough_part": 1, "program", "part", "parts", "sweep"}` with the
/// whole sweep document, and one line for each point in the order of the points: `{"point": N, "outputs":
/// [...]}`, or
/// `{"point": N, "code": "...", "detail": "..."}` where the point failed.

#include <cstdint>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "api/sweep.h"
#include "server/descriptor.h"

namespace snapthrough::server::cli {

/// Part `number` of `count`, counted from 1.
struct SweepPart {
  std::uint64_t number = 1;
  std::uint64_t count = 1;

  bool operator==(const SweepPart&) const = default;
};

/// "3/16" as a part, or nothing: both numbers are at least 1, and the first is at most the second.
[[nodiscard]] std::optional<SweepPart> sweep_part_from(std::string_view text);

/// Units from `first` up to, and without, `end`.
struct UnitRange {
  std::uint64_t first = 0;
  std::uint64_t end = 0;

  bool operator==(const UnitRange&) const = default;
};

/// @brief The units of a part of a sweep: consecutive ones; sizes of parts differ by one unit at most. Empty
/// for some parts where there are more parts than units.
[[nodiscard]] UnitRange units_of(const SweepPart& part, const api::Sweep& sweep);

/// @brief Reads a part file from its beginning.
/// Not thread-safe. Its functions throw std::runtime_error, with the file's name, where the file is not what
/// it should be.
class PartReader {
 public:
  /// Reads the head. @throws std::runtime_error when the file cannot be read or is of another version of the
  /// program
  explicit PartReader(std::string path);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const SweepPart& part() const { return part_; }
  [[nodiscard]] const nlohmann::json& document() const { return document_; }

  /// The next point, or nothing after the last whole row.
  [[nodiscard]] std::optional<std::pair<std::uint64_t, api::PointOutcome>> next();
  /// Bytes up to the end of what was read: the head and whole rows.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::optional<std::string> next_line();
  [[noreturn]] void refuse(const std::string& why) const;

  std::string path_;
  std::ifstream file_;
  SweepPart part_;
  nlohmann::json document_;
  std::uint64_t bytes_ = 0;
};

/// @brief Writes a part file, or goes on with one.
/// The file is locked while it is open: two processes cannot write the same part. Not thread-safe.
class PartWriter {
 public:
  /// @brief Takes over the rows of whole units that the file has already; what follows them is cut off.
  /// @throws std::runtime_error when the file is in use, cannot be written, or holds another part, another
  /// sweep or rows of another version of the program: it is left as it is then
  PartWriter(std::string path, const nlohmann::json& document, const api::Sweep& sweep,
             const SweepPart& part);

  /// Points that the file had, and how many of them had failed.
  [[nodiscard]] std::uint64_t points_before() const { return points_; }
  [[nodiscard]] std::uint64_t failed_before() const { return failed_; }

  /// The line of a point.
  static void append_row(std::uint64_t point, const api::PointOutcome& outcome, std::string& text);
  /// @throws std::runtime_error when the disk does not take it
  void write(std::string_view text);

 private:
  void take_over(const nlohmann::json& document, const api::Sweep& sweep, const SweepPart& part);

  std::string path_;
  Descriptor file_;
  std::uint64_t points_ = 0;
  std::uint64_t failed_ = 0;
};

}  // namespace snapthrough::server::cli
