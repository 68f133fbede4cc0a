#include <atomic>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "server/http/documents.h"
#include "server/http/events.h"

namespace snapthrough::server::http {
namespace {

constexpr double kLeastPause = 0.05;
// Events of progress are numbered by the points that are done; that of the end comes after all of them.
constexpr std::uint64_t kEnd = 1'000'000'000'000;

std::string event_text(std::uint64_t id, const char* kind, const std::string& data) {
  return "id: " + std::to_string(id) + "\nevent: " + kind + "\ndata: " + data + "\n\n";
}

std::string progress_data(const SweepRecord& sweep) {
  return nlohmann::ordered_json{{"points", sweep.points},
                                {"successful", sweep.successful},
                                {"failed", sweep.failed},
                                {"reused", sweep.reused},
                                {"remaining", sweep.points - sweep.done()}}
      .dump();
}

/// One client that follows one sweep. Events come from the workers' threads.
class FollowingSweep final : public StreamSource {
 public:
  FollowingSweep(JobDesk& desk, std::string id, std::uint64_t last_id, Stream::Push push)
      : desk_(desk),
        id_(std::move(id)),
        last_(last_id < kEnd ? last_id : 0),
        push_(std::move(push)),
        ticket_(desk.ends(), id_) {}

  void begin() {
    const StatusOr<std::optional<SweepRecord>> sweep = desk_.sweeps().store().get(id_);
    const bool there = sweep.ok() && sweep->has_value();
    if (!there || is_final((*sweep)->state)) {
      *ended_ = true;  // poll() does the rest
      return;
    }
    push_("retry: 1000\n\n" + event_text(number_of(**sweep), "status", sweep_status_document(**sweep)),
          false);
    follower_.emplace(desk_.sweeps().news(), id_, [this](const SweepRecord& news) { on_progress(news); });
    // The announcing thread holds locks: it only leaves a mark, and poll() asks the store.
    ticket_.on_end([ended = ended_, push = push_] {
      *ended = true;
      push("", false);
    });
  }

  void poll() override {
    if (*ended_ && !finished_) {
      finish();
    }
  }

 private:
  static std::uint64_t number_of(const SweepRecord& sweep) {
    return static_cast<std::uint64_t>(sweep.done()) + 1;
  }

  void on_progress(const SweepRecord& news) {
    const double now = desk_.environment().monotonic_seconds();
    const std::uint64_t number = number_of(news);
    if (number <= last_ || now < next_) {
      return;
    }
    next_ = now + kLeastPause;
    last_ = number;
    push_(event_text(number, "progress", progress_data(news)), false);
  }

  /// What is known of a sweep that has ended; of one that has not (the service stops) nothing.
  void finish() {
    finished_ = true;
    const StatusOr<std::optional<SweepRecord>> sweep = desk_.sweeps().store().get(id_);
    std::string text;
    if (sweep.ok() && sweep->has_value() && is_final((*sweep)->state)) {
      text = event_text(kEnd, "end", sweep_status_document(**sweep));
    }
    push_(text, true);
  }

  JobDesk& desk_;
  const std::string id_;
  std::uint64_t last_;  ///< used by the board's callbacks only, which come one at a time
  double next_ = 0.0;
  std::shared_ptr<std::atomic<bool>> ended_ = std::make_shared<std::atomic<bool>>(false);
  bool finished_ = false;
  Stream::Push push_;
  JobEnds::Ticket ticket_;
  std::optional<NewsBoard<SweepRecord>::Follower> follower_;
};

}  // namespace

std::shared_ptr<StreamSource> follow_sweep(JobDesk& desk, const std::string& id, std::uint64_t last_id,
                                           Stream::Push push) {
  auto following = std::make_shared<FollowingSweep>(desk, id, last_id, std::move(push));
  following->begin();
  return following;
}

}  // namespace snapthrough::server::http
