#pragma once
/// @file
/// Small values for tests of the service: requests, results, a clock that is set by hand.

#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "api/result_fields.h"
#include "api/stored_fields.h"
#include "server/environment.h"
#include "server/jobs/job.h"
#include "server/store/store.h"
#include "solver/solve.h"

namespace snapthrough::server::test {

/// A clamped column under a tip load: valid, small.
inline std::string column_request(const std::string& title = "column") {
  return R"({"model": {"title": ")" + title + R"(",
  "nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 1, "y": 0}],
  "sections": [{"id": "s", "EA": 1e6, "EI": 1}],
  "members": [{"id": "m", "start": "a", "end": "b", "section": "s"}],
  "supports": [{"node": "a", "fixed": ["x", "y", "rotation"]}],
  "loads": [{"type": "point", "at": {"node": "b"}, "force": [-1, 0]}],
  "monitors": [{"id": "tip", "at": {"node": "b"}, "component": "y"}]},
 "analysis": {"type": "path", "discretization": {"elements": 4, "order": 2},
  "stop": {"steps": 20}}})";
}

/// A path that goes on for minutes on any machine.
inline std::string endless_request(const std::string& title = "endless") {
  nlohmann::json request = nlohmann::json::parse(column_request(title));
  request["analysis"] = {{"type", "path"},
                         {"discretization", {{"elements", 2000}, {"order", 5}}},
                         {"step", {{"initial", 1e-6}, {"max", 1e-6}}},
                         {"stop", {{"steps", 100'000}}},
                         {"output", {{"states", "none"}}}};
  return request.dump();
}

/// A sweep of that column over as many stiffnesses, 1, 2, 3, ...
inline std::string column_sweep(int points, const std::string& title = "column") {
  const std::string request = column_request(title);
  return request.substr(0, request.rfind('}')) + R"(,
 "parameters": [{"name": "EI", "targets": [{"pointer": "/model/sections/0/EI"}],
                 "range": {"from": 1, "to": )" +
         std::to_string(points) + R"(, "count": )" + std::to_string(points) + R"(}}],
 "design": "grid", "outputs": ["/summary/critical_load_factor", "/summary/termination"]})";
}

/// The critical load of that column, followed over as many stiffnesses.
inline std::string followed_sweep(int points, const std::string& title = "column") {
  nlohmann::json sweep = nlohmann::json::parse(column_sweep(points, title));
  sweep["analysis"] = {{"type", "critical"}, {"discretization", {{"elements", 4}, {"order", 2}}}};
  sweep["outputs"] = {"/summary/critical_load_factor", "/summary/critical_type"};
  sweep["follow"] = "EI";
  return sweep.dump();
}

inline Time at_second(int seconds) {
  return Time(std::chrono::hours(24 * 365 * 50) + std::chrono::seconds(seconds));
}

inline NewJob new_job(const std::string& id, int second = 0) {
  return {id, "a title", "path", R"({"model": 1})", at_second(second)};
}

/// Identifiers in order, of the right form.
inline std::string id_number(int number) {
  std::string digits = std::to_string(number);
  return "00000000-0000-7000-8000-" + std::string(12 - digits.size(), '0') + digits;
}

// Values that a text would lose, for whatever type a stored field has.
inline void fill(double& value) { value = 1.0 / 3.0; }
inline void fill(int& value) { value = 7; }
inline void fill(bool& value) { value = true; }
inline void fill(std::string& value) { value = "\"a\n\xc3\xa4"; }
inline void fill(std::vector<NamedValue>& values) { values = {{"crown", -1e-310}, {"tip", 1.0 / 3.0}}; }
inline void fill(std::vector<NamedSeries>& series) { series = {{"tip", {1.0 / 3.0, -1e300}}}; }
inline void fill(Frequencies& value) { value = {{1.0 / 3.0, -1e-310}, {0.0, 1e300}}; }
inline void fill(PathRates& value) {
  fill(value.load_factor.emplace_back());
  fill(value.monitors);
}
template <class T>
void fill(std::optional<T>& value) {
  fill(value.emplace());
}
template <class T>
void fill(std::vector<T>& values) {
  fill(values.emplace_back());
}
/// Fills the fields that stores keep without a column (kStored in api/result_fields.h).
template <class T>
void fill_stored_fields(T& object) {
  api::for_each_field<T>([&](const auto& field) {
    if constexpr (api::FieldOf<decltype(field)>::is(api::kStored)) fill(object.*field.get);
  });
}

/// The fields without a column of a whole path, a line for each branch and each critical point.
inline std::string stored_fields_of(const StoredPath& path) {
  std::string text;
  for (const Branch& branch : path.branches) text += api::stored_fields(branch).value_or("none") + "\n";
  for (const CriticalPoint& point : path.critical_points)
    text += api::stored_fields(point).value_or("none") + "\n";
  return text;
}

/// Two branches with every kind of series, numbers that a text would lose, three critical points.
inline JobResult sample_result() {
  JobResult result;
  result.document = R"({"summary": {"critical_load_factor": 66.2628}})";
  result.wall_time_s = 0.25;
  result.summary.critical_load_factor = 66.2628;
  result.summary.critical_type = CriticalType::bifurcation;
  result.summary.termination = "limit_points";
  Branch primary;
  primary.load_factor = {0.0, 0.1, 1.0 / 3.0, 66.2628, 1e-310};
  primary.arc_length = {0.0, 0.5, 1.0, 1.5, 2.0};
  primary.negative_eigenvalues = {0, 0, 0, 1, 2};
  primary.stiffness_ratio = {1.0, 0.5, std::nullopt, 0.0, -0.25};
  primary.monitors = {{"tip", {0.0, -0.1, -0.2, -0.3, -1e300}}, {"crown", {5, 4, 3, 2, 1}}};
  primary.contact_fraction = {{"soil", {1.0, 1.0, 0.5, 0.25, 0.0}}};
  Branch secondary;
  secondary.id = 1;
  secondary.parent = 0;
  result.branches = {primary, secondary};
  CriticalPoint point;
  point.load_factor = 66.2628;
  point.arc_length = 1.5;
  point.negative_before = 0;
  point.negative_after = 1;
  result.critical_points = {point, point, point};
  result.critical_points[1].type = CriticalType::limit_max;
  result.critical_points[1].error_estimate = 1e-5;
  result.critical_points[2].type = CriticalType::limit_min;
  result.critical_points[2].branch = 1;
  result.critical_points[2].multiplicity = 2;
  fill_stored_fields(result.branches[0]);
  fill_stored_fields(result.critical_points[1]);
  return result;
}

/// A clock and random numbers that tests set. Thread-safe.
struct FakeWorld {
  std::atomic<std::int64_t> microseconds = at_second(0).time_since_epoch().count();
  std::atomic<std::uint64_t> random = 0;

  /// Valid as long as this object.
  [[nodiscard]] Environment environment() {
    return {[this] { return Time(std::chrono::microseconds(microseconds)); },
            [this] { return static_cast<double>(microseconds) * 1e-6; }, [this] { return ++random; }};
  }
};

}  // namespace snapthrough::server::test
