#include "api/sweep_item.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "api/names.h"
#include "api/refined_item.h"
#include "api/solved_point.h"
#include "api/sweep_data.h"
#include "solver/sweep/critical_curve.h"
#include "solver/sweep/critical_locus.h"

namespace snapthrough::api {
namespace {

/// Returns a model between points of a curve. @throws std::runtime_error when the request is invalid there
Model model_between(const Sweep& sweep, std::uint64_t first, double value) {
  ReadOutcome read = read_request_document(sweep.document_between(first, value));
  if (!read.request) {
    throw std::runtime_error("between two points: " + sentence_of(read.findings));
  }
  return std::move(read.request->model);
}

constexpr Named<LocusEventType> kLocusEventTypes[] = {{"cusp", LocusEventType::cusp},
                                                      {"fold_bifurcation", LocusEventType::fold_bifurcation},
                                                      {"turn", LocusEventType::turn},
                                                      {"not_followed", LocusEventType::not_followed}};

nlohmann::json point_document(double load_factor, CriticalType type) {
  return {{"load_factor", load_factor}, {"type", name_of(kCriticalTypes, type)}};
}

nlohmann::json number_or_null(const std::optional<double>& number) {
  return number ? nlohmann::json(*number) : nlohmann::json();
}

/// Returns the document of a row of a curve: critical points, special points up to the next row, and the load
/// factor up to which there is no critical point.
nlohmann::json curve_document(nlohmann::json points, nlohmann::json events,
                              const std::optional<double>& none_up_to) {
  nlohmann::json summary{{"critical_load_factor", nullptr}, {"critical_type", nullptr}};
  if (!points.empty()) {
    summary = {{"critical_load_factor", points[0]["load_factor"]}, {"critical_type", points[0]["type"]}};
  }
  return {{"summary", std::move(summary)},
          {"curve",
           {{"critical_points", std::move(points)},
            {"events", std::move(events)},
            {"none_up_to", number_or_null(none_up_to)}}}};
}

/// Values of a curve with valid requests.
struct CurveRows {
  Analysis analysis;
  std::vector<double> values;
  std::vector<std::size_t> rows;  ///< index of each value among the points of the item
};

/// Returns the rows with valid requests; the outcomes of the others are set.
CurveRows curve_rows(const Sweep& sweep, std::uint64_t first, std::vector<PointOutcome>& outcomes) {
  CurveRows out;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const ReadOutcome read = read_request_document(sweep.document_at(first + i));
    if (!read.request) {
      outcomes[i] = {"", "wrong_request", sentence_of(read.findings)};
      continue;
    }
    out.analysis = read.request->analysis;
    out.values.push_back(sweep.values(first + i).back().get<double>());
    out.rows.push_back(i);
  }
  return out;
}

PointOutcome path_failure(const std::string& code) { return {"", code, "the path could not be traced"}; }

/// First critical point of each value.
void follow_first(const Sweep& sweep, const CurveRows& rows, std::function<Model(double)> model,
                  const std::stop_token& stop, std::vector<PointOutcome>& outcomes) {
  const CriticalCurve curve = follow_critical_point({.model = std::move(model),
                                                     .analysis = rows.analysis,
                                                     .values = rows.values,
                                                     .logarithmic = sweep.follows_logarithm(),
                                                     .stop = stop});
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const CriticalCurvePoint& point = curve.points[i];
    nlohmann::json points = nlohmann::json::array();
    if (point.load_factor) {
      points.push_back(point_document(*point.load_factor, point.type));
    }
    outcomes[rows.rows[i]] =
        point.failure.empty()
            ? sweep.outcome(curve_document(std::move(points), nlohmann::json::array(), point.none_up_to))
            : path_failure(point.failure);
  }
}

/// Returns the last row whose value an event has reached.
std::size_t row_of(const LocusEvent& event, const std::vector<double>& values) {
  const bool up = values.back() > values.front();
  std::size_t row = 0;
  while (row + 1 < values.size() && (up ? values[row + 1] <= event.value : values[row + 1] >= event.value)) {
    ++row;
  }
  return row;
}

/// A named critical point as far as its curve does not turn back, or all curves.
void follow_locus(const Sweep& sweep, const CurveRows& rows, std::function<Model(double)> model,
                  const std::stop_token& stop, std::vector<PointOutcome>& outcomes) {
  const SweepFollow& followed = sweep.data().followed;
  const CriticalLocus locus = follow_critical_locus({.model = std::move(model),
                                                     .analysis = rows.analysis,
                                                     .values = rows.values,
                                                     .logarithmic = sweep.follows_logarithm(),
                                                     .number = followed.point,
                                                     .stop = stop});
  std::vector<nlohmann::json> points(rows.rows.size(), nlohmann::json::array());
  std::vector<nlohmann::json> events = points;
  for (const LocusCurve& curve : locus.curves) {
    for (const LocusLoad& load : curve.loads) {
      if (followed.locus || points[load.value].empty()) {
        points[load.value].push_back(point_document(load.load_factor, load.type));
      }
    }
    for (const LocusEvent& event : curve.events) {
      events[row_of(event, rows.values)].push_back({{"type", name_of(kLocusEventTypes, event.type)},
                                                    {"value", event.value},
                                                    {"load_factor", event.load_factor}});
    }
  }
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    outcomes[rows.rows[i]] =
        locus.failure.empty()
            ? sweep.outcome(curve_document(std::move(points[i]), std::move(events[i]), locus.none_up_to[i]))
            : path_failure(locus.failure);
  }
}

std::vector<PointOutcome> followed(const Sweep& sweep, std::uint64_t first, const std::stop_token& stop) {
  std::vector<PointOutcome> outcomes(static_cast<std::size_t>(sweep.item_size()));
  const CurveRows rows = curve_rows(sweep, first, outcomes);
  const SweepFollow& which = sweep.data().followed;
  const auto model = [&sweep, first](double value) { return model_between(sweep, first, value); };
  if (rows.rows.empty()) {
    return outcomes;
  }
  if (!which.locus && !which.point) {
    follow_first(sweep, rows, model, stop, outcomes);
  } else if (rows.rows.size() < 2) {
    outcomes[rows.rows[0]] = {"", "wrong_request", "the curve has no other valid value to be followed to"};
  } else {
    follow_locus(sweep, rows, model, stop, outcomes);
  }
  return outcomes;
}

/// Computes item_outcomes(), but lets exceptions pass.
std::vector<PointOutcome> outcomes_of(const Sweep& sweep, std::uint64_t item, const SolvePoint& solve,
                                      const Hooks& hooks, std::shared_ptr<nlohmann::json>& document) {
  const std::uint64_t first = item * sweep.item_size();
  if (sweep.follows()) {
    return followed(sweep, first, hooks.stop);
  }
  if (sweep.refines()) {
    return {refined_outcome(sweep, item, solve, hooks, document)};
  }
  sweep.write_document(first, document);
  std::vector<PointOutcome> alone;
  alone.push_back(solved_point(sweep, document, solve, hooks));
  return alone;
}

}  // namespace

std::vector<PointOutcome> item_outcomes(const Sweep& sweep, std::uint64_t item, const SolvePoint& solve,
                                        const Hooks& hooks, std::shared_ptr<nlohmann::json>& document) {
  try {
    return outcomes_of(sweep, item, solve, hooks, document);
  } catch (...) {
    return std::vector<PointOutcome>(sweep.item_size(), mishap_now());
  }
}

bool is_cut_short(const std::vector<PointOutcome>& outcomes) {
  return std::any_of(outcomes.begin(), outcomes.end(),
                     [](const PointOutcome& outcome) { return outcome.code == "cancelled"; });
}

PointOutcome mishap_now() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return {"", "out_of_memory", "the analysis needs more memory than there is"};
  } catch (const std::exception& error) {
    return {"", "internal_error", error.what()};
  } catch (...) {
    return {"", "internal_error", "unknown exception"};
  }
}

}  // namespace snapthrough::api
