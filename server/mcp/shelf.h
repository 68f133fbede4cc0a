#pragma once
/// @file
/// Documents that the tools of a session have made, for later calls.

#include <cstddef>
#include <deque>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace snapthrough::server::mcp {

/// A result or a table, with what was asked.
struct Kept {
  std::string id;  ///< e.g. "result-1"
  std::shared_ptr<const nlohmann::json> document;
  std::shared_ptr<const nlohmann::json> request;
};

/// @brief Keeps the latest documents, at most kMost and kMostBytes; the oldest go first. Not thread-safe.
class Shelf {
 public:
  static constexpr std::size_t kMost = 100;
  static constexpr std::size_t kMostBytes = std::size_t{256} << 20;  ///< bytes of their texts

  /// @param kind first part of the id. @param bytes of the document's text
  const Kept& add(std::string_view kind, std::shared_ptr<const nlohmann::json> document,
                  std::shared_ptr<const nlohmann::json> request, std::size_t bytes);
  /// Returns null for a document that is not there, or not any more.
  [[nodiscard]] const Kept* find(std::string_view id) const;
  [[nodiscard]] std::vector<std::string> ids() const;

 private:
  struct Place {
    Kept kept;
    std::size_t bytes = 0;
  };
  std::deque<Place> places_;
  std::size_t bytes_ = 0;
  int made_ = 0;
};

}  // namespace snapthrough::server::mcp
