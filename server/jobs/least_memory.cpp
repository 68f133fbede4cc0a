#include "server/jobs/least_memory.h"

#include <algorithm>
#include <string>

namespace snapthrough::server {
namespace {

/// Bytes for each unknown at the least: measured peaks are 388 and more, and
/// MemoryLimit.TheLeastIsBelowEveryPeak holds this one to be lower than all.
constexpr std::int64_t kLeastBytesByUnknown = 386;

}  // namespace

std::int64_t least_memory(const Model& model, const Analysis& analysis) {
  const Discretization& mesh = analysis.discretization;
  if (!mesh.fixed_mesh) {
    return 0;
  }
  std::int64_t elements = 0;
  for (const auto& [member, count] : mesh.member_elements) {
    elements += count;
  }
  const auto others = static_cast<std::int64_t>(model.members.size() - mesh.member_elements.size());
  elements += others * mesh.elements;
  // Each element has three displacements at each of its p places beyond the first.
  return 3 * elements * mesh.order * kLeastBytesByUnknown;
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
