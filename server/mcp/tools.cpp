#include "server/mcp/tools.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "api/api.h"
#include "api/check_document.h"
#include "api/point_outcome.h"
#include "api/provenance.h"
#include "api/sweep.h"
#include "api/sweep_table.h"
#include "server/mcp/digest.h"
#include "server/mcp/missing_values.h"

namespace snapthrough::server::mcp {
namespace {

using nlohmann::json;

using Method = json (Tools::*)(const json&, Dialogue&);

struct NamedMethod {
  std::string_view name;
  Method method;
};

constexpr NamedMethod kMethods[] = {{"check", &Tools::check}, {"solve", &Tools::solve},
                                    {"sweep", &Tools::sweep}, {"read", &Tools::read},
                                    {"plot", &Tools::plot},   {"convert", &Tools::convert}};

/// Rounds of questions to the user: a value that was given can show that others are missing.
constexpr int kMostRounds = 5;
constexpr std::chrono::milliseconds kBetweenNews{200};

json content(const json& document) {
  return json::array(
      {{{"type", "text"}, {"text", document.dump(1, ' ', false, json::error_handler_t::replace)}}});
}

bool lacks_values(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& one) { return one.code == "missing_field"; });
}

/// A document without mistakes, or the answer to a call with mistakes.
template <class Outcome>
struct Completed {
  std::shared_ptr<json> document;
  Outcome outcome = {};
  std::optional<json> refusal = {};
};

/// @brief Reads the arguments, and asks the user for values that are missing as long as nothing else is
/// wrong.
/// @param read returns an outcome with `findings` for a document
/// @param schema name of the published schema of the document
template <class Read>
auto completed(const json& arguments, std::string_view schema, Dialogue& dialogue, const Read& read) {
  using Outcome = decltype(read(std::shared_ptr<json>()));
  Completed<Outcome> whole{std::make_shared<json>(arguments)};
  for (int round = 0; round < kMostRounds; ++round) {
    whole.outcome = read(whole.document);
    const std::vector<Finding>& findings = whole.outcome.findings;
    if (findings.empty()) {
      return whole;
    }
    const std::optional<Question> question = question_about(findings, schema);
    const Dialogue::Answer answer =
        question ? dialogue.ask(question->message, *question->schema) : Dialogue::Answer{};
    if (answer.kind != Dialogue::Answer::Kind::given) {
      whole.refusal = refused(findings);
      return whole;
    }
    // another copy: what was read before may share the document
    whole.document = std::make_shared<json>(*whole.document);
    if (const std::string why = take_answer(json::parse(*answer.content), *question, *whole.document);
        !why.empty()) {
      whole.refusal = failed({{"error", "the user's answer cannot be taken: " + why}});
      return whole;
    }
  }
  whole.refusal = refused(whole.outcome.findings);
  return whole;
}

/// Tells progress now and then.
class News {
 public:
  explicit News(Dialogue& dialogue) : dialogue_(dialogue) {}
  template <class Message>
  void tell(double done, std::optional<double> total, const Message& message) {
    const auto now = std::chrono::steady_clock::now();
    if (now >= next_) {
      next_ = now + kBetweenNews;
      dialogue_.tell(done, total, message());
    }
  }

 private:
  Dialogue& dialogue_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + kBetweenNews;
};

/// What a failed analysis tells: why, and what it had reached.
json failure_of(const JobRun& run, const json& request) {
  json failure = {{"code", run.failure->code}, {"detail", run.failure->detail}};
  json branches = json::array();
  for (const Branch& branch : run.reached.branches) {
    branches.push_back(
        {{"points", branch.load_factor.size()},
         {"last_load_factor", branch.load_factor.empty() ? json() : json(branch.load_factor.back())}});
  }
  json points = json::array();
  for (const CriticalPoint& point : run.reached.critical_points) {
    points.push_back({{"load_factor", point.load_factor}, {"branch", point.branch}});
  }
  return {{"failure", std::move(failure)},
          {"reached", {{"branches", std::move(branches)}, {"critical_points", std::move(points)}}},
          {"program", api::program_json()},
          {"request_sha256", api::request_digest(request)}};
}

/// Returns a table with at most its first kMostRows rows, and `row_count`, the number of all its rows.
json first_rows(const json& table) {
  json shown = table;
  json& rows = shown["rows"];
  json& points = shown["points"];
  shown["row_count"] = rows.size();
  if (rows.size() > kMostRows) {
    shown["rows_shown"] = kMostRows;
    rows.erase(rows.begin() + kMostRows, rows.end());
    points.erase(points.begin() + kMostRows, points.end());
  }
  return shown;
}

}  // namespace

json told(const json& document) { return {{"content", content(document)}}; }

json failed(const json& document) { return {{"content", content(document)}, {"isError", true}}; }

json refused(const std::vector<Finding>& findings) {
  json document = {{"error", "The arguments have mistakes; nothing was computed."},
                   {"errors", api::write_findings(findings)}};
  if (lacks_values(findings)) {
    document["advice"] = "Ask the user for the values that are missing. Do not assume them.";
  }
  return failed(document);
}

bool Tools::has(std::string_view name) {
  return std::any_of(std::begin(kMethods), std::end(kMethods),
                     [&](const auto& one) { return one.name == name; });
}

json Tools::call(std::string_view name, const json& arguments, Dialogue& dialogue) {
  const auto* const found = std::find_if(std::begin(kMethods), std::end(kMethods),
                                         [&](const auto& one) { return one.name == name; });
  return (this->*found->method)(arguments, dialogue);
}

Runner& Tools::runner() {
  if (!runner_) {
    runner_ = around_.make();
  }
  return *runner_;
}

json Tools::check(const json& arguments, Dialogue& /*dialogue*/) {
  const auto document = std::make_shared<const json>(arguments);
  const api::CheckedDocument checked =
      api::is_sweep(arguments) ? api::check_sweep(document, kMostPoints) : api::check_request(document);
  return checked.findings.empty() ? told(json::parse(api::write_check(checked))) : refused(checked.findings);
}

json Tools::solve(const json& arguments, Dialogue& dialogue) {
  auto whole = completed(arguments, "Request", dialogue, [](const std::shared_ptr<json>& document) {
    return api::read_request_document(document);
  });
  if (whole.refusal) {
    return *std::move(whole.refusal);
  }
  News news(dialogue);
  double steps = 0.0;
  Hooks hooks{dialogue.stop()};
  hooks.on_progress = [&](const Progress& progress) {
    news.tell(++steps, std::nullopt, [&] {
      return "branch " + std::to_string(progress.branch) + ", load factor " +
             std::to_string(progress.load_factor);
    });
  };
  const JobRun run = runner().run_job(whole.document->dump(), hooks);
  if (run.failure) {
    return failed(failure_of(run, *whole.document));
  }
  const auto result = std::make_shared<const json>(json::parse(run.result->document));
  json shown = digest_of(*result, kMostItems);
  shown["id"] = shelf_.add("result", result, whole.document, run.result->document.size()).id;
  return told(shown);
}

json Tools::sweep(const json& arguments, Dialogue& dialogue) {
  auto whole = completed(arguments, "SweepDocument", dialogue, [](const std::shared_ptr<json>& document) {
    return api::read_sweep_document(document, kMostPoints);
  });
  if (whole.refusal) {
    return *std::move(whole.refusal);
  }
  const api::Sweep& sweep = *whole.outcome.sweep;
  const std::string document = whole.document->dump();
  api::TableWriter writer(sweep, api::TableForm::json, std::nullopt,
                          api::provenance_members("table", *whole.document));
  std::string table = writer.head();
  std::vector<std::uint64_t> items(sweep.items());
  std::iota(items.begin(), items.end(), std::uint64_t{0});
  std::uint64_t point = 0;
  News news(dialogue);
  const std::string id = "sweep-" + std::to_string(++sweeps_);
  runner().run_items(
      {id, document, sweep, items, dialogue.stop(), {}, [&](const std::vector<api::PointOutcome>& outcomes) {
         for (const api::PointOutcome& outcome : outcomes) {
           writer.append_row(point++, outcome, table);
         }
         news.tell(static_cast<double>(point), static_cast<double>(sweep.size()),
                   [] { return std::string("points"); });
       }});
  if (dialogue.stop().stop_requested()) {
    return failed({{"error", "The sweep was stopped."}, {"points_computed", point}});
  }
  writer.append_tail(table);
  const auto made = std::make_shared<const json>(json::parse(table));
  json shown = first_rows(*made);
  shown["id"] = shelf_.add("table", made, whole.document, table.size()).id;
  return told(shown);
}

}  // namespace snapthrough::server::mcp
