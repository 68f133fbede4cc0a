#include <algorithm>
#include <utility>

#include "api/names.h"
#include "api/provenance.h"
#include "api/sweep_table.h"
#include "server/jobs/memory.h"
#include "server/resources/body_sources.h"
#include "server/resources/documents.h"
#include "server/resources/events.h"
#include "server/resources/negotiation.h"
#include "server/resources/prefer.h"
#include "server/resources/records.h"
#include "server/resources/routes.h"

namespace snapthrough::server::http {
namespace {

/// Returns the name of a state, for messages.
std::string name_of(JobState state) { return std::string(to_string(state)); }

/// Query parameters of a table.
struct TableQuery {
  PointQuery points;
  bool links = false;  ///< true: CSV has the columns point and request
};

bool read_table_parameter(const std::string& name, const std::string& value, TableQuery& table) {
  PointQuery& query = table.points;
  if (name == "first" || name == "count") {
    const std::optional<std::uint64_t> number = whole_number<std::uint64_t>(value);
    (name == "first" ? query.first : query.count) = number.value_or(0);
    return number.has_value();
  }
  if (name == "status") {
    const std::optional<JobState> state = job_state_from(value);
    query.failed = state == JobState::failed;
    return state == JobState::failed || state == JobState::successful;
  }
  if (name == "links") {
    return read_flag(value, table.links);
  }
  return name == "format";  // read by wanted_table_form()
}

const char* content_type(api::TableForm form) {
  switch (form) {
    case api::TableForm::json:
      return "application/json";
    case api::TableForm::csv:
      return "text/csv; charset=utf-8; header=present";
    case api::TableForm::ndjson:
      return "application/x-ndjson";
  }
  return "";
}

/// Returns the entity tag of a complete table. Its rows change only by a retry, which changes `finished`.
std::string table_etag(const SweepRecord& sweep, api::TableForm form, const TableQuery& table) {
  const PointQuery& query = table.points;
  std::string tag = "\"" + sweep.id + "." + std::to_string(static_cast<int>(form)) + "." +
                    std::to_string(sweep.finished->time_since_epoch().count()) + "." +
                    std::to_string(query.first) + "." + std::to_string(query.count);
  tag += table.links ? ".l" : "";
  tag += query.failed ? (*query.failed ? ".f" : ".s") : "";
  return tag + "\"";
}

/// Returns an upper bound of a table's number of rows.
std::uint64_t most_rows(const SweepRecord& sweep, const PointQuery& query) {
  const std::int64_t rows = query.failed ? (*query.failed ? sweep.failed : sweep.successful) : sweep.done();
  return std::min(query.count, static_cast<std::uint64_t>(rows));
}

/// The submitted sweep, or the response to a failure.
struct ReadSweep {
  LargeDocument room;
  std::optional<api::Sweep> sweep;
  Response trouble;
};

ReadSweep read_stored(const Request& request, SweepStore& store, const std::string& id) {
  const StatusOr<std::optional<std::string>> document = store.document(id);
  if (!document.ok()) {
    return {LargeDocument(0), std::nullopt, store_trouble(request, document.status())};
  }
  if (!document->has_value()) {
    return {LargeDocument(0), std::nullopt, sweep_missing(request, id)};
  }
  LargeDocument room((*document)->size());
  api::SweepOutcome read = api::read_sweep(**document);
  if (!read.sweep) {
    return {std::move(room), std::nullopt,
            simple_problem(request, 500, "internal-error", "Internal error",
                           "This version does not accept the stored document any more.")};
  }
  return {std::move(room), std::move(read.sweep), {}};
}

Response rows_of(const Request& request, SweepStore& store, const SweepRecord& record, api::TableForm form,
                 const TableQuery& query) {
  ReadSweep read = read_stored(request, store, record.id);
  if (!read.sweep) {
    return std::move(read.trouble);
  }
  std::optional<api::PointLinks> links;
  if (form != api::TableForm::csv || query.links) {
    const std::string points = sweep_path(record.id) + "/points/{point}";
    links = {points + "/request", points + "/job"};
  }
  api::TableWriter writer(*read.sweep, form, std::move(links),
                          api::provenance_members("table", record.program, record.request_sha256));
  StatusOr<Response> begun = begin_body(table_source(store, record, std::move(writer), query.points));
  if (!begun.ok()) {
    return store_trouble(request, begun.status());
  }
  Response response = std::move(begun).value();
  response.content_type = content_type(form);
  add_provenance(record.program, record.request_sha256, response);
  return response;
}

}  // namespace

Response Routes::with_sweep(const Request& request, const std::string& id,
                            const std::function<Response(const SweepRecord&)>& answer) {
  const StatusOr<std::optional<SweepRecord>> sweep = jobs_.sweeps().get(id, request.owner);
  if (!sweep.ok()) {
    return store_trouble(request, sweep.status());
  }
  return sweep->has_value() ? answer(**sweep) : sweep_missing(request, id);
}

Response Routes::status_of_sweep(const Request& request, const std::string& id, int status) {
  return with_sweep(request, id, [&](const SweepRecord& sweep) {
    return json_response(status, sweep_status_document(sweep));
  });
}

Response Routes::create_sweep(const Request& request, const std::string& /*id*/) {
  if (!is_json(request.header("Content-Type").value_or(""))) {
    return simple_problem(request, 415, "unsupported-media-type", "Unsupported media type",
                          "A sweep document has Content-Type: application/json.");
  }
  if (std::optional<Response> refusal = refused_key(request)) {
    return *std::move(refusal);
  }
  StatusOr<Submission> outcome =
      jobs_.sweeps().submit({request.body, request.id, request.owner, request.header("Idempotency-Key"),
                             false, !wants_fresh(request)});
  if (!outcome.ok()) {
    return store_trouble(request, outcome.status());
  }
  Submission submission = std::move(outcome).value();
  if (std::optional<Response> refusal = refusal_of(request, submission, "sweeps")) {
    return *std::move(refusal);
  }
  const bool is_new = submission.kind == Submission::Kind::stored;
  Response response = status_of_sweep(request, submission.id, is_new ? 201 : 200);
  response.headers.emplace_back("Location", sweep_path(submission.id));
  return response;
}

Response Routes::list_sweeps(const Request& request, const std::string& /*id*/) {
  ListQuery query;
  query.owner = request.owner;
  if (std::optional<Response> refusal = read_list_query(request, query)) {
    return *std::move(refusal);
  }
  const StatusOr<SweepPage> page = jobs_.sweeps().store().list(query);
  if (!page.ok()) {
    return store_trouble(request, page.status());
  }
  const std::string next = next_page(request, page->next);
  return list_page(sweep_list_document(*page, next), next);
}

Response Routes::sweep_status(const Request& request, const std::string& id) {
  const std::chrono::seconds preferred{read_preferences(request).wait_s.value_or(0)};
  const std::chrono::seconds wait = std::min(preferred, waits_.longest_wait);
  const auto ticket = std::make_shared<JobCompletions::Ticket>(jobs_.context().completions, id);
  return with_sweep(request, id, [&](const SweepRecord& sweep) {
    if (wait.count() <= 0 || is_final(sweep.state)) {
      return json_response(200, sweep_status_document(sweep));
    }
    Response response;
    response.deferred =
        Deferred{[ticket](std::function<void()> wake) { ticket->on_end(std::move(wake)); }, wait,
                 // The function's owner keeps the request alive (see Gateway).
                 [this, ticket, &request, id] { return status_of_sweep(request, id, 200); }};
    return response;
  });
}

Response Routes::sweep_request(const Request& request, const std::string& id) {
  return with_sweep(request, id, [&](const SweepRecord&) {
    StatusOr<std::optional<std::string>> document = jobs_.sweeps().store().document(id);
    if (!document.ok()) {
      return store_trouble(request, document.status());
    }
    return document->has_value() ? json_response(200, *std::move(document).value())
                                 : sweep_missing(request, id);
  });
}

Response Routes::sweep_table(const Request& request, const std::string& id) {
  TableQuery query;
  for (const auto& [name, value] : request.query) {
    if (!read_table_parameter(name, value, query)) {
      return wrong_parameter(request,
                             "format (" + api::names_in(api::kTableForms) + "), status (" +
                                 name_of(JobState::successful) + ", " + name_of(JobState::failed) +
                                 "), links (true, false), first and count",
                             name, value);
    }
  }
  const std::optional<api::TableForm> form = wanted_table_form(request);
  if (!form) {
    return simple_problem(request, 406, "not-acceptable", "Not acceptable",
                          "A table is application/json, text/csv, or application/x-ndjson.");
  }
  return with_sweep(request, id, [&](const SweepRecord& sweep) {
    const auto limit = static_cast<std::uint64_t>(jobs_.limits().table_rows);
    if (most_rows(sweep, query.points) > limit) {
      return simple_problem(request, 400, "table-too-large", "Table too large",
                            "This table has more than " + std::to_string(limit) +
                                " rows: ask for it in parts, with first and count (points).");
    }
    const bool complete = sweep.done() == sweep.points;
    const std::string etag = complete && sweep.finished ? table_etag(sweep, *form, query) : "";
    Response response;
    if (!etag.empty() && matches_etag(request, etag)) {
      response.status = 304;
    } else {
      response = rows_of(request, jobs_.sweeps().store(), sweep, *form, query);
    }
    if (response.status < 400) {
      response.headers.emplace_back("X-Complete", complete ? "true" : "false");
      response.headers.emplace_back("Cache-Control", etag.empty() ? "no-store" : "private, no-cache");
      if (!etag.empty()) {
        response.headers.emplace_back("ETag", etag);
      }
    }
    return response;
  });
}

Response Routes::sweep_csv(const Request& request, const std::string& id) {
  const std::optional<Request> csv = as_csv(request);
  return csv ? sweep_table(*csv, id)
             : wrong_parameter(request, "status, links, first and count: the form is that of the address",
                               "format", "");
}

Response Routes::with_point(const Request& request, const std::string& id, const std::string& point,
                            const std::function<Response(std::string)>& answer) {
  return with_sweep(request, id, [&](const SweepRecord&) {
    ReadSweep read = read_stored(request, jobs_.sweeps().store(), id);
    if (!read.sweep) {
      return std::move(read.trouble);
    }
    const std::uint64_t places = read.sweep->places();
    const std::optional<std::uint64_t> number = whole_number<std::uint64_t>(point);
    if (!number || std::to_string(*number) != point || *number >= places) {
      return simple_problem(
          request, 404, "no-such-point", "No such point",
          "The points of this sweep are 0 to " + std::to_string(places - 1) + ", not " + point + ".");
    }
    return answer(read.sweep->request_text(*number));
  });
}

Response Routes::point_request(const Request& request, const std::string& id, const std::string& point) {
  return with_point(request, id, point,
                    [](std::string document) { return json_response(200, std::move(document)); });
}

Response Routes::create_point_job(const Request& request, const std::string& id, const std::string& point) {
  return with_point(request, id, point,
                    [&](const std::string& document) { return submit_job(request, document); });
}

Response Routes::sweep_events(const Request& request, const std::string& id) {
  return with_sweep(request, id, [&](const SweepRecord& sweep) {
    const std::optional<std::uint64_t> end =
        is_final(sweep.state) ? std::optional(kEndOfSweep) : std::nullopt;
    return event_stream(request, end, [this, id](std::uint64_t last, Stream::Push push) {
      return follow_sweep(jobs_, id, last, std::move(push));
    });
  });
}

Response Routes::dismiss_sweep(const Request& request, const std::string& id) {
  return with_sweep(request, id, [&](const SweepRecord&) {
    const StatusOr<SweepChange> change = jobs_.sweeps().dismiss(id);
    if (!change.ok()) {
      return store_trouble(request, change.status());
    }
    if (!change->changed && change->before && *change->before != JobState::dismissed) {
      return simple_problem(request, 409, "already-finished", "Already finished",
                            "The sweep is " + name_of(*change->before) + " already.");
    }
    return status_of_sweep(request, id, 200);
  });
}

Response Routes::retry_sweep(const Request& request, const std::string& id) {
  for (const auto& [name, value] : request.query) {
    if (name != "status" || job_state_from(value) != JobState::failed) {
      return wrong_parameter(request, "status=" + name_of(JobState::failed), name, value);
    }
  }
  return with_sweep(request, id, [&](const SweepRecord&) {
    const StatusOr<SweepChange> change = jobs_.sweeps().retry(id);
    if (!change.ok()) {
      return store_trouble(request, change.status());
    }
    if (!change->changed && change->before) {
      return simple_problem(request, 409, "nothing-to-retry", "Nothing to retry",
                            "Points are tried again when a sweep is " + name_of(JobState::failed) + " or " +
                                name_of(JobState::dismissed) + "; this one is " + name_of(*change->before) +
                                ".");
    }
    return status_of_sweep(request, id, 200);
  });
}

Response Routes::delete_sweep(const Request& request, const std::string& id) {
  return with_sweep(request, id, [&](const SweepRecord&) {
    if (const Status status = jobs_.sweeps().remove(id); !status.ok()) {
      return store_trouble(request, status);
    }
    Response response;
    response.status = 204;
    return response;
  });
}

}  // namespace snapthrough::server::http
