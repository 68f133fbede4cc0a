#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "api/api.h"
#include "api/json_text.h"
#include "api/list_foundations.h"
#include "api/read_parts.h"
#include "api/read_sensitivities.h"

namespace snapthrough::api {

namespace {

/// Returns whether an unreadable value causes a finding: an unreadable id makes references to it unknown, and
/// an unreadable member leaves its nodes unconnected.
bool follows_from_unreadable(const Finding& finding, const Report& report) {
  struct Referrer {
    std::string_view field;
    const char* list;
  };
  static constexpr std::array<Referrer, 7> kReferrers{{{"start", "/model/nodes"},
                                                       {"end", "/model/nodes"},
                                                       {"node", "/model/nodes"},
                                                       {"section", "/model/sections"},
                                                       {"member", "/model/members"},
                                                       {"id", "/model/monitors"},
                                                       {"displacement", "/model/monitors"}}};
  if (report.covers(finding.pointer)) {
    return true;
  }
  if (finding.code == "unreached_node") {
    return report.covers("/model/members");
  }
  if (finding.code == "unknown_reference") {
    const std::string field = finding.pointer.substr(finding.pointer.rfind('/') + 1);
    for (const Referrer& referrer : kReferrers) {
      if (field == referrer.field) {
        return report.covers(referrer.list);
      }
    }
  }
  return false;
}

/// Returns the findings of reading, then the findings of check() about what could be read, if there is room.
std::vector<Finding> findings_about(const nlohmann::json& document, const Request& request,
                                    const Report& report) {
  std::vector<Finding> all = report.listed();
  if (report.is_cut()) {
    return all;
  }
  std::vector<Finding> checked = check(request.model, request.analysis);
  name_foundation_entries(document, checked);
  for (Finding& finding : checked) {
    if (!follows_from_unreadable(finding, report)) {
      all.push_back(std::move(finding));
    }
  }
  if (all.size() > kMaxFindings) {
    const std::string more = std::to_string(all.size() - kMaxFindings);
    all.resize(kMaxFindings);
    all.push_back({"", "too_many_findings", more + " more findings are not listed"});
  }
  return all;
}

}  // namespace

ReadOutcome read_request_document(std::shared_ptr<const nlohmann::json> document) {
  ReadOutcome outcome;
  Request request;
  Report report;
  Object root(Value(*document, PointerPath(), report));
  root.required("model", request.model);
  root.required("analysis", request.analysis);
  root.finish();
  read_sensitivities(document, request.model, request.analysis, report);
  outcome.findings = findings_about(*document, request, report);
  if (outcome.findings.empty()) {
    request.document = std::move(document);
    outcome.request = std::move(request);
  }
  return outcome;
}

ReadOutcome read_request(std::string_view text) {
  ParsedText parsed = parse_json(text);
  if (parsed.document == nullptr) {
    return {.malformed = true, .findings = std::move(parsed.findings), .request = std::nullopt};
  }
  return read_request_document(std::move(parsed.document));
}

}  // namespace snapthrough::api
