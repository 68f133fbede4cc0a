#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "server/resources/documents.h"
#include "server/resources/events.h"

namespace snapthrough::server::http {
namespace {

// Id of a progress event: number of computed points plus one; the id of the end exceeds all of them.
static_assert(api::kMaxSweepPoints < kEndOfSweep);

std::string progress_data(const SweepRecord& sweep) {
  nlohmann::ordered_json data{{"points", sweep.points}};
  data.update(sweep_counts(sweep));
  return data.dump();
}

/// A client that follows a sweep.
class FollowingSweep final : public Following {
 public:
  FollowingSweep(JobService& jobs, std::string id, std::uint64_t last_id, Stream::Push push)
      : Following(jobs, std::move(id), last_id < kEndOfSweep ? last_id : 0, std::move(push)) {}

  void begin() {
    const StatusOr<std::optional<SweepRecord>> sweep = jobs_.sweeps().store().get(id_);
    if (!sweep.ok() || !sweep->has_value() || is_final((*sweep)->state)) {
      return end_at_once();
    }
    send_status(number_of(**sweep), sweep_status_document(**sweep));
    follower_.emplace(jobs_.sweeps().work().news(), id_, [this](const SweepRecord& news) {
      send_progress(number_of(news), progress_data(news));
    });
    listen_for_end();
  }

 private:
  static std::uint64_t number_of(const SweepRecord& sweep) {
    return static_cast<std::uint64_t>(sweep.done()) + 1;
  }

  [[nodiscard]] std::string ending() override {
    const StatusOr<std::optional<SweepRecord>> sweep = jobs_.sweeps().store().get(id_);
    const bool ended = sweep.ok() && sweep->has_value() && is_final((*sweep)->state);
    return ended ? event_text(kEndOfSweep, "end", sweep_status_document(**sweep)) : "";
  }

  std::optional<ProgressTopic<SweepRecord>::Follower> follower_;
};

}  // namespace

std::shared_ptr<StreamSource> follow_sweep(JobService& jobs, const std::string& id, std::uint64_t last_id,
                                           Stream::Push push) {
  auto following = std::make_shared<FollowingSweep>(jobs, id, last_id, std::move(push));
  following->begin();
  return following;
}

}  // namespace snapthrough::server::http
