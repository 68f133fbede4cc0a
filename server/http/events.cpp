#include "server/http/events.h"

#include <atomic>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "server/http/documents.h"

namespace snapthrough::server::http {
namespace {

using nlohmann::ordered_json;

constexpr double kLeastPause = 0.05;
// Events of a running job are numbered attempt by attempt; those of its end come after all of them.
constexpr std::uint64_t kAttempt = 1'000'000'000'000;
constexpr std::uint64_t kEndings = 1'000'000 * kAttempt;

std::string event_text(std::uint64_t id, const char* kind, const std::string& data) {
  return "id: " + std::to_string(id) + "\nevent: " + kind + "\ndata: " + data + "\n\n";
}

const char* type_name(CriticalType type) {
  switch (type) {
    case CriticalType::bifurcation:
      return "bifurcation";
    case CriticalType::limit_max:
      return "limit_max";
    case CriticalType::limit_min:
      return "limit_min";
  }
  return "";
}

std::string progress_data(const Progress& progress) {
  return ordered_json{{"branch", progress.branch},
                      {"step", progress.step},
                      {"load_factor", progress.load_factor},
                      {"negative_eigenvalues", progress.negative_eigenvalues}}
      .dump();
}

std::string critical_data(const CriticalPoint& point) {
  ordered_json data{{"branch", point.branch},
                    {"type", type_name(point.type)},
                    {"load_factor", point.load_factor},
                    {"arc_length", point.arc_length},
                    {"negative_before", point.negative_before},
                    {"negative_after", point.negative_after}};
  data["error_estimate"] = point.error_estimate ? ordered_json(*point.error_estimate) : ordered_json(nullptr);
  return data.dump();
}

/// One client that follows one job. Events come from the worker's and the store's threads.
class Following final : public StreamSource {
 public:
  Following(JobDesk& desk, std::string id, std::uint64_t last_id, Stream::Push push)
      : desk_(desk), id_(std::move(id)), last_(last_id), push_(std::move(push)), ticket_(desk.ends(), id_) {}

  void begin() {
    const StatusOr<std::optional<Job>> job = desk_.store().get(id_);
    const bool there = job.ok() && job->has_value();
    attempt_ = there ? static_cast<std::uint64_t>((*job)->attempt) : 0;
    if (!there || is_final((*job)->state)) {
      *ended_ = true;  // poll() does the rest
      return;
    }
    push_("retry: 1000\n\n" +
              event_text(attempt_ * kAttempt, "status", job_status_document(**job, desk_.progress(id_))),
          false);
    follower_.emplace(desk_.progress_board(), id_,
                      [this](const Progress& progress) { on_progress(progress); });
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
  void on_progress(const Progress& progress) {
    const double now = desk_.environment().monotonic_seconds();
    const std::uint64_t number = attempt_ * kAttempt + static_cast<std::uint64_t>(progress.step) + 1;
    if (number <= last_ || now < next_) {
      return;
    }
    next_ = now + kLeastPause;
    last_ = number;
    push_(event_text(number, "progress", progress_data(progress)), false);
  }

  /// What is known of a job that has ended; of one that has not (the service stops) nothing.
  void finish() {
    finished_ = true;
    const StatusOr<std::optional<Job>> job = desk_.store().get(id_);
    std::string text;
    if (job.ok() && job->has_value() && is_final((*job)->state)) {
      const StatusOr<StoredPath> path = desk_.store().path(id_);
      std::uint64_t number = kEndings;
      for (const CriticalPoint& point : path.ok() ? path->critical_points : std::vector<CriticalPoint>()) {
        if (++number > last_) {
          text += event_text(number, "critical_point", critical_data(point));
        }
      }
      text += event_text(2 * kEndings, "end", job_status_document(**job, std::nullopt));
    }
    push_(text, true);
  }

  JobDesk& desk_;
  const std::string id_;
  std::uint64_t attempt_ = 0;
  std::atomic<std::uint64_t> last_;
  std::shared_ptr<std::atomic<bool>> ended_ = std::make_shared<std::atomic<bool>>(false);
  bool finished_ = false;
  double next_ = 0.0;
  Stream::Push push_;
  JobEnds::Ticket ticket_;
  std::optional<ProgressBoard::Follower> follower_;
};

}  // namespace

std::shared_ptr<StreamSource> follow_job(JobDesk& desk, const std::string& id, std::uint64_t last_id,
                                         Stream::Push push) {
  auto following = std::make_shared<Following>(desk, id, last_id, std::move(push));
  following->begin();
  return following;
}

}  // namespace snapthrough::server::http
