#pragma once
/// @file
/// The resources of the interface: each translates a request to verbs on jobs, and their outcome to a
/// response.

#include <chrono>

#include "server/http/documents.h"
#include "server/http/message.h"
#include "server/jobs/desk.h"

namespace snapthrough::server::http {

/// How long a client may wait for a result in one request.
struct WaitLimits {
  std::chrono::seconds default_wait{10};  ///< POST without preference
  std::chrono::seconds longest_wait{60};  ///< whatever is preferred
};

/// @brief Answers every request, wrong ones with a problem. Thread-safe; may wait as long as the limits
/// allow.
class Routes {
 public:
  Routes(JobDesk& desk, WaitLimits limits) : desk_(desk), limits_(limits) {}

  /// Throws only for what is nobody's fault but the program's (std::bad_alloc, a defect).
  [[nodiscard]] Response respond(const Request& request);

 private:
  struct Route;
  static const std::vector<Route>& table();

  Response create_job(const Request& request, const std::string& id);
  Response list_jobs(const Request& request, const std::string& id);
  Response job_status(const Request& request, const std::string& id);
  Response job_result(const Request& request, const std::string& id);
  Response job_request(const Request& request, const std::string& id);
  Response alive(const Request& request, const std::string& id);

  Response created(const Request& request, const Submission& submission);
  Response result_of(const Request& request, const Job& job);
  Response job_missing(const Request& request, const std::string& id) const;

  JobDesk& desk_;
  WaitLimits limits_;
};

}  // namespace snapthrough::server::http
