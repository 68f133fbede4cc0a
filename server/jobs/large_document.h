#pragma once
/// @file
/// Room for the trees of large documents.

#include <cstddef>
#include <mutex>

namespace snapthrough::server {

/// @brief While it lives, its thread may have a document in memory as a tree, which takes up to 30 times the
/// text: large documents one at a time in this process, small ones freely. Others wait.
///
/// Make it before the tree, so that it ends after it: memory that a large tree took is given back then.
class LargeDocument {
 public:
  explicit LargeDocument(std::size_t text_bytes);
  ~LargeDocument();
  LargeDocument(LargeDocument&&) = default;
  LargeDocument(const LargeDocument&) = delete;
  LargeDocument& operator=(const LargeDocument&) = delete;
  LargeDocument& operator=(LargeDocument&&) = delete;

 private:
  std::unique_lock<std::recursive_mutex> lock_;  ///< one document may lead to another, by the same thread
};

}  // namespace snapthrough::server
