#include "server/resources/events.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "api/names.h"
#include "server/resources/documents.h"

namespace snapthrough::server::http {
namespace {

using nlohmann::ordered_json;

/// Least pause between two progress events, in seconds.
constexpr double kLeastPause = 0.05;

// Ids of a running job's events: attempt * kAttempt + number; ids of the end's events exceed all of them.
constexpr std::uint64_t kAttempt = 1'000'000'000'000;
constexpr std::uint64_t kEndings = 1'000'000 * kAttempt;
static_assert(kEndings < kEndOfJob);

std::string progress_data(const Progress& progress) {
  return ordered_json{{"branch", progress.branch},
                      {"step", progress.step},
                      {"load_factor", progress.load_factor},
                      {"negative_eigenvalues", progress.negative_eigenvalues}}
      .dump();
}

/// @param last true: the point is from the result; false: from the mesh of the running path
std::string critical_data(const CriticalPoint& point, bool last) {
  ordered_json data{{"branch", point.branch},
                    {"type", api::name_of(api::kCriticalTypes, point.type)},
                    {"load_factor", point.load_factor},
                    {"arc_length", point.arc_length},
                    {"negative_before", point.negative_before},
                    {"negative_after", point.negative_after}};
  data["error_estimate"] = point.error_estimate ? ordered_json(*point.error_estimate) : ordered_json(nullptr);
  data["final"] = last;
  return data.dump();
}

/// A client that follows a job.
class FollowingJob final : public Following {
 public:
  using Following::Following;

  void begin() {
    const StatusOr<std::optional<Job>> job = jobs_.store().get(id_);
    if (!job.ok() || !job->has_value() || is_final((*job)->state)) {
      return end_at_once();
    }
    send_status(static_cast<std::uint64_t>((*job)->attempt) * kAttempt,
                job_status_document(**job, jobs_.progress(**job)));
    follower_.emplace(jobs_.context().progress, id_, [this](const JobNews& news) { on_news(news); });
    listen_for_end();
  }

 private:
  /// Returns the first item that the client has not received; items are sorted by number.
  template <class List>
  [[nodiscard]] auto first_lacking(const List& told, std::uint64_t base) const {
    return std::partition_point(told.begin(), told.end(),
                                [&](const auto& one) { return !lacks(base + one.number); });
  }

  void on_news(const JobNews& news) {
    const std::uint64_t base = static_cast<std::uint64_t>(news.attempt) * kAttempt;
    auto found = first_lacking(news.found, base);
    auto traced = first_lacking(news.traced, base);
    while (found != news.found.end() || traced != news.traced.end()) {
      const bool critical =
          traced == news.traced.end() || (found != news.found.end() && found->number < traced->number);
      if (critical) {
        send(base + found->number, "critical_point", critical_data(found->point, false));
        ++found;
      } else {
        send(base + traced->number, "points", traced->document);
        ++traced;
      }
    }
    if (news.progress) {
      send_progress(base + news.number, progress_data(*news.progress));
    }
  }

  [[nodiscard]] std::string ending() override {
    const StatusOr<std::optional<Job>> job = jobs_.store().get(id_);
    if (!job.ok() || !job->has_value() || !is_final((*job)->state)) {
      return "";
    }
    const StatusOr<StoredPath> path = jobs_.store().path(id_);
    std::string text;
    std::uint64_t number = kEndings;
    for (const CriticalPoint& point : path.ok() ? path->critical_points : std::vector<CriticalPoint>()) {
      if (lacks(++number)) {
        text += event_text(number, "critical_point", critical_data(point, true));
      }
    }
    return text + event_text(kEndOfJob, "end", job_status_document(**job, std::nullopt));
  }

  std::optional<JobProgress::Follower> follower_;
};

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

std::shared_ptr<StreamSource> follow_job(JobService& jobs, const std::string& id, std::uint64_t last_id,
                                         Stream::Push push) {
  auto following = std::make_shared<FollowingJob>(jobs, id, last_id, std::move(push));
  following->begin();
  return following;
}

}  // namespace snapthrough::server::http
