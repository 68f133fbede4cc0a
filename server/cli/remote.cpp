#include "server/cli/remote.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <random>
#include <utility>

#include "api/json_text.h"
#include "api/sweep.h"
#include "server/cli/input.h"
#include "server/cli/interruption.h"
#include "server/cli/remote_output.h"
#include "server/cli/remote_service.h"
#include "server/cli/shown.h"
#include "server/jobs/state.h"

namespace snapthrough::server::cli {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

// Seconds that the service may delay its answer until the job ends; shorter if progress is shown.
constexpr int kPatientWait_s = 30;
constexpr int kShownWait_s = 1;

/// Returns the last part of a problem's type, which names its kind.
std::string kind_of(const json& problem) {
  const std::string type = problem.is_object() ? problem.value("type", "") : "";
  return type.substr(type.rfind(':') + 1);
}

json document_of(const Answer& answer) {
  const json document = json::parse(answer.body, nullptr, false);
  return document.is_discarded() ? json() : document;
}

/// Reports an answer other than the expected one on `err`; returns the exit status. `prefix` is removed from
/// the pointers of findings, so that they refer to the document without its envelope.
int tell_problem(const Answer& answer, const RemoteService& service, const Streams& streams,
                 const std::string& prefix = "") {
  const json problem = document_of(answer);
  if (answer.status == 0) {
    streams.err << "snapthrough: no answer from " << service.address_of("") << ": " << answer.trouble << '\n';
    return kOther;
  }
  if (!problem.is_object() || !problem.contains("detail")) {
    streams.err << "snapthrough: " << service.address_of("") << " answered HTTP status " << answer.status
                << ", and no document of snapthrough\n";
    return kOther;
  }
  std::vector<Finding> findings;
  for (const json& error : problem.value("errors", json::array())) {
    std::string pointer = error.value("pointer", "");
    pointer.erase(0, pointer.starts_with(prefix) ? prefix.size() : 0);
    findings.push_back({pointer, error.value("code", ""), error.value("detail", "")});
  }
  print_findings(findings, streams);
  if (!findings.empty()) {
    return kWrongRequest;
  }
  streams.err << "snapthrough: " << problem.value("detail", "") << " [" << kind_of(problem)
              << ", HTTP status " << answer.status << ", request "
              << problem.value("request_id", "without id") << "]\n";
  if (answer.status == 401) {
    streams.err << "snapthrough: --key-file names the file with your key\n";
  }
  return kOther;
}

/// Returns the first line of a file; nullopt after a message on `err` when it is unreadable or empty.
std::optional<std::string> read_key(const std::string& path, const Streams& streams) {
  std::ifstream file(path);
  struct stat info {};
  if (::stat(path.c_str(), &info) == 0 && (info.st_mode & (S_IRGRP | S_IROTH)) != 0) {
    streams.err << "snapthrough: others can read the key in " << path << "; `chmod 600` keeps it to you\n";
  }
  std::string line;
  std::getline(file, line);
  line.erase(line.find_last_not_of(" \t\r") + 1);
  if (line.empty()) {
    streams.err << "snapthrough: there is no key in " << path << '\n';
    return std::nullopt;
  }
  return line;
}

/// Returns the service that the options name; nullopt after a message on `err` for invalid options.
std::optional<RemoteService> open_service(const ServiceOptions& options, const Interruption& interruption,
                                          const Streams& streams) {
  const auto address = parse_service_address(options.url);
  if (!address) {
    streams.err << "snapthrough: --service is to be like http://127.0.0.1:8080 or https://host/path, got "
                << options.url << '\n';
    return std::nullopt;
  }
  std::string key;
  if (!options.key_file.empty()) {
    const auto line = read_key(options.key_file, streams);
    if (!line) {
      return std::nullopt;
    }
    key = *line;
  }
  return std::optional<RemoteService>(
      std::in_place,
      RemoteAccess{*address, key, options.certificates, std::chrono::seconds(options.patience_s)},
      interruption.token(), [&streams](const std::string& why, std::chrono::seconds pause) {
        streams.err << "snapthrough: " << why << "; trying again in " << pause.count() << " s\n";
      });
}

/// Returns 128 random bits as 32 hexadecimal digits.
std::string random_key() {
  std::random_device random;
  std::string key;
  for (int i = 0; i < 4; ++i) {
    std::array<char, 9> digits{};
    std::snprintf(digits.data(), digits.size(), "%08x", static_cast<unsigned>(random()));
    key += digits.data();
  }
  return key;
}

/// A document to submit.
struct Submission {
  std::string path;
  std::string body;
  std::string prefix;  ///< pointer to the document in its envelope; "": no envelope
};

/// Puts the document into an envelope if it gets a label; nullopt and an exit status in `status` if invalid.
std::optional<Submission> prepare(const std::string& text, const std::string& label, const Streams& streams,
                                  int& status) {
  const api::ParsedText parsed = api::parse_json(text);
  if (parsed.document == nullptr) {
    print_findings(parsed.findings, streams);
    status = kWrongRequest;
    return std::nullopt;
  }
  const json& document = *parsed.document;
  const bool has_envelope =
      document.is_object() && (document.contains("request") || document.contains("sweep"));
  const bool is_sweep = has_envelope ? document.contains("sweep") : api::is_sweep(document);
  Submission submission{is_sweep ? "/v1/sweeps" : "/v1/jobs", text, ""};
  if (label.empty()) {
    return submission;
  }
  if (has_envelope) {
    streams.err << "snapthrough: the document has an envelope; write the label there, without --label\n";
    status = kOther;
    return std::nullopt;
  }
  const std::string member = is_sweep ? "sweep" : "request";
  submission.prefix = "/" + member;
  submission.body = "{\"label\": " + json(label).dump(-1, ' ', false, json::error_handler_t::replace) +
                    ", \"" + member + "\": " + text + "}";
  return submission;
}

/// Path and status document of a job or sweep.
struct Found {
  std::string path;  ///< path "/v1/jobs/ID" or "/v1/sweeps/ID"
  json status;
  bool is_sweep = false;
};

/// Returns whether a text has the characters of ids, so that it can be part of a path.
bool is_id(const std::string& text) {
  return !text.empty() && text.size() <= 64 &&
         text.find_first_not_of("0123456789abcdefABCDEF-") == std::string::npos;
}

/// Returns the job or sweep with an id; nullopt after a message on `err`.
std::optional<Found> find(const std::string& id, RemoteService& service, const Streams& streams) {
  if (!is_id(id)) {
    streams.err << "snapthrough: " << id << " is no id: submit writes one, hexadecimal digits with dashes\n";
    return std::nullopt;
  }
  for (const bool is_sweep : {false, true}) {
    const std::string path = (is_sweep ? "/v1/sweeps/" : "/v1/jobs/") + id;
    const Answer answer = service.get(path);
    const json document = document_of(answer);
    if (answer.status == 200 && document.is_object() && document.value("id", "") == id) {
      return Found{path, document, is_sweep};
    }
    const bool goes_on = answer.status == 404 && kind_of(document) == "no-such-job";
    if (!goes_on || is_sweep) {
      tell_problem(answer, service, streams);
      return std::nullopt;
    }
  }
  return std::nullopt;
}

bool has_ended(const json& status) {
  const std::optional<JobState> state = job_state_from(status.value("status", ""));
  return !state || is_final(*state);
}

/// Reports on `err` why a job or sweep was not successful; returns the exit status. @pre it has ended
int tell_end(const Found& found, const Streams& streams) {
  const std::string word = found.status.value("status", "");
  if (word == "successful") {
    return kDone;
  }
  if (word == "dismissed") {
    streams.err << "The " << (found.is_sweep ? "sweep" : "job") << " was dismissed\n";
  } else if (found.is_sweep) {
    const json counts = found.status.value("counts", json::object());
    streams.err << counts.value("failed", 0) << " of " << found.status.value("points", 0)
                << " points could not be completed; the column error says why\n";
  } else {
    const json error = found.status.value("error", json::object());
    streams.err << "The analysis could not be completed: " << error.value("detail", "") << " ["
                << error.value("code", "") << "]\n";
  }
  return kNotCompleted;
}

/// Returns how many seconds the next request may wait; 0 after the timeout.
int next_wait_s(const WaitOptions& options, Clock::time_point start) {
  const int longest = options.show_progress ? kShownWait_s : kPatientWait_s;
  if (!options.timeout_s) {
    return longest;
  }
  const double left = *options.timeout_s - std::chrono::duration<double>(Clock::now() - start).count();
  return left <= 0.0 ? 0 : static_cast<int>(std::ceil(std::min(left, static_cast<double>(longest))));
}

/// Polls until the job or sweep ends or the timeout is over. @return kDone, or the status of a failed request
int follow(Found& found, RemoteService& service, const WaitOptions& options, const Streams& streams) {
  const Clock::time_point start = Clock::now();
  while (!has_ended(found.status)) {
    if (options.show_progress) {
      streams.err << line_start << found.status.value("message", "") << line_end << std::flush;
    }
    const int wait_s = next_wait_s(options, start);
    if (wait_s == 0) {
      break;
    }
    const Answer answer = service.get(found.path, {{"Prefer", "wait=" + std::to_string(wait_s)}},
                                      {std::chrono::seconds(wait_s)});
    if (answer.status != 200) {
      return tell_problem(answer, service, streams);
    }
    found.status = document_of(answer);
  }
  if (options.show_progress) {
    streams.err << line_start << line_end << std::flush;
  }
  return kDone;
}

/// Completes an output. @return `status`, or kOther when writing fails
int keep(Output& output, const FetchOptions& options, const Streams& streams, int status) {
  if (!output.keep()) {
    streams.err << "snapthrough: cannot write "
                << (options.output.empty() ? "to standard output" : options.output) << '\n';
    return kOther;
  }
  return status;
}

/// Writes a text to its destination. @return as keep()
int write_whole(std::string_view text, const FetchOptions& options, const Streams& streams, int status) {
  Output output(options.output, streams.out);
  output.write(text);
  return keep(output, options, streams, status);
}

/// Prints the warnings of a result as solve_command() does.
void print_warnings(const json& warnings, const Streams& streams) {
  for (const json& warning : warnings.is_array() ? warnings : json::array()) {
    streams.err << "Warning: " << warning.value("detail", "") << " [" << warning.value("code", "") << "]\n";
  }
}

/// Writes the result that a failed job reached.
int fetch_reached(const Found& found, const Answer& answer, const FetchOptions& options,
                  const Streams& streams) {
  const json reached = document_of(answer).value("reached", json());
  const int status = tell_end(found, streams);
  if (reached.is_null()) {
    return status;
  }
  print_warnings(reached.value("warnings", json()), streams);
  if (options.csv) {
    streams.err << "snapthrough: without --csv what was reached is written\n";
    return status;
  }
  return write_whole(reached.dump(2) + "\n", options, streams, status);
}

int fetch_result(const Found& found, RemoteService& service, const FetchOptions& options,
                 const Streams& streams) {
  Output result(options.csv ? "" : options.output, streams.out);
  const Answer answer = service.get(found.path + "/result", {{"Accept", "application/json"}},
                                    {std::chrono::seconds{0}, kMostKept, &result});
  if (answer.status != 200 && kind_of(document_of(answer)) == "analysis-failed") {
    return fetch_reached(found, answer, options, streams);
  }
  if (answer.status != 200) {
    return tell_problem(answer, service, streams);
  }
  print_warnings(result.member("warnings"), streams);
  if (!options.csv) {
    return keep(result, options, streams, kDone);
  }
  Output output(options.output, streams.out);
  const Answer table = service.get(
      found.path + "/result?format=csv" + (options.table.empty() ? "" : "&table=" + options.table), {},
      {std::chrono::seconds{0}, kMostOfDocument, &output});
  return table.status == 200 ? keep(output, options, streams, kDone) : tell_problem(table, service, streams);
}

/// Appends the rows of a part of a table to those of the parts before it.
void append_part(const std::string& part, json& document) {
  json next = json::parse(part);
  if (document.is_null()) {
    document = std::move(next);
    return;
  }
  for (const char* list : {"rows", "points"}) {
    document[list].insert(document[list].end(), next[list].begin(), next[list].end());
  }
}

/// Parts of a table, in order.
struct Parts {
  std::string path;          ///< path of the table, with its format
  std::uint64_t points = 0;  ///< rows of the whole table
  std::uint64_t step = 1;    ///< rows of a part
  bool is_joined = false;    ///< the parts are JSON, whose rows are put into one document
  bool has_head = false;     ///< the first line of each part is the head of the table
};

/// Gets the parts into the output. Sets whether all rows were there. @return the last answer
Answer get_parts(const Parts& parts, RemoteService& service, Output& output, bool& is_complete) {
  json document;
  std::size_t held = 0;
  Answer answer;
  for (std::uint64_t first = 0; first == 0 || first < parts.points; first += parts.step) {
    answer = service.get(
        parts.path + "&first=" + std::to_string(first) + "&count=" + std::to_string(parts.step), {},
        {std::chrono::seconds{0}, kMostKept - std::min(held, kMostKept),
         parts.is_joined ? nullptr : &output});
    if (answer.status != 200) {
      return answer;
    }
    is_complete = is_complete && answer.header("x-complete") == "true";
    held += answer.body.size();
    if (parts.is_joined) {
      append_part(answer.body, document);
    }
    output.complete(parts.has_head);
  }
  if (parts.is_joined) {
    output.write(document.dump() + "\n");
  }
  return answer;
}

int fetch_table(Found found, RemoteService& service, const FetchOptions& options, const Streams& streams) {
  const Answer limits = service.get("/v1/limits");
  const auto most = limits.status == 200 ? document_of(limits).value("table_rows", 0.0) : 0.0;
  if (most < 1.0) {
    return tell_problem(limits, service, streams);
  }
  const std::string format = options.csv ? "csv" : options.ndjson ? "ndjson" : "json";
  const auto points = found.status.value("points", std::uint64_t{0});
  const auto step = static_cast<std::uint64_t>(most);
  Output output(options.output, streams.out);
  bool is_complete = true;
  const Answer last = get_parts(
      {found.path + "/table?format=" + format, points, step, format == "json" && points > step, options.csv},
      service, output, is_complete);
  if (last.status != 200) {
    return tell_problem(last, service, streams);
  }
  // The sweep may have ended in the meantime.
  if (const Answer now = service.get(found.path); now.status == 200) {
    found.status = document_of(now);
  }
  if (is_complete && has_ended(found.status)) {
    return keep(output, options, streams, tell_end(found, streams));
  }
  streams.err << "snapthrough: rows are missing: " << found.status.value("message", "") << '\n';
  return keep(output, options, streams, has_ended(found.status) ? kNotCompleted : kUnfinished);
}

}  // namespace

int submit_command(const std::string& path, const ServiceOptions& service, const SubmitOptions& options,
                   const Streams& streams) {
  const std::optional<std::string> text = read_all(path, streams);
  if (!text) {
    return kOther;
  }
  int status = kDone;
  const auto submission = prepare(*text, options.label, streams, status);
  if (!submission) {
    return status;
  }
  const Interruption interruption;
  std::optional<RemoteService> remote = open_service(service, interruption, streams);
  if (!remote) {
    return kOther;
  }
  const std::string key = options.idempotency_key.empty() ? random_key() : options.idempotency_key;
  const Answer answer = remote->post(submission->path, submission->body,
                                     {{"Idempotency-Key", key}, {"Prefer", "return=minimal"}});
  if (interruption.signal() != 0 && answer.status == 0) {
    streams.err << "interrupted before the service acknowledged; the same document with --idempotency-key "
                << key << " is the same job\n";
    return interruption.exit_status();
  }
  const std::string id = document_of(answer).is_object() ? document_of(answer).value("id", "") : "";
  if ((answer.status != 200 && answer.status != 201) || !is_id(id)) {
    return tell_problem(answer, *remote, streams, submission->prefix);
  }
  streams.out << id << '\n' << std::flush;
  return streams.out ? kDone : kOther;
}

int wait_command(const std::string& id, const ServiceOptions& service, const WaitOptions& options,
                 const Streams& streams) {
  const Interruption interruption;
  std::optional<RemoteService> remote = open_service(service, interruption, streams);
  std::optional<Found> found = remote ? find(id, *remote, streams) : std::nullopt;
  const int status = found ? follow(*found, *remote, options, streams) : kOther;
  if (interruption.signal() != 0 && !(found && has_ended(found->status))) {
    streams.err << "interrupted: " << id << " goes on at the service\n";
    return interruption.exit_status();
  }
  if (status != kDone) {
    return status;
  }
  streams.out << shown(found->status.value("status", "")) << '\n' << std::flush;
  if (!has_ended(found->status)) {
    streams.err << "The time is over; " << id << " goes on: " << found->status.value("message", "") << '\n';
    return kUnfinished;
  }
  return tell_end(*found, streams);
}

int fetch_command(const std::string& id, const ServiceOptions& service, const FetchOptions& options,
                  const Streams& streams) {
  const Interruption interruption;
  std::optional<RemoteService> remote = open_service(service, interruption, streams);
  const std::optional<Found> found = remote ? find(id, *remote, streams) : std::nullopt;
  if (!found) {
    return interruption.signal() != 0 ? interruption.exit_status() : kOther;
  }
  if (found->is_sweep && !options.table.empty()) {
    streams.err << "snapthrough: a sweep has one table; --table is for jobs\n";
    return kOther;
  }
  if (!found->is_sweep && options.ndjson) {
    streams.err << "snapthrough: the result of a job is JSON or CSV; --ndjson is for sweeps\n";
    return kOther;
  }
  if (!found->is_sweep && !has_ended(found->status)) {
    streams.err << "snapthrough: there is no result yet: " << found->status.value("message", "") << '\n';
    return kUnfinished;
  }
  if (!found->is_sweep && found->status.value("status", "") == "dismissed") {
    return tell_end(*found, streams);
  }
  const int status = found->is_sweep ? fetch_table(*found, *remote, options, streams)
                                     : fetch_result(*found, *remote, options, streams);
  return interruption.signal() != 0 && status == kOther ? interruption.exit_status() : status;
}

}  // namespace snapthrough::server::cli
