#include "server/resources/hops/catalogue.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>

#include "server/jobs/memory.h"
#include "server/resources/embedded.h"

namespace snapthrough::server::hops {
namespace {

constexpr std::string_view kReserved = "solve";
/// Largest file of a component in bytes. Anyone may request a component, so reading its file must be cheap;
/// models written by hand are far smaller.
constexpr std::uintmax_t kLargestFile = 1024 * 1024;

bool is_name(std::string_view name) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !name.empty() && name.size() <= 128 && name.front() != '.' && name != kReserved &&
         std::all_of(name.begin(), name.end(), allowed);
}

Entry entry_of(std::string_view text) {
  const LargeDocument room(text.size());
  api::ComponentOutcome read = api::read_component(text);
  if (read.component) {
    return {sweep_definition(*std::move(read.component)), {}};
  }
  Entry entry;
  for (const Finding& finding : read.findings) {
    entry.errors.push_back((finding.pointer.empty() ? "" : finding.pointer + ": ") + finding.detail);
  }
  return entry;
}

/// Returns the initial request of `solve-request`: a short example with a critical point.
std::string_view first_request() {
  const std::vector<http::Example>& examples = http::embedded_examples();
  const auto found = std::find_if(examples.begin(), examples.end(), [](const http::Example& example) {
    return example.name == "arch_outside_base_k1e7";
  });
  return found == examples.end() ? std::string_view() : found->document;
}

}  // namespace

Catalogue::Catalogue(std::string folder) : folder_(std::move(folder)) {
  built_in_.emplace(kSolveRequest, Entry{request_definition(first_request()), {}});
  for (const http::Example& component : http::embedded_components()) {
    built_in_.emplace(component.name, entry_of(component.document));
  }
}

std::vector<std::string> Catalogue::names() const {
  std::set<std::string> names;
  for (const auto& [name, entry] : built_in_) {
    names.insert(name);
  }
  std::error_code error;
  for (std::filesystem::directory_iterator file(folder_, error), end; !error && file != end;
       file.increment(error)) {
    if (file->path().extension() == ".json" && is_name(file->path().stem().string())) {
      names.insert(file->path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

std::optional<Entry> Catalogue::of_folder(const std::string& name) const {
  const std::filesystem::path path = std::filesystem::path(folder_) / (name + ".json");
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  const auto changed =
      error ? std::filesystem::file_time_type() : std::filesystem::last_write_time(path, error);
  if (error) {
    return std::nullopt;
  }
  {
    const std::lock_guard guard(mutex_);
    const auto known = read_.find(name);
    if (known != read_.end() && known->second.changed == changed && known->second.bytes == bytes) {
      return known->second.entry;
    }
  }
  // Without the lock: a large document waits for others, whose threads may wait for the lock (deadlock).
  Read read{changed, bytes, {}};
  std::ifstream file(path, std::ios::binary);
  if (bytes > kLargestFile || !file) {
    read.entry.errors = {file ? "The file of this component has more than 1 MB."
                              : "The file of this component cannot be read."};
  } else {
    read.entry = entry_of(std::string(std::istreambuf_iterator<char>(file), {}));
  }
  const std::lock_guard guard(mutex_);
  return read_.insert_or_assign(name, std::move(read)).first->second.entry;
}

std::optional<Entry> Catalogue::find(std::string_view name) const {
  if (!is_name(name)) {
    return std::nullopt;
  }
  if (std::optional<Entry> entry = folder_.empty() ? std::nullopt : of_folder(std::string(name))) {
    return entry;
  }
  const auto built_in = built_in_.find(name);
  return built_in == built_in_.end() ? std::nullopt : std::optional(built_in->second);
}

}  // namespace snapthrough::server::hops
