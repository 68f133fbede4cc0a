#include "server/jobs/desk.h"

#include <utility>

#include "api/api.h"

namespace snapthrough::server {
namespace {

std::string_view analysis_name(AnalysisType type) {
  switch (type) {
    case AnalysisType::buckling:
      return "buckling";
    case AnalysisType::critical:
      return "critical";
    case AnalysisType::path:
      return "path";
    case AnalysisType::static_:
      return "static";
  }
  return "";
}

}  // namespace

void ProgressBoard::set(const std::string& id, const Progress& progress) {
  const std::lock_guard guard(mutex_);
  latest_[id] = progress;
}

void ProgressBoard::erase(const std::string& id) {
  const std::lock_guard guard(mutex_);
  latest_.erase(id);
}

std::optional<Progress> ProgressBoard::get(const std::string& id) const {
  const std::lock_guard guard(mutex_);
  const auto found = latest_.find(id);
  return found == latest_.end() ? std::nullopt : std::optional(found->second);
}

JobDesk::JobDesk(Store& store, const Environment& environment, Log& log)
    : store_(store), environment_(environment), log_(log) {}

StatusOr<Submission> JobDesk::submit(std::string_view document, std::string_view request_id) {
  api::ReadOutcome read = api::read_request(document);
  if (read.malformed || !read.findings.empty() || !read.request) {
    return Submission{read.malformed, std::move(read.findings), ""};
  }
  NewJob job;
  job.id = new_id(environment_);
  job.title = read.request->model.title;
  job.analysis_type = analysis_name(read.request->analysis.type);
  job.document = document;
  job.created = environment_.now();
  if (Status status = store_.submit(job); !status.ok()) {
    return status;
  }
  log_.write(LogLevel::info, "job",
             {{"job", std::string_view(job.id)},
              {"status", to_string(JobState::accepted)},
              {"analysis", std::string_view(job.analysis_type)},
              {"request_id", request_id}});
  bell_.ring();
  return Submission{false, {}, std::move(job.id)};
}

StatusOr<std::optional<Job>> JobDesk::get(const std::string& id, std::chrono::duration<double> wait) {
  JobEnds::Ticket ticket(ends_, id);
  StatusOr<std::optional<Job>> job = store_.get(id);
  const bool unfinished = job.ok() && job->has_value() && !is_final((*job)->state);
  if (!unfinished || wait.count() <= 0) {
    return job;
  }
  ticket.wait_for(wait);
  return store_.get(id);
}

}  // namespace snapthrough::server
