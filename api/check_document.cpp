#include "api/check_document.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "solver/mesh/mesh.h"
#include "solver/numeric/number_text.h"
#include "solver/numeric/work_limit.h"
#include "solver/resolve/resolved_model.h"

namespace snapthrough::api {
namespace {

using nlohmann::ordered_json;

/// Largest number of points that are read to find a valid request.
constexpr std::uint64_t kTries = 10;
/// Largest number of points whose expected times make that of a sweep.
constexpr std::uint64_t kTimed = 10;
/// Questions of a WorkLimit after which no further points are read for the expected time: some 10 000 items
/// of lists, so that a check of a large document costs little more than reading its first point.
constexpr int kMostQuestions = 200;

/// Returns the number of free displacement unknowns of the request's mesh, before any refinement.
int unknowns_of(const Request& request) {
  const ResolvedModel model = resolve(request.model);
  const MeshSize mesh = mesh_size(model, request.analysis.discretization);
  // A member of n elements of order p has n p - 1 inner nodes with three displacements each.
  int unknowns = 3 * static_cast<int>(model.nodes.size());
  unknowns += 3 * (static_cast<int>(mesh.elements) * mesh.order - static_cast<int>(model.members.size()));
  for (const Member& member : model.members) {
    unknowns += (member.release_start_rotation ? 1 : 0) + (member.release_end_rotation ? 1 : 0);
  }
  for (const Support& support : model.supports) {
    unknowns -= (support.x ? 1 : 0) + (support.y ? 1 : 0) + (support.rotation ? 1 : 0);
  }
  return unknowns;
}

/// A number > 0 with three significant digits, which is more than an expected time has.
ordered_json rounded_number(double number) { return ordered_json::parse(rounded(number)); }

ordered_json write_time(const ExpectedTime& time) {
  return {{"cpu_seconds", rounded_number(time.cpu_seconds)},
          {"low", rounded_number(time.low)},
          {"high", rounded_number(time.high)},
          {"model", time.model}};
}

/// @brief Point number i of a sequence that spreads over a sweep: multiples of the golden ratio, which fall
/// in step with no parameter of a grid.
std::uint64_t spread(std::uint64_t i, std::uint64_t points) {
  const double turns = static_cast<double>(i) * std::numbers::phi;
  const auto at = static_cast<std::uint64_t>((turns - std::floor(turns)) * static_cast<double>(points));
  return std::min(at, points - 1);
}

/// Adds the expected times of points that are spread over a sweep, as many as can be read with little work.
void add_times(const Sweep& sweep, std::vector<ExpectedTime>& times) {
  const std::uint64_t all = sweep.size();
  int questions = 0;
  const WorkLimit limit([&questions]() -> std::optional<WorkEnd> {
    return ++questions > kMostQuestions ? std::optional(WorkEnd::time_used) : std::nullopt;
  });
  try {
    for (std::uint64_t i = 1; i < std::min(all, kTimed); ++i) {
      const CheckedDocument one = check_request(sweep.document_at(all <= kTimed ? i : spread(i, all)));
      if (one.expected) {
        times.push_back(*one.expected);
      }
    }
  } catch (const WorkEnded&) {
    return;  // the points that were read speak for all
  }
}

}  // namespace

CheckedDocument check_request(const std::shared_ptr<const nlohmann::json>& document,
                              const AlsoRefused& also) {
  ReadOutcome read = read_request_document(document);
  if (!read.request) {
    return {std::move(read.findings), 1, 0};
  }
  CheckedDocument checked{also ? also(*read.request) : std::vector<Finding>(), 1, unknowns_of(*read.request)};
  checked.expected = expected_time(read.request->model, read.request->analysis, checked.unknowns);
  return checked;
}

CheckedDocument check_sweep(const std::shared_ptr<const nlohmann::json>& document, std::uint64_t most_points,
                            const AlsoRefused& also) {
  SweepOutcome read = read_sweep_document(document, most_points);
  CheckedDocument checked{std::move(read.findings), read.sweep ? read.sweep->size() : 0, 0};
  std::vector<ExpectedTime> times;
  for (std::uint64_t i = 0; i < std::min(checked.points, kTries) && times.empty(); ++i) {
    const CheckedDocument one = check_request(read.sweep->document_at(i), also);
    checked.unknowns = one.unknowns;
    if (one.expected) {
      times.push_back(*one.expected);
    }
  }
  if (!times.empty() && !read.sweep->refines()) {  // nobody knows the number of points that are added
    add_times(*read.sweep, times);
    checked.expected = expected_time(*read.sweep, std::move(times));
  }
  return checked;
}

std::string write_check(const CheckedDocument& checked) {
  ordered_json document{
      {"valid", checked.findings.empty()}, {"errors", write_findings(checked.findings)}, {"size", nullptr}};
  if (checked.findings.empty()) {
    document["size"] = {
        {"points", checked.points},
        {"unknowns", checked.unknowns},
        {"expected", checked.expected ? write_time(*checked.expected) : ordered_json(nullptr)}};
  }
  return document.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace snapthrough::api
