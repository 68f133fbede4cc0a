#include "server/cli/remote_output.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

namespace snapthrough::server::cli {
namespace {

namespace fs = std::filesystem;

/// Whether a path can name a file that is renamed to it: devices and pipes are written, not replaced.
bool can_be_replaced(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return !path.empty() && (!fs::exists(status) || fs::is_regular_file(status));
}

/// Opens a file without a name.
std::FILE* open_unnamed() {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "snapthrough-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) {
    return nullptr;
  }
  ::unlink(name.c_str());
  return ::fdopen(descriptor, "w+b");
}

}  // namespace

Output::Output(std::string path, std::ostream& out)
    : path_(std::move(path)),
      has_part_(can_be_replaced(path_)),
      out_(out),
      file_(has_part_ ? std::fopen(part().c_str(), "w+b") : open_unnamed()),
      is_whole_(file_ != nullptr) {}

Output::~Output() {
  if (has_part_ && file_ != nullptr) {
    file_.reset();
    std::error_code ignored;
    fs::remove(part(), ignored);
  }
}

void Output::begin() {
  in_skipped_line_ = skips_line_;
  if (size_ != settled_) {
    size_ = settled_;
    is_whole_ = is_whole_ && std::fflush(file_.get()) == 0 &&
                ::ftruncate(::fileno(file_.get()), static_cast<off_t>(size_)) == 0 &&
                ::fseeko(file_.get(), static_cast<off_t>(size_), SEEK_SET) == 0;
  }
}

bool Output::write(std::string_view piece) {
  if (in_skipped_line_) {
    const std::size_t end = piece.find('\n');
    in_skipped_line_ = end == std::string_view::npos;
    piece.remove_prefix(in_skipped_line_ ? piece.size() : end + 1);
  }
  is_whole_ = is_whole_ && std::fwrite(piece.data(), 1, piece.size(), file_.get()) == piece.size();
  size_ += piece.size();
  return is_whole_;
}

nlohmann::json Output::member(const std::string& name) const {
  using nlohmann::json;
  if (file_ == nullptr || std::fseek(file_.get(), 0, SEEK_SET) != 0) {
    return {};
  }
  const auto is_wanted = [&name](int depth, json::parse_event_t event, json& value) {
    return depth != 1 || event != json::parse_event_t::key || value == name;
  };
  const json document = json::parse(file_.get(), is_wanted, false);
  std::fseek(file_.get(), 0, SEEK_END);
  return document.is_object() ? document.value(name, json()) : json();
}

bool Output::copy_to(std::ostream& out) const {
  std::array<char, 64 * 1024> piece;
  std::size_t count = 0;
  bool is_read = std::fseek(file_.get(), 0, SEEK_SET) == 0;
  while (is_read && out && (count = std::fread(piece.data(), 1, piece.size(), file_.get())) > 0) {
    out.write(piece.data(), static_cast<std::streamsize>(count));
  }
  is_read = is_read && std::ferror(file_.get()) == 0;
  out << std::flush;
  return is_read && out;
}

bool Output::keep() {
  if (!is_whole_ || std::fflush(file_.get()) != 0) {
    return false;
  }
  if (!has_part_) {
    if (path_.empty()) {
      return copy_to(out_);
    }
    std::ofstream file(path_, std::ios::binary);
    return copy_to(file);
  }
  std::error_code error;
  const bool is_closed = std::fclose(file_.release()) == 0;
  fs::rename(part(), path_, error);
  if (!is_closed || error) {
    std::error_code ignored;
    fs::remove(part(), ignored);
    return false;
  }
  return true;
}

}  // namespace snapthrough::server::cli
