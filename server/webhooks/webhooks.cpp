#include "server/webhooks/webhooks.h"

#include <csignal>
#include <optional>
#include <utility>

#include "server/bell.h"
#include "server/resources/documents.h"
#include "server/webhooks/signature.h"

namespace snapthrough::server {
namespace {

constexpr std::chrono::milliseconds kBetweenCuts{20};
constexpr std::chrono::seconds kAfterStoreTrouble{5};

/// Blocks SIGPIPE: a write to a closed socket then returns an error.
void ignore_closed_sockets() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGPIPE);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

/// Returns the status document of an ended job or sweep; "" when it was deleted or is running again.
StatusOr<std::string> ended_document(Store& store, const Delivery& delivery) {
  if (delivery.sweep) {
    const StatusOr<std::optional<SweepRecord>> sweep = store.sweeps().get(delivery.id);
    if (!sweep.ok()) {
      return sweep.status();
    }
    return *sweep && is_final((*sweep)->state) ? http::sweep_status_document(**sweep) : std::string();
  }
  const StatusOr<std::optional<Job>> job = store.get(delivery.id);
  if (!job.ok()) {
    return job.status();
  }
  return *job && is_final((*job)->state) ? http::job_status_document(**job, std::nullopt) : std::string();
}

}  // namespace

struct Webhooks::Sender {
  Sender(const std::string& to, std::chrono::milliseconds longest) : origin(to), poster(to, longest) {}

  const std::string origin;
  Poster poster;
  std::jthread thread;
};

Webhooks::Webhooks(const WebhookSurroundings& surroundings, const std::vector<std::string>& origins,
                   std::string key)
    : world_(surroundings), key_(std::move(key)) {
  for (const std::string& origin : origins) {
    senders_.push_back(std::make_unique<Sender>(origin, world_.times.attempt));
  }
  for (const std::unique_ptr<Sender>& sender : senders_) {
    sender->thread =
        std::jthread([this, &own = *sender](const std::stop_token& stop) { send_due(own, stop); });
  }
  if (senders_.empty()) {
    return;
  }
  watch_ = std::jthread([this](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      for (const std::unique_ptr<Sender>& sender : senders_) {
        sender->poster.cut_late(sender->thread.get_stop_token().stop_requested());
      }
      pause(stop, kBetweenCuts);
    }
  });
}

Webhooks::~Webhooks() {
  for (const std::unique_ptr<Sender>& sender : senders_) {
    sender->thread.request_stop();
  }
  for (const std::unique_ptr<Sender>& sender : senders_) {
    sender->thread.join();
  }
}

void Webhooks::send_due(Sender& sender, const std::stop_token& stop) {
  ignore_closed_sockets();
  while (!stop.stop_requested()) {
    const StatusOr<std::optional<Delivery>> due =
        world_.store.deliveries().next(sender.origin, 2 * world_.times.attempt, world_.environment.now());
    if (!due.ok()) {
      world_.log.write(LogLevel::error, "store", {{"detail", std::string_view(due.status().message())}});
    }
    if (!due.ok() || !*due) {
      pause(stop, world_.times.poll);
    } else if (!deliver(sender, **due, stop)) {
      pause(stop, kAfterStoreTrouble);  // a delivery that cannot be recorded would be repeated at once
    }
  }
}

/// Sends one delivery. Returns false when the store failed.
bool Webhooks::deliver(Sender& sender, const Delivery& delivery, const std::stop_token& stop) {
  const StatusOr<std::string> body = ended_document(world_.store, delivery);
  if (!body.ok() || body->empty()) {
    return body.ok();  // deleted or retried since, and so was its delivery
  }
  const std::string id = delivery.id + "-" + std::to_string(delivery.number);
  const std::int64_t timestamp =
      std::chrono::floor<std::chrono::seconds>(world_.environment.now()).time_since_epoch().count();
  const PostOutcome outcome =
      sender.poster.post(delivery.address.substr(sender.origin.size()), *body,
                         {{"webhook-id", id},
                          {"webhook-timestamp", std::to_string(timestamp)},
                          {"webhook-signature", webhook_signature(key_, id, timestamp, *body)}});
  if (stop.stop_requested() && !outcome.delivered()) {
    return true;  // aborted by stop: not counted
  }
  return settle(delivery, outcome);
}

bool Webhooks::settle(const Delivery& delivery, const PostOutcome& outcome) {
  DeliveryStore& deliveries = world_.store.deliveries();
  const auto attempts = static_cast<std::size_t>(delivery.attempts);
  if (outcome.delivered()) {
    ++world_.counters.delivered;
    note(delivery, LogLevel::info, "delivered", outcome);
    return deliveries.remove(delivery.number).ok();
  }
  ++world_.counters.failed;
  if (attempts >= world_.times.pauses.size()) {
    ++world_.counters.given_up;
    note(delivery, LogLevel::error, "given_up", outcome);
    return deliveries.remove(delivery.number).ok();
  }
  note(delivery, LogLevel::warning, "failed", outcome);
  return deliveries.postpone(delivery.number, world_.times.pauses[attempts], world_.environment.now()).ok();
}

void Webhooks::note(const Delivery& delivery, LogLevel level, std::string_view outcome,
                    const PostOutcome& post) {
  world_.log.write(level, "callback",
                   {{delivery.sweep ? "sweep" : "job", std::string_view(delivery.id)},
                    {"outcome", outcome},
                    {"attempt", static_cast<std::int64_t>(delivery.attempts + 1)},
                    {"status", static_cast<std::int64_t>(post.status)},
                    {"detail", std::string_view(post.trouble)}});
}

}  // namespace snapthrough::server
