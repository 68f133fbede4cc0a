#pragma once
/// @file
/// Memory that documents and analyses take.

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "solver/check/check.h"

namespace snapthrough::server {

/// @brief Lets its thread hold the tree of a document, which takes up to 30 times the memory of the text.
/// Large documents wait for one another in this process; small ones do not wait.
///
/// REQUIRES: it is made before the tree and destroyed after it; then the memory of a large tree goes back to
/// the system.
class LargeDocument {
 public:
  static constexpr std::size_t kSmall = 256 * 1024;  ///< largest text, in bytes, of a small document

  explicit LargeDocument(std::size_t text_bytes);
  ~LargeDocument();
  LargeDocument(LargeDocument&&) = default;
  LargeDocument(const LargeDocument&) = delete;
  LargeDocument& operator=(const LargeDocument&) = delete;
  LargeDocument& operator=(LargeDocument&&) = delete;

 private:
  std::unique_lock<std::recursive_mutex> lock_;  ///< recursive: a document may lead its thread to another one
};

/// @brief Lower bound of the memory in bytes of an analysis on a fixed mesh; 0 when the solver chooses the
/// mesh: such an analysis is bounded only while it runs.
[[nodiscard]] std::int64_t least_memory(const Model& model, const Analysis& analysis);

/// @brief The finding that an analysis cannot be done within `limit` bytes; empty when it may be.
/// @pre check(model, analysis) is empty
[[nodiscard]] std::vector<Finding> check_memory(const Model& model, const Analysis& analysis,
                                                std::int64_t limit);

}  // namespace snapthrough::server
