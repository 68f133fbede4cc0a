#include "api/refined_item.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/chart_label.h"
#include "api/solved_point.h"
#include "api/sweep_data.h"
#include "solver/sweep/chart.h"

namespace snapthrough::api {
namespace {

using Json = nlohmann::json;

/// A point was stopped on request.
struct Stopped {
  PointOutcome outcome;
};

struct Solved {
  PointOutcome outcome;
  ChartLabel label;
  std::optional<double> value;  ///< the output that decides; empty: the point failed, or has none
};

ChartAxis axis_of(const SweepParameter& parameter) {
  return {parameter.range->count - 1, parameter.range->first_parts};
}

/// Solves places of one curve or surface and keeps their outcomes.
class Places {
 public:
  Places(const Sweep& sweep, std::uint64_t first, const SolvePoint& solve, const Hooks& hooks,
         std::shared_ptr<Json>& document)
      : sweep_(sweep), first_(first), solve_(solve), hooks_(hooks), document_(document) {}

  /// Solves a place once: a surface may ask for it again.
  /// @param place counted from the first one of the curve or surface
  ChartValue at(std::uint64_t place) {
    auto known = known_.find(place);
    if (known == known_.end()) {
      known = known_.emplace(place, solved(place)).first;
    }
    return {known->second.value, known->second.label.kind()};
  }

  /// Appends the rows of a curve. @param first place of the curve's first place
  void append_rows(const ChartCurve& curve, std::uint64_t first, Json& rows) const {
    for (std::size_t i = 0; i < curve.places.size(); ++i) {
      const std::uint64_t place = first + static_cast<std::uint64_t>(curve.places[i]);
      const Solved& here = known_.at(place);
      const PointOutcome& outcome = here.outcome;
      Json outputs = outcome.failed() ? Json() : Json::parse(outcome.outputs);
      Json error = outcome.failed() ? Json{{"code", outcome.code}, {"detail", outcome.detail}} : Json();
      rows.push_back(Json::array({first_ + place, std::move(outputs), std::move(error), curve.pieces[i],
                                  change_at(curve, i, first)}));
    }
  }

 private:
  Solved solved(std::uint64_t place) {
    Solved here;
    const SweepRefine& refine = *sweep_.data().refine;
    sweep_.write_document(first_ + place, document_);
    here.outcome = solved_point(sweep_, document_, solve_, hooks_, [&](const Result& result) {
      here.label = label_of(result, sweep_.data().outputs[refine.number]);
    });
    if (here.outcome.code == "cancelled") {
      throw Stopped{here.outcome};
    }
    here.label.failure = here.outcome.code;
    if (!here.outcome.failed()) {
      const Json output = Json::parse(here.outcome.outputs)[refine.number];
      here.value = output.is_number() ? std::optional(output.get<double>()) : std::nullopt;
    }
    return here;
  }

  [[nodiscard]] Json change_at(const ChartCurve& curve, std::size_t i, std::uint64_t first) const {
    if (i == 0 || curve.pieces[i] == curve.pieces[i - 1]) {
      return nullptr;
    }
    const ChartValue& before = curve.values[i - 1];
    const ChartValue& after = curve.values[i];
    const auto label = [&](std::size_t at) -> const ChartLabel& {
      return known_.at(first + static_cast<std::uint64_t>(curve.places[at])).label;
    };
    return change_between(label(i - 1), label(i), curve.jumps[i], before.value.has_value(),
                          after.value.has_value());
  }

  const Sweep& sweep_;
  const std::uint64_t first_;
  const SolvePoint& solve_;
  const Hooks& hooks_;
  std::shared_ptr<Json>& document_;
  std::map<std::uint64_t, Solved> known_;
};

/// Returns a failure that says between which values of which parameter the search ended.
PointOutcome at_limit(const Sweep& sweep, std::uint64_t first, std::size_t parameter, std::uint64_t stride,
                      const ChartGap& gap) {
  const auto value = [&](int place) {
    return sweep.values(first + static_cast<std::uint64_t>(place) * stride)[parameter].dump();
  };
  const SweepData& data = sweep.data();
  return {"", "refinement_limit",
          std::to_string(data.refine->most) + " points are not enough: between " +
              data.parameters[parameter].name + " = " + value(gap.first) + " and " + value(gap.second) +
              " lines are not known to be within " + Json(data.refine->within).dump() +
              "; allow more (refine.most), a larger share (refine.within), or ask for a smaller range"};
}

PointOutcome outcome_of(const Json& rows) {
  std::string text = rows.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > kMaxOutputBytes) {
    return {"", "outputs_too_large",
            "the rows of a curve or surface have at most " + std::to_string(kMaxOutputBytes) +
                " bytes, these have " + std::to_string(text.size()) +
                ": ask for fewer outputs or a larger share (refine.within)"};
  }
  return {std::move(text), "", ""};
}

PointOutcome curve_outcome(const Sweep& sweep, std::uint64_t first, Places& places,
                           const ChartLimits& limits) {
  const SweepParameter& along = sweep.data().parameters.back();
  const ChartCurve curve = chart_curve(
      [&](int place) { return places.at(static_cast<std::uint64_t>(place)); }, axis_of(along), limits);
  if (curve.unfinished) {
    return at_limit(sweep, first, sweep.data().parameters.size() - 1, 1, *curve.unfinished);
  }
  Json rows = Json::array();
  places.append_rows(curve, 0, rows);
  return outcome_of(rows);
}

PointOutcome surface_outcome(const Sweep& sweep, std::uint64_t first, Places& places,
                             const ChartLimits& limits) {
  const std::vector<SweepParameter>& parameters = sweep.data().parameters;
  const SweepParameter& outer = parameters[parameters.size() - 2];
  const std::uint64_t stride = parameters.back().count();
  const ChartSurface surface = chart_surface(
      [&](int row, int place) {
        return places.at(static_cast<std::uint64_t>(row) * stride + static_cast<std::uint64_t>(place));
      },
      axis_of(outer), axis_of(parameters.back()), limits);
  if (surface.unfinished) {
    return at_limit(sweep, first, parameters.size() - 2, stride, *surface.unfinished);
  }
  Json rows = Json::array();
  for (std::size_t i = 0; i < surface.curves.size(); ++i) {
    places.append_rows(surface.curves[i], static_cast<std::uint64_t>(surface.places[i]) * stride, rows);
  }
  return outcome_of(rows);
}

}  // namespace

PointOutcome refined_outcome(const Sweep& sweep, std::uint64_t number, const SolvePoint& solve,
                             const Hooks& hooks, std::shared_ptr<Json>& document) {
  const SweepRefine& refine = *sweep.data().refine;
  const std::uint64_t first = sweep.first_place(number);
  const ChartLimits limits{refine.within, static_cast<std::size_t>(refine.most)};
  Places places(sweep, first, solve, hooks, document);
  try {
    return refine.parameters == 1 ? curve_outcome(sweep, first, places, limits)
                                  : surface_outcome(sweep, first, places, limits);
  } catch (const Stopped& stopped) {
    return stopped.outcome;
  }
}

namespace {

/// Parameters' values of a failed curve or surface: null for those along it.
std::vector<Json> labels_of_item(const SweepData& data, std::uint64_t first) {
  std::vector<Json> labels = design_labels(data, first);
  for (std::size_t i = labels.size() - static_cast<std::size_t>(data.refine->parameters); i < labels.size();
       ++i) {
    labels[i] = nullptr;
  }
  return labels;
}

}  // namespace

std::vector<SweepRow> Sweep::rows_of(std::uint64_t number, const PointOutcome& outcome) const {
  const std::uint64_t first = first_place(number);
  std::vector<SweepRow> rows;
  if (!refines() || outcome.failed()) {
    rows.push_back({first, refines() ? labels_of_item(*data_, first) : design_labels(*data_, first), outcome,
                    std::vector<Json>(own_columns().size())});
    return rows;
  }
  for (const Json& row : Json::parse(outcome.outputs)) {
    const auto point = row[0].get<std::uint64_t>();
    const Json& error = row[2];
    rows.push_back({point,
                    design_labels(*data_, point),
                    error.is_null() ? PointOutcome{row[1].dump(), "", ""}
                                    : PointOutcome{"", error["code"], error["detail"]},
                    {row[3], row[4]}});
  }
  return rows;
}

RowCounts Sweep::row_counts(std::uint64_t number, const PointOutcome& outcome) const {
  if (!refines() || outcome.failed()) {
    return {1, outcome.failed() ? 1U : 0U};
  }
  RowCounts counts;
  for (const SweepRow& row : rows_of(number, outcome)) {
    ++counts.rows;
    counts.failed += row.outcome.failed() ? 1 : 0;
  }
  return counts;
}

std::string Sweep::refinement_text() const {
  const SweepRefine& refine = *data_->refine;
  Json axes = Json::array();
  for (std::size_t i = data_->parameters.size() - static_cast<std::size_t>(refine.parameters);
       i < data_->parameters.size(); ++i) {
    const SweepRange& range = *data_->parameters[i].range;
    axes.push_back({range.from, range.to, range.count, range.first_parts, range.log});
  }
  return "refine" + Json{refine.output, refine.within, refine.most, std::move(axes)}.dump();
}

}  // namespace snapthrough::api
