#include "solver/numeric/work_limit.h"

#include <utility>

namespace snapthrough {
namespace {

/// Polls between two questions; a question may cost a system call.
constexpr unsigned kPollsBetween = 64;

thread_local WorkLimit* innermost = nullptr;

}  // namespace

WorkLimit::WorkLimit(std::function<std::optional<WorkEnd>()> is_over)
    : is_over_(std::move(is_over)), outer_(std::exchange(innermost, this)) {}

WorkLimit::~WorkLimit() { innermost = outer_; }

void WorkLimit::poll() {
  if (innermost == nullptr || innermost->polls_++ % kPollsBetween != 0) {
    return;
  }
  if (const std::optional<WorkEnd> end = innermost->is_over_()) {
    throw WorkEnded{*end};
  }
}

}  // namespace snapthrough
