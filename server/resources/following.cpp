#include "server/resources/following.h"

#include <algorithm>
#include <utility>

namespace snapthrough::server::http {
namespace {

constexpr double kLeastPause = 0.05;

}  // namespace

std::string event_text(std::uint64_t id, const char* kind, const std::string& data) {
  return "id: " + std::to_string(id) + "\nevent: " + kind + "\ndata: " + data + "\n\n";
}

Following::Following(JobService& jobs, std::string id, std::uint64_t last_id, Stream::Push push)
    : jobs_(jobs),
      id_(std::move(id)),
      last_(last_id),
      push_(std::move(push)),
      ticket_(jobs.context().completions, id_) {}

void Following::poll() {
  if (*ended_ && !finished_) {
    finished_ = true;
    push_(ending(), true);
  }
}

void Following::send_status(std::uint64_t number, const std::string& document) {
  last_ = std::max(number, last_.load());  // the id must not decrease for a client that received later events
  push_("retry: 1000\n\n" + event_text(last_, "status", document), false);
}

void Following::listen_for_end() {
  // The announcing thread holds locks, so it only sets a flag; poll() reads the store.
  ticket_.on_end([ended = ended_, push = push_] {
    *ended = true;
    push("", false);
  });
}

void Following::send(std::uint64_t number, const char* kind, const std::string& data) {
  last_ = number;
  push_(event_text(number, kind, data), false);
}

void Following::send_progress(std::uint64_t number, const std::string& data) {
  const double now = jobs_.environment().monotonic_seconds();
  if (!lacks(number) || now < next_progress_) {
    return;
  }
  next_progress_ = now + kLeastPause;
  send(number, "progress", data);
}

}  // namespace snapthrough::server::http
