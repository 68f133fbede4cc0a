#pragma once
/// @file
/// Catalogue of components: built-in ones, and sweep documents of a folder.

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/resources/hops/definition.h"

namespace snapthrough::server::hops {

/// Name of the component whose input is any request document.
inline constexpr std::string_view kSolveRequest = "solve-request";

/// A component, or the errors of its file.
struct Entry {
  std::shared_ptr<const Definition> definition;  ///< null exactly when there are errors
  std::vector<std::string> errors;               ///< errors of the file, as sentences
};

/// @brief The components of the service. Thread-safe.
///
/// NAME.json in the folder is the component NAME and replaces a built-in one of that name. A changed file is
/// read again at the next request. Names consist of letters, digits, "-", "_" and "."; other files are
/// ignored. "solve" is no name, because addresses of the protocol contain it.
class Catalogue {
 public:
  /// @param folder empty: built-in components only
  explicit Catalogue(std::string folder = {});

  /// Returns all names in ascending order.
  [[nodiscard]] std::vector<std::string> names() const;
  /// Returns a component; nullopt when there is none of that name.
  [[nodiscard]] std::optional<Entry> find(std::string_view name) const;

 private:
  struct Read {
    std::filesystem::file_time_type changed;
    std::uintmax_t bytes = 0;
    Entry entry;
  };
  [[nodiscard]] std::optional<Entry> of_folder(const std::string& name) const;

  const std::string folder_;
  std::map<std::string, Entry, std::less<>> built_in_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, Read, std::less<>> read_;  ///< files as last read
};

}  // namespace snapthrough::server::hops
