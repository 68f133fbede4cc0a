#pragma once
/// @file
/// Where components come from: those that are built into the program, and the sweep documents of a folder.

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

/// The component that takes any request document.
inline constexpr std::string_view kSolveRequest = "solve-request";

/// A component by its name, or why its file is none.
struct Entry {
  std::shared_ptr<const Definition> definition;  ///< null exactly when there are errors
  std::vector<std::string> errors;               ///< sentences
};

/// @brief The components of the service. Thread-safe.
///
/// NAME.json in the folder is the component NAME, and goes before a built-in one of that name. A file that
/// changed is read again when it is asked for. Names are letters, digits, "-", "_" and "."; other files are
/// left out, and "solve" is the name of no component: it is a part of the protocol's addresses.
class Catalogue {
 public:
  /// @param folder empty: built-in components only
  explicit Catalogue(std::string folder = {});

  /// Ascending.
  [[nodiscard]] std::vector<std::string> names() const;
  /// Nothing when there is no component of that name.
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
  mutable std::map<std::string, Read, std::less<>> read_;  ///< files as they were last read
};

}  // namespace snapthrough::server::hops
