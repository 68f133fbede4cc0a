#include "server/cli/part_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

namespace snapthrough::server::cli {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Version of the file format.
constexpr int kForm = 1;
constexpr const char* kFormKey = "snapthrough_part";

std::string head_of(const json& document, const SweepPart& part) {
  const ordered_json head{{kFormKey, kForm},
                          {"program", SNAPTHROUGH_VERSION},
                          {"part", part.number},
                          {"parts", part.count},
                          {"sweep", document}};
  return head.dump() + "\n";
}

std::optional<std::uint64_t> number_from(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

/// Returns a member of an object as JSON text; "" when absent.
std::string text_of(const json& object, const char* name) {
  const auto member = object.find(name);
  return member == object.end() ? "" : member->dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string row_begin(std::uint64_t point) { return "{\"point\":" + std::to_string(point); }

}  // namespace

std::optional<SweepPart> sweep_part_from(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == text.npos) {
    return std::nullopt;
  }
  const auto number = number_from(text.substr(0, slash));
  const auto count = number_from(text.substr(slash + 1));
  if (!number || !count || *number < 1 || *number > *count || *count > api::kMaxSweepPoints) {
    return std::nullopt;
  }
  return SweepPart{*number, *count};
}

ItemRange items_of(const SweepPart& part, const api::Sweep& sweep) {
  return {sweep.items() * (part.number - 1) / part.count, sweep.items() * part.number / part.count};
}

PartReader::PartReader(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary) {
  if (!file_) {
    refuse("cannot be read");
  }
  const std::optional<std::string> line = next_line();
  json head = line ? json::parse(*line, nullptr, false) : json();
  if (!head.is_object() || text_of(head, kFormKey) != std::to_string(kForm)) {
    refuse("is no part of a sweep: `snapthrough sweep --out FILE` writes such files");
  }
  if (const std::string program = text_of(head, "program"); program != json(SNAPTHROUGH_VERSION).dump()) {
    refuse("was written by version " + program +
           " of the program, this is \"" SNAPTHROUGH_VERSION "\": rows of different versions are not mixed");
  }
  const auto part = sweep_part_from(text_of(head, "part") + "/" + text_of(head, "parts"));
  if (!part || !head.contains("sweep")) {
    refuse("has a head that does not say which part of which sweep it is");
  }
  part_ = *part;
  document_ = std::move(head["sweep"]);
}

void PartReader::refuse(const std::string& why) const { throw std::runtime_error(path_ + " " + why); }

std::optional<std::string> PartReader::next_line() {
  std::string line;
  if (!std::getline(file_, line) || file_.eof()) {
    return std::nullopt;  // a line without end is incomplete
  }
  bytes_ += line.size() + 1;
  return line;
}

std::optional<std::pair<std::uint64_t, api::PointOutcome>> PartReader::next() {
  const std::optional<std::string> line = next_line();
  if (!line) {
    return std::nullopt;
  }
  const json row = json::parse(*line, nullptr, false);
  if (!row.is_object() || !row.contains("point") || !row["point"].is_number_unsigned()) {
    refuse("has a line that is no row, at byte " + std::to_string(bytes_ - line->size() - 1));
  }
  const auto point = row["point"].get<std::uint64_t>();
  if (const auto code = row.find("code"), detail = row.find("detail");
      code != row.end() && code->is_string() && detail != row.end() && detail->is_string()) {
    return std::pair(point, api::PointOutcome{"", code->get<std::string>(), detail->get<std::string>()});
  }
  // The original text of the outputs keeps their digits in a merged table.
  const std::string begin = row_begin(point) + ",\"outputs\":";
  if (!line->starts_with(begin) || !line->ends_with('}') || row.size() != 2 || !row["outputs"].is_array()) {
    refuse("has a row of point " + std::to_string(point) +
           " that is not as `sweep --out` writes it: neither outputs nor a failure, more than these, or "
           "another end of the line");
  }
  if (outputs_ && row["outputs"].size() != *outputs_) {
    refuse("has a row with " + std::to_string(row["outputs"].size()) + " outputs instead of " +
           std::to_string(*outputs_) + ", of point " + std::to_string(point));
  }
  return std::pair(point,
                   api::PointOutcome{line->substr(begin.size(), line->size() - begin.size() - 1), "", ""});
}

PartWriter::PartWriter(std::string path, const json& document, const api::Sweep& sweep, const SweepPart& part)
    : path_(std::move(path)), file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_.get() < 0) {
    throw std::runtime_error("cannot open " + path_ + ": " + std::strerror(errno));
  }
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    throw std::runtime_error(path_ + " is being written by another process");
  }
  struct stat status {};
  ::fstat(file_.get(), &status);
  if (status.st_size == 0) {
    write(head_of(document, part));
  } else {
    take_over(document, sweep, part);
  }
}

void PartWriter::take_over(const json& document, const api::Sweep& sweep, const SweepPart& part) {
  PartReader reader(path_);
  if (reader.part() != part) {
    throw std::runtime_error(path_ + " holds part " + std::to_string(reader.part().number) + "/" +
                             std::to_string(reader.part().count) + " of a sweep");
  }
  if (reader.document() != document) {
    throw std::runtime_error(path_ + " holds rows of another sweep document");
  }
  const std::uint64_t first = items_of(part, sweep).first * sweep.item_size();
  std::uint64_t whole_bytes = reader.bytes();
  std::uint64_t points = 0;
  api::RowCounts counts;
  while (const auto row = reader.next()) {
    if (row->first != first + points) {
      throw std::runtime_error(path_ + " has the row of point " + std::to_string(row->first) +
                               " where that of point " + std::to_string(first + points) + " should be");
    }
    ++points;
    const api::RowCounts more = sweep.row_counts(row->first, row->second);
    counts.rows += more.rows;
    counts.failed += more.failed;
    if (points % sweep.item_size() == 0) {
      whole_bytes = reader.bytes();
      points_ = points;
      counts_ = counts;
    }
  }
  if (::ftruncate(file_.get(), static_cast<off_t>(whole_bytes)) != 0 ||
      ::lseek(file_.get(), 0, SEEK_END) < 0) {
    throw std::runtime_error("cannot write " + path_ + ": " + std::strerror(errno));
  }
}

void PartWriter::append_row(std::uint64_t point, const api::PointOutcome& outcome, std::string& text) {
  text += row_begin(point);
  if (outcome.failed()) {
    const auto quoted = [](const std::string& value) {
      return json(value).dump(-1, ' ', false, json::error_handler_t::replace);
    };
    text += ",\"code\":" + quoted(outcome.code) + ",\"detail\":" + quoted(outcome.detail) + "}\n";
  } else {
    text += ",\"outputs\":" + outcome.outputs + "}\n";
  }
}

void PartWriter::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file_.get(), text.data(), text.size());
    if (written < 0 && errno != EINTR) {
      throw std::runtime_error("cannot write " + path_ + ": " + std::strerror(errno));
    }
    text.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
  }
}

}  // namespace snapthrough::server::cli
