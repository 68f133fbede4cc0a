#include "server/jobs/memory.h"

#include <malloc.h>

#include <string>

#include "solver/mesh/mesh.h"

namespace snapthrough::server {
namespace {

/// Bytes for each unknown, a lower bound: what each further unknown of a large mesh takes is 475 and more
/// (linear static analysis, order 5). The test MemoryLimit.TheLeastIsBelowEveryPeak compares peaks of small
/// meshes.
constexpr std::int64_t kLeastBytesByUnknown = 440;
/// Bytes for each unknown that a search for buckling loads adds, a lower bound: two blocks of four vectors
/// with their images and products, of two numbers or more for each unknown of a node. Each further unknown of
/// a large mesh takes 1 120 bytes and more (order 8).
constexpr std::int64_t kLeastBytesOfSearch = 8 * 3 * 2 * sizeof(double);

/// Bytes for each unknown that following a path adds, a lower bound: two points with their tangents, a
/// predicted point, a residual and two corrections.
constexpr std::int64_t kLeastBytesOfPath = 8 * sizeof(double);

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

std::int64_t least_memory(const Model& model, const Analysis& analysis) {
  const Discretization& mesh = analysis.discretization;
  if (!mesh.fixed_mesh) {
    return 0;
  }
  const std::int64_t elements = given_elements(model.members, mesh);
  // An element of order p adds p nodes with three unknowns each.
  const bool follows = analysis.traits().follows_path;
  const std::int64_t more = analysis.traits().linearised ? kLeastBytesOfSearch
                            : follows                    ? kLeastBytesOfPath
                                                         : 0;
  return 3 * elements * mesh.order * (kLeastBytesByUnknown + more);
}

std::vector<Finding> check_memory(const Model& model, const Analysis& analysis, std::int64_t limit) {
  const std::int64_t least = least_memory(model, analysis);
  if (least <= limit) {
    return {};
  }
  return {{"/analysis/discretization/elements", "memory_limit",
           "a mesh of this size needs more than " + std::to_string(least) +
               " bytes of memory, and an analysis may use " + std::to_string(limit)}};
}

}  // namespace snapthrough::server
