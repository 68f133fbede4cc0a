#include "server/jobs/job_completions.h"

#include <utility>

namespace snapthrough::server {
namespace {

/// Removes the entry of an id that holds that pointer.
template <class Map, class Pointer>
void erase_entry(Map& map, const std::string& id, Pointer pointer) {
  const auto [first, last] = map.equal_range(id);
  for (auto it = first; it != last; ++it) {
    if (it->second == pointer) {
      map.erase(it);
      return;
    }
  }
}

}  // namespace

JobCompletions::Ticket::Ticket(JobCompletions& completions, std::string id)
    : completions_(completions), id_(std::move(id)) {
  const std::lock_guard guard(completions_.mutex_);
  completions_.tickets_.emplace(id_, this);
}

JobCompletions::Ticket::~Ticket() {
  const std::lock_guard guard(completions_.mutex_);
  erase_entry(completions_.tickets_, id_, this);
}

void JobCompletions::Ticket::on_end(std::function<void()> callback) {
  const std::lock_guard guard(completions_.mutex_);
  if (ended_ || completions_.closed_) {
    return callback();
  }
  callback_ = std::move(callback);
}

void JobCompletions::call(Ticket& ticket) {
  ticket.ended_ = true;
  if (ticket.callback_) {
    std::exchange(ticket.callback_, nullptr)();
  }
}

void JobCompletions::announce(const std::string& id) {
  end(id);
  bell_.ring();
}

std::vector<std::string> JobCompletions::waited() {
  const std::lock_guard guard(mutex_);
  std::vector<std::string> ids;
  for (const auto& [id, ticket] : tickets_) {
    if (!ticket->ended_) {
      ids.push_back(id);
    }
  }
  return ids;
}

void JobCompletions::end(const std::string& id) {
  const std::lock_guard guard(mutex_);
  const auto [first, last] = tickets_.equal_range(id);
  for (auto it = first; it != last; ++it) {
    call(*it->second);
  }
}

void JobCompletions::close() {
  const std::lock_guard guard(mutex_);
  closed_ = true;
  for (const auto& [id, ticket] : tickets_) {
    call(*ticket);
  }
}

}  // namespace snapthrough::server
