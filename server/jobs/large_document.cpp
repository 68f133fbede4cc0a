#include "server/jobs/large_document.h"

#include <malloc.h>

namespace snapthrough::server {
namespace {

constexpr std::size_t kSmall = 256 * 1024;

std::recursive_mutex& turn() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

LargeDocument::LargeDocument(std::size_t text_bytes)
    : lock_(text_bytes > kSmall ? std::unique_lock(turn()) : std::unique_lock<std::recursive_mutex>()) {}

LargeDocument::~LargeDocument() {
  if (lock_.owns_lock()) {
    ::malloc_trim(0);
  }
}

}  // namespace snapthrough::server
