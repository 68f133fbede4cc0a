#pragma once
/// @file
/// Resources of the interface: each translates a request to operations on jobs, and their outcome to a
/// response.

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/result_table.h"
#include "server/queue/job_service.h"
#include "server/resources/hops/catalogue.h"
#include "server/resources/message.h"
#include "server/resources/page.h"
#include "server/resources/prefer.h"

namespace snapthrough::server::http {

/// Limits of the time for which one request may wait for a result.
struct WaitLimits {
  std::chrono::seconds default_wait{10};  ///< longest wait of a POST without preference
  std::chrono::seconds longest_wait{60};  ///< upper limit of any preferred wait
};

/// Data of the resources about the service itself. Functions may be called from any thread.
struct ServiceFacts {
  std::function<std::string()> metrics;                ///< returns metrics in the text format of Prometheus
  std::function<std::string()> not_ready;              ///< returns why the service refuses work; "": ready
  std::vector<std::pair<std::string, double>> limits;  ///< limits by name with unit
  Page page;                                           ///< the web page; default: none
  std::string hops_folder;                             ///< folder of hops::Catalogue
};

/// @brief Answers every request, invalid ones with a problem. Thread-safe; never blocks for a job: responses
/// that wait are deferred.
class Routes {
 public:
  Routes(JobService& jobs, WaitLimits waits, ServiceFacts facts = {})
      : jobs_(jobs), waits_(waits), facts_(std::move(facts)), components_(facts_.hops_folder) {}

  /// Returns the response. Sets the owner of a request with the key of a job, see Request. Throws only for
  /// errors of the program or its environment (std::bad_alloc).
  [[nodiscard]] Response respond(Request& request);

  /// Returns the methods of the resource at a path, as a list; "" when there is none.
  [[nodiscard]] static std::string methods_at(std::string_view path);

  /// Returns method and path template of every resource, for comparison with the published document.
  [[nodiscard]] static std::vector<std::pair<std::string, std::string>> resources();

 private:
  struct Route;
  static const std::vector<Route>& table();

  // Defined in routes_jobs.cpp.
  Response create_job(const Request& request, const std::string& id);
  /// Submits a document as a job, according to the request's headers, and returns the response.
  Response submit_job(const Request& request, std::string_view document);
  Response list_jobs(const Request& request, const std::string& id);
  Response job_status(const Request& request, const std::string& id);
  Response job_result(const Request& request, const std::string& id);
  /// Answers with a table of the result as CSV, for programs that can only send an address: the query has
  /// defaults, and the response waits for a running job.
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

  // Defined in routes_keys.cpp.
  /// Gives the job a key that reads it and nothing else, and answers with it: only its digest is kept. An
  /// earlier key of the job ends.
  Response create_job_key(const Request& request, const std::string& id);
  /// Compares a request's key of a job with that of the job with an id, and sets the request's owner; returns
  /// the refusal of another key. Requests without a key of a job are left alone.
  std::optional<Response> admit_job_key(Request& request, const std::string& id);

  // Defined in routes_records.cpp.
  Response usage(const Request& request, const std::string& id);
  Response audit(const Request& request, const std::string& id);
  /// Adds what the owner has left of each quota when the response is complete.
  void tell_balance(const Request& request, Response& response);
  /// Returns 410 instead of a 404 for a job or sweep whose deletion is known; every other response as it is.
  Response told_of_deletion(const Request& request, const std::string& id, Response missing);

  // Defined in routes_sweeps.cpp.
  Response create_sweep(const Request& request, const std::string& id);
  Response list_sweeps(const Request& request, const std::string& id);
  Response sweep_status(const Request& request, const std::string& id);
  Response sweep_request(const Request& request, const std::string& id);
  Response sweep_table(const Request& request, const std::string& id);
  /// Answers with the rows as CSV, see job_csv().
  Response sweep_csv(const Request& request, const std::string& id);
  Response sweep_events(const Request& request, const std::string& id);
  Response point_request(const Request& request, const std::string& id, const std::string& point);
  Response create_point_job(const Request& request, const std::string& id, const std::string& point);
  Response dismiss_sweep(const Request& request, const std::string& id);
  Response retry_sweep(const Request& request, const std::string& id);
  Response delete_sweep(const Request& request, const std::string& id);
  /// Calls `answer` with the sweep if it exists and belongs to the owner; else returns a problem.
  Response with_sweep(const Request& request, const std::string& id,
                      const std::function<Response(const SweepRecord&)>& answer);
  /// Calls `answer` with the request document of a point; else returns a problem.
  Response with_point(const Request& request, const std::string& id, const std::string& point,
                      const std::function<Response(std::string)>& answer);
  Response status_of_sweep(const Request& request, const std::string& id, int status);

  // Defined in routes_hops.cpp.
  Response list_components(const Request& request, const std::string& id);
  Response describe_component(const Request& request, const std::string& name);
  /// Answers a call whose `pointer` names the component.
  Response solve(const Request& request, const std::string& id);
  /// Answers a call of the component with a name; for "solve", of the one in `pointer`.
  Response solve_component(const Request& request, const std::string& name);
  Response submit_call(const Request& request, const std::string& name,
                       const std::shared_ptr<const hops::Definition>& definition,
                       const std::string& document);
  /// Returns the outcome of a call's job as an answer to the call.
  Response answer_call(const Request& request, const std::string& name,
                       const std::shared_ptr<const hops::Definition>& definition, const std::string& id);

  // Defined in routes_tools.cpp.
  /// Answers with parts of a model as JSON, made from a soil document, tables or a drawing.
  Response convert(const Request& request, const std::string& id);
  /// Answers with a figure of a result, a model or the table of a sweep as SVG.
  Response plot(const Request& request, const std::string& id);

  // Defined in routes_service.cpp.
  Response check(const Request& request, const std::string& id);
  Response limits(const Request& request, const std::string& id);
  Response openapi(const Request& request, const std::string& id);
  Response examples(const Request& request, const std::string& id);
  Response alive(const Request& request, const std::string& id);
  Response ready(const Request& request, const std::string& id) const;
  Response metrics(const Request& request, const std::string& id) const;

  JobService& jobs_;
  WaitLimits waits_;
  ServiceFacts facts_;
  hops::Catalogue components_;
};

}  // namespace snapthrough::server::http
