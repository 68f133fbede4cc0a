#pragma once
/// @file
/// Documents that figures are made of, computed from the examples.

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "api/api.h"
#include "solver/solve.h"

namespace snapthrough::testing {

inline nlohmann::json example_request(const std::string& name) {
  std::ifstream file(std::string(SNAPTHROUGH_SOURCE_DIR) + "/examples/" + name + ".json");
  return nlohmann::json::parse(file);
}

/// The result document of a request.
inline nlohmann::json solved(const nlohmann::json& request) {
  const api::ReadOutcome outcome = api::read_request(request.dump());
  if (!outcome.request) {
    throw std::runtime_error("the request cannot be run");
  }
  const Result result = solve(outcome.request->model, outcome.request->analysis);
  return api::write_result(*outcome.request, result, 0.0);
}

inline nlohmann::json solved_example(const std::string& name) { return solved(example_request(name)); }

/// A table over k (1, 10, 100, 1000) and t (0.1, 0.2, 0.3): the output is k t. The point (10, 0.2) failed,
/// (100, 0.3) has no value.
inline nlohmann::json table_of_two() {
  nlohmann::json table = {{"columns", {"k", "t", "/summary/critical_load_factor", "error"}},
                          {"rows", nlohmann::json::array()},
                          {"points", nlohmann::json::array()}};
  for (const double k : {1.0, 10.0, 100.0, 1000.0}) {
    for (const double t : {0.1, 0.2, 0.3}) {
      const bool failed = k == 10 && t == 0.2;
      const bool none = failed || (k == 100 && t == 0.3);
      const nlohmann::json error = {{"code", "no_start"}, {"detail", "no equilibrium & more"}};
      table["points"].push_back(table["rows"].size());
      table["rows"].push_back(
          {k, t, none ? nlohmann::json() : nlohmann::json(k * t), failed ? error : nlohmann::json()});
    }
  }
  return table;
}

}  // namespace snapthrough::testing
