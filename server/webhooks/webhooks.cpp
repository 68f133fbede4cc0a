#include "server/webhooks/webhooks.h"

#include <algorithm>
#include <csignal>
#include <mutex>
#include <optional>
#include <utility>

#include "server/bell.h"
#include "server/priority.h"
#include "server/resources/documents.h"
#include "server/webhooks/signature.h"

namespace snapthrough::server {
namespace {

constexpr std::chrono::milliseconds kBetweenCuts{20};
constexpr std::chrono::seconds kAfterStoreTrouble{5};
/// Deliveries that are sent to one origin at a time, and those of them that are one owner's.
constexpr std::size_t kOfOrigin = 4;
constexpr std::ptrdiff_t kOfOwner = 2;
/// Time of a delivery in seconds after which its thread serves another owner first.
constexpr double kSlow_s = 1.0;

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

/// An origin, and what its threads send.
struct Webhooks::Host {
  explicit Host(std::string to) : origin(std::move(to)) {}

  /// Notes that a delivery is under way.
  void begin(const Delivery& delivery) {
    const std::lock_guard guard(mutex);
    sent.push_back(delivery);
  }
  void end(const Delivery& delivery) {
    {
      const std::lock_guard guard(mutex);
      std::erase_if(sent, [&](const Delivery& one) { return one.number == delivery.number; });
    }
    ended.ring();
  }
  /// Returns what is under way, with the owners that have their part of the threads.
  [[nodiscard]] UnderWay under_way() {
    const std::lock_guard guard(mutex);
    UnderWay all;
    for (const Delivery& one : sent) {
      all.numbers.push_back(one.number);
      const auto is_of_owner = [&](const Delivery& other) { return other.owner == one.owner; };
      if (std::count_if(sent.begin(), sent.end(), is_of_owner) >= kOfOwner) {
        all.owners.push_back(one.owner);
      }
    }
    return all;
  }

  const std::string origin;
  std::mutex taking;  ///< held by the thread that waits for the next delivery
  Bell ended;         ///< a delivery is no longer under way
  std::mutex mutex;
  std::vector<Delivery> sent;
};

struct Webhooks::Sender {
  Sender(Host& its_host, std::chrono::milliseconds longest)
      : host(its_host), poster(its_host.origin, longest) {}

  Host& host;
  Poster poster;
  std::optional<std::string> slow_owner;  ///< owner of the last delivery, if that was slow
  std::jthread thread;
};

Webhooks::Webhooks(const WebhookSurroundings& surroundings, const std::vector<std::string>& origins,
                   std::string key)
    : world_(surroundings), key_(std::move(key)) {
  for (const std::string& origin : origins) {
    hosts_.push_back(std::make_unique<Host>(origin));
    for (std::size_t i = 0; i < kOfOrigin; ++i) {
      senders_.push_back(std::make_unique<Sender>(*hosts_.back(), world_.times.attempt));
    }
  }
  for (const std::unique_ptr<Sender>& sender : senders_) {
    sender->thread = std::jthread([this, &own = *sender](const std::stop_token& stop) {
      give_way_from_now_on();  // nobody waits for a delivery, and receivers decide what it takes
      send_due(own, stop);
    });
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
  while (const std::optional<Delivery> due = take(sender, stop)) {
    const double start = world_.environment.monotonic_seconds();
    if (!deliver(sender, *due, stop)) {
      pause(stop, kAfterStoreTrouble);  // a delivery that cannot be recorded would be repeated at once
    }
    const bool is_slow = world_.environment.monotonic_seconds() - start >= kSlow_s;
    sender.slow_owner = is_slow ? std::optional(due->owner) : std::nullopt;
    sender.host.end(*due);
  }
}

/// Waits for a delivery that is due and notes that it is under way; nullopt at a stop. Of an origin's threads
/// one at a time asks the store.
std::optional<Delivery> Webhooks::take(Sender& sender, const std::stop_token& stop) {
  const std::lock_guard taking(sender.host.taking);
  std::uint64_t seen = 0;
  while (!stop.stop_requested()) {
    StatusOr<std::optional<Delivery>> due = next(sender);
    if (due.ok() && *due) {
      sender.host.begin(**due);
      return *std::move(due);
    }
    if (!due.ok()) {
      log_store_trouble(world_.log, due.status());
    }
    sender.host.ended.wait(seen, stop, world_.times.poll);
  }
  return std::nullopt;
}

StatusOr<std::optional<Delivery>> Webhooks::next(Sender& sender) {
  DeliveryStore& store = world_.store.deliveries();
  const std::chrono::milliseconds hold = 2 * world_.times.attempt;
  const UnderWay under_way = sender.host.under_way();
  if (sender.slow_owner) {
    UnderWay others = under_way;
    others.owners.push_back(*sender.slow_owner);
    StatusOr<std::optional<Delivery>> due =
        store.next(sender.host.origin, others, hold, world_.environment.now());
    if (!due.ok() || *due) {
      return due;
    }
  }
  return store.next(sender.host.origin, under_way, hold, world_.environment.now());
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
      sender.poster.post(delivery.address.substr(sender.host.origin.size()), *body,
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
