#pragma once
/// @file
/// The resources of the interface: each translates a request to verbs on jobs, and their outcome to a
/// response.

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/result_table.h"
#include "server/queue/job_service.h"
#include "server/resources/documents.h"
#include "server/resources/hops/catalogue.h"
#include "server/resources/message.h"
#include "server/resources/page.h"
#include "server/resources/prefer.h"

namespace snapthrough::server::http {

/// How long a client may wait for a result in one request.
struct WaitLimits {
  std::chrono::seconds default_wait{10};  ///< POST without preference
  std::chrono::seconds longest_wait{60};  ///< whatever is preferred
};

/// What the resources about the service itself tell. Functions may be called from any thread.
struct ServiceFacts {
  std::function<std::string()> metrics;                ///< text format of Prometheus
  std::function<std::string()> not_ready;              ///< why no work should be sent here; empty: it should
  std::vector<std::pair<std::string, double>> limits;  ///< name with unit, value
  Page page;                                           ///< what people look at; by default none
  std::string hops_folder;                             ///< see hops::Catalogue
};

/// @brief Answers every request, wrong ones with a problem. Thread-safe; never waits for a job: a response
/// that has to is deferred.
class Routes {
 public:
  Routes(JobService& jobs, WaitLimits waits, ServiceFacts facts = {})
      : jobs_(jobs), waits_(waits), facts_(std::move(facts)), components_(facts_.hops_folder) {}

  /// Throws only for what is nobody's fault but the program's (std::bad_alloc, a defect).
  [[nodiscard]] Response respond(const Request& request);

  /// Methods of the resource at a path, as a list; empty when there is none.
  [[nodiscard]] static std::string methods_at(std::string_view path);

  /// Method and path template of every resource, for tests against the published document.
  [[nodiscard]] static std::vector<std::pair<std::string, std::string>> resources();

 private:
  struct Route;
  static const std::vector<Route>& table();

  // routes_jobs.cpp
  Response create_job(const Request& request, const std::string& id);
  /// Hands a document in as a job, as the request's headers want it, and answers with what comes of it.
  Response submit_job(const Request& request, std::string_view document);
  Response list_jobs(const Request& request, const std::string& id);
  Response job_status(const Request& request, const std::string& id);
  Response job_result(const Request& request, const std::string& id);
  /// A table of the result as CSV, for programs that can send an address and nothing else: what the query
  /// does not say is decided here, and a job that still runs is waited for.
  Response job_csv(const Request& request, const std::string& id);
  Response job_request(const Request& request, const std::string& id);
  Response job_events(const Request& request, const std::string& id);
  Response dismiss_job(const Request& request, const std::string& id);
  Response delete_job(const Request& request, const std::string& id);
  [[nodiscard]] std::chrono::seconds wait_of(const Preferences& preferences) const;
  Response when_ended(const Request& request, const std::string& id, std::chrono::seconds wait,
                      std::function<Response()> answer);
  Response created(const Request& request, const Submission& submission);
  Response answer_of_post(const Request& request, const std::string& id, Submission::Kind kind);
  Response status_of_job(const Request& request, const std::string& id);
  Response result_of(const Request& request, const Job& job);
  Response table_of_result(const Request& request, const Job& job, api::ResultTable table);

  // routes_sweeps.cpp
  Response create_sweep(const Request& request, const std::string& id);
  Response list_sweeps(const Request& request, const std::string& id);
  Response sweep_status(const Request& request, const std::string& id);
  Response sweep_request(const Request& request, const std::string& id);
  Response sweep_table(const Request& request, const std::string& id);
  /// The rows as CSV, see job_csv().
  Response sweep_csv(const Request& request, const std::string& id);
  Response sweep_events(const Request& request, const std::string& id);
  Response point_request(const Request& request, const std::string& id, const std::string& point);
  Response create_point_job(const Request& request, const std::string& id, const std::string& point);
  Response dismiss_sweep(const Request& request, const std::string& id);
  Response retry_sweep(const Request& request, const std::string& id);
  Response delete_sweep(const Request& request, const std::string& id);
  /// Calls `answer` with the sweep if there is one and it is the owner's, else answers itself.
  Response with_sweep(const Request& request, const std::string& id,
                      const std::function<Response(const SweepRecord&)>& answer);
  /// Calls `answer` with the request document of a point of it, as with_sweep() does.
  Response with_point(const Request& request, const std::string& id, const std::string& point,
                      const std::function<Response(std::string)>& answer);
  Response status_of_sweep(const Request& request, const std::string& id, int status);

  // routes_hops.cpp
  Response list_components(const Request& request, const std::string& id);
  Response describe_component(const Request& request, const std::string& name);
  /// A call that names its component in `pointer`.
  Response solve(const Request& request, const std::string& id);
  /// A call of the component of that name; of the one in `pointer` when the name is "solve".
  Response solve_component(const Request& request, const std::string& name);
  Response submit_call(const Request& request, const std::string& name,
                       const std::shared_ptr<const hops::Definition>& definition,
                       const std::string& document);
  /// What has become of the job of a call, as an answer to it.
  Response answer_call(const Request& request, const std::string& name,
                       const std::shared_ptr<const hops::Definition>& definition, const std::string& id);

  // routes_service.cpp
  Response check(const Request& request, const std::string& id);
  Response limits(const Request& request, const std::string& id);
  Response openapi(const Request& request, const std::string& id);
  Response examples(const Request& request, const std::string& id);
  Response alive(const Request& request, const std::string& id);
  Response ready(const Request& request, const std::string& id);
  Response metrics(const Request& request, const std::string& id);

  JobService& jobs_;
  WaitLimits waits_;
  ServiceFacts facts_;
  hops::Catalogue components_;
};

// What several resources answer with.
[[nodiscard]] Response json_response(int status, std::string body);
[[nodiscard]] Response simple_problem(const Request& request, int status, const char* kind, const char* title,
                                      std::string detail);
[[nodiscard]] Response store_trouble(const Request& request, const Status& status);
[[nodiscard]] Response job_missing(const Request& request, const std::string& id);
/// Whether a Content-Type names JSON.
[[nodiscard]] bool is_json(std::string_view content_type);

}  // namespace snapthrough::server::http
