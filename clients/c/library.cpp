#include <algorithm>
#include <chrono>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/api.h"
#include "api/check_document.h"
#include "api/json_text.h"
#include "api/plot/plot.h"
#include "api/plot/plot_choices.h"
#include "api/plot/plot_error.h"
#include "api/plot/plot_request.h"
#include "api/point_outcome.h"
#include "api/provenance.h"
#include "api/solved_point.h"
#include "api/sweep.h"
#include "api/sweep_item.h"
#include "api/sweep_table.h"
#include "clients/c/snapthrough.h"
#include "solver/solve.h"

struct snapthrough_stop {
  std::stop_source source;
};

namespace {

using nlohmann::ordered_json;
using snapthrough::Analysis;
using snapthrough::Finding;
using snapthrough::Hooks;
using snapthrough::Model;
using snapthrough::NamedValue;
using snapthrough::Progress;
using snapthrough::Result;
using snapthrough::TracedPoint;
namespace api = snapthrough::api;

/// Smallest size of snapthrough_options in any version of the header.
constexpr std::size_t kFirstOptions = sizeof(snapthrough_options);

/// Status and text of a returned document before its allocation.
struct Answer {
  snapthrough_status status = SNAPTHROUGH_DONE;
  std::string text;
};

/// Returns a document and its text in one allocation, for snapthrough_free(); null without memory.
snapthrough_document* given_away(const Answer& answer) noexcept {
  void* memory = ::operator new(sizeof(snapthrough_document) + answer.text.size() + 1, std::nothrow);
  if (memory == nullptr) {
    return nullptr;
  }
  char* text = static_cast<char*>(memory) + sizeof(snapthrough_document);
  std::memcpy(text, answer.text.c_str(), answer.text.size() + 1);
  return new (memory) snapthrough_document{text, answer.text.size(), answer.status};
}

std::string dumped(const ordered_json& document) {
  return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// Returns a problem document (RFC 9457) like those of the HTTP service.
ordered_json problem(const char* kind, const char* title, int status, const std::string& detail) {
  return {{"type", std::string("urn:snapthrough:problem:") + kind},
          {"title", title},
          {"status", status},
          {"detail", detail}};
}

Answer wrong_use(const std::string& rule) {
  return {SNAPTHROUGH_WRONG_USE, dumped(problem("wrong-use", "Wrong use of a function", 400, rule))};
}

/// Returns a problem with the findings of a request or a sweep.
Answer refused(bool malformed, const std::vector<Finding>& findings) {
  ordered_json document =
      malformed ? problem("malformed-json", "Malformed JSON", 400, "The text is no acceptable JSON text.")
                : problem("invalid-request", "Invalid request", 422,
                          "The document has mistakes; `errors` lists them.");
  document["errors"] = api::write_findings(findings);
  return {SNAPTHROUGH_WRONG_REQUEST, dumped(document)};
}

Answer mishap(snapthrough_status status, const char* code, const std::string& detail) {
  ordered_json document = problem("analysis-failed", "The analysis could not be completed", 500, detail);
  document["code"] = code;
  return {status, dumped(document)};
}

/// Calls a function and returns its answer as a document; an exception becomes an answer, too.
template <typename Function>
snapthrough_document* answered(const Function& function) noexcept {
  try {
    try {
      return given_away(function());
    } catch (const std::bad_alloc&) {
      return given_away(mishap(SNAPTHROUGH_OUT_OF_MEMORY, "out_of_memory", "There is not enough memory."));
    } catch (const std::exception& error) {
      return given_away(mishap(SNAPTHROUGH_INTERNAL_ERROR, "internal_error", error.what()));
    } catch (...) {
      return given_away(mishap(SNAPTHROUGH_INTERNAL_ERROR, "internal_error", "An unknown exception was thrown."));
    }
  } catch (...) {
    return nullptr;  // no memory even for a problem document
  }
}

/// Returns the stop source of the options (shared with other threads) or a new one; nullopt for a wrong size.
std::optional<std::stop_source> stop_of(const snapthrough_options* options) {
  if (options == nullptr) {
    return std::stop_source();
  }
  if (options->size < kFirstOptions) {
    return std::nullopt;
  }
  return options->stop != nullptr ? options->stop->source : std::stop_source();
}

constexpr const char* kSizeRule = "options->size is sizeof(snapthrough_options) of the header that the caller used.";
constexpr const char* kTextRule = "The pointer to a text of one byte or more is not null.";

/// @brief Connects a running call with its caller: reports progress, and stops the call by the callback's
/// value or from another thread.
class Caller {
 public:
  Caller(const std::stop_source& stop, snapthrough_callback callback, void* user)
      : callback_(callback), user_(user), forward_(stop.get_token(), Request{stopped_}) {}

  [[nodiscard]] bool watches() const { return callback_ != nullptr; }
  void tell(const snapthrough_progress& progress) {
    if (callback_ != nullptr && callback_(&progress, user_) != 0) {
      stopped_.request_stop();
    }
  }
  [[nodiscard]] std::stop_token stopped() const { return stopped_.get_token(); }

 private:
  struct Request {
    std::stop_source& stopped;
    void operator()() const { stopped.request_stop(); }
  };

  snapthrough_callback callback_;
  void* user_;
  std::stop_source stopped_;  ///< for this call only; several calls may share the caller's
  std::stop_callback<Request> forward_;
};

api::TimedResult timed(const Model& model, const Analysis& analysis, const Hooks& hooks) {
  const auto start = std::chrono::steady_clock::now();
  Result result = snapthrough::solve_checked(model, analysis, hooks);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return {std::move(result), elapsed.count()};
}

Answer solved(std::string_view text, Caller& caller) {
  api::ReadOutcome read = api::read_request(text);
  if (!read.request) {
    return refused(read.malformed, read.findings);
  }
  snapthrough_progress point{};
  point.size = sizeof point;
  std::vector<double> monitors;
  Hooks hooks;
  hooks.stop = caller.stopped();
  if (caller.watches()) {
    hooks.on_point = [&point, &monitors](const TracedPoint& traced) {
      point.arc_length = traced.arc_length;
      monitors.clear();
      for (const NamedValue& monitor : traced.monitors) {
        monitors.push_back(monitor.value);
      }
    };
    hooks.on_progress = [&](const Progress& progress) {
      point.done = static_cast<std::uint64_t>(progress.step);
      point.load_factor = progress.load_factor;
      point.branch = progress.branch;
      point.negative_eigenvalues = progress.negative_eigenvalues;
      point.monitors = monitors.data();
      point.monitor_count = monitors.size();
      caller.tell(point);
    };
  }
  const auto [result, seconds] = timed(read.request->model, read.request->analysis, hooks);
  Answer answer{SNAPTHROUGH_DONE, api::write_result(*read.request, result, seconds).dump()};
  if (result.failure) {
    answer.status = result.failure->code == "cancelled" ? SNAPTHROUGH_CANCELLED : SNAPTHROUGH_NOT_COMPLETED;
  }
  return answer;
}

Answer checked(std::string_view text) {
  const api::ParsedText parsed = api::parse_json(text);
  api::CheckedDocument result;
  if (parsed.document == nullptr) {
    result.findings = parsed.findings;
  } else {
    result = api::is_sweep(*parsed.document) ? api::check_sweep(parsed.document)
                                             : api::check_request(parsed.document);
  }
  return {result.findings.empty() ? SNAPTHROUGH_DONE : SNAPTHROUGH_WRONG_REQUEST, api::write_check(result)};
}

/// Returns findings about the choices of a figure, with pointers that begin with "choices:".
Answer refused_choices(bool malformed, std::vector<Finding> findings) {
  for (Finding& finding : findings) {
    finding.pointer.insert(0, "choices:");
  }
  return refused(malformed, findings);
}

Answer plotted(std::string_view text, std::string_view choices_text) {
  const api::ParsedText parsed = api::parse_json(text, api::kFigureLimits);
  if (parsed.document == nullptr) {
    return refused(true, parsed.findings);
  }
  const api::ParsedText parsed_choices = api::parse_json(choices_text);
  if (parsed_choices.document == nullptr) {
    return refused_choices(true, parsed_choices.findings);
  }
  const api::PlotChoices choices = api::read_plot_choices(*parsed_choices.document);
  if (!choices.findings.empty()) {
    return refused_choices(false, choices.findings);
  }
  try {
    return {SNAPTHROUGH_DONE, api::svg_of(*parsed.document, choices.request)};
  } catch (const api::PlotError& error) {
    return refused(false, {{error.pointer(), "no_figure", error.rule()}});
  }
}

/// Points of a sweep that one call solves.
struct Points {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// Returns the rule that `points` breaks; "" for valid points.
std::string broken_rule(const api::Sweep& sweep, const Points& points) {
  const std::uint64_t unit = sweep.item_size();
  if (points.first % unit != 0 || points.count % unit != 0) {
    return "`first` and `count` are multiples of the sweep's unit, " + std::to_string(unit) + ".";
  }
  if (points.first >= sweep.size()) {
    return "`first` is less than the number of points of the sweep, " + std::to_string(sweep.size()) + ".";
  }
  return "";
}

Answer swept(const api::Sweep& sweep, const nlohmann::json& asked, Points points, Caller& caller) {
  const Hooks hooks{.stop = caller.stopped()};
  points.count = std::min(points.count, sweep.size() - points.first);
  api::TableWriter table(sweep, api::TableForm::json, std::nullopt, api::provenance_members("table", asked));
  Answer answer{SNAPTHROUGH_DONE, "{\"total\": " + std::to_string(sweep.size()) +
                                      ", \"unit\": " + std::to_string(sweep.item_size()) + ", " +
                                      table.head().substr(1)};
  std::shared_ptr<nlohmann::json> document;
  for (std::uint64_t done = 0; done < points.count;) {
    const std::uint64_t item = (points.first + done) / sweep.item_size();
    const std::vector<api::PointOutcome> outcomes =
        hooks.stop.stop_requested() ? std::vector<api::PointOutcome>()
                                    : api::item_outcomes(sweep, item, timed, hooks, document);
    if (outcomes.empty() || api::is_cut_short(outcomes)) {
      answer.status = SNAPTHROUGH_CANCELLED;
      break;
    }
    for (const api::PointOutcome& outcome : outcomes) {
      table.append_row(points.first + done, outcome, answer.text);
      ++done;
    }
    caller.tell({sizeof(snapthrough_progress), done, points.count, 0.0, 0, 0, 0.0, nullptr, 0});
  }
  table.append_tail(answer.text);
  return answer;
}

}  // namespace

const char* snapthrough_version(void) { return SNAPTHROUGH_VERSION; }

snapthrough_stop* snapthrough_stop_new(void) {
  try {
    return new snapthrough_stop;
  } catch (...) {
    return nullptr;
  }
}

void snapthrough_stop_request(snapthrough_stop* stop) {
  if (stop != nullptr) {
    stop->source.request_stop();
  }
}

void snapthrough_stop_free(snapthrough_stop* stop) { delete stop; }

snapthrough_document* snapthrough_solve(const char* request, size_t length, const snapthrough_options* options,
                                        snapthrough_callback callback, void* user) {
  return answered([&]() -> Answer {
    const std::optional<std::stop_source> stop = stop_of(options);
    if (!stop) {
      return wrong_use(kSizeRule);
    }
    if (request == nullptr && length > 0) {
      return wrong_use(kTextRule);
    }
    Caller caller(*stop, callback, user);
    return solved({request, length}, caller);
  });
}

snapthrough_document* snapthrough_check(const char* document, size_t length) {
  return answered([&]() -> Answer {
    return document == nullptr && length > 0 ? wrong_use(kTextRule) : checked({document, length});
  });
}

snapthrough_document* snapthrough_sweep(const char* document, size_t length, uint64_t first, uint64_t count,
                                        const snapthrough_options* options, snapthrough_callback callback,
                                        void* user) {
  return answered([&]() -> Answer {
    const std::optional<std::stop_source> stop = stop_of(options);
    if (!stop) {
      return wrong_use(kSizeRule);
    }
    if (document == nullptr && length > 0) {
      return wrong_use(kTextRule);
    }
    const api::ParsedText parsed = api::parse_json({document, length});
    const api::SweepOutcome read = parsed.document != nullptr
                                       ? api::read_sweep_document(parsed.document)
                                       : api::SweepOutcome{true, parsed.findings, {}};
    if (!read.sweep) {
      return refused(read.malformed, read.findings);
    }
    if (const std::string rule = broken_rule(*read.sweep, {first, count}); !rule.empty()) {
      return wrong_use(rule);
    }
    Caller caller(*stop, callback, user);
    return swept(*read.sweep, *parsed.document, {first, count}, caller);
  });
}

snapthrough_document* snapthrough_plot(const char* document, size_t length, const char* choices,
                                       size_t choices_length) {
  return answered([&]() -> Answer {
    if ((document == nullptr && length > 0) || (choices == nullptr && choices_length > 0)) {
      return wrong_use(kTextRule);
    }
    return plotted({document, length}, choices == nullptr ? "{}" : std::string_view(choices, choices_length));
  });
}

void snapthrough_free(snapthrough_document* document) { ::operator delete(document); }
