/// Figures 4.6 to 4.9 as one sweep (examples/sweeps/columns_with_one_spring.json): four pairs of ends, 21
/// places of a lateral spring, 101 stiffnesses, 8484 points. Its points are those of the document that have
/// an exact value.
///
/// Source: tests/verification/data/column_discrete_spring_gamma.csv (exact transfer matrix, twelve digits
/// printed). Tolerance 1e-11: these digits.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "api/point_outcome.h"
#include "api/sweep.h"
#include "solver/solve.h"
#include "tests/verification/cases.h"
#include "tests/verification/reference_table.h"

namespace snapthrough {
namespace {

using namespace testing;

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A point of the sweep solved as a request of its own.
double load_of(const api::Sweep& sweep, std::uint64_t point) {
  const api::ReadOutcome read = api::read_request_document(sweep.document_at(point));
  EXPECT_TRUE(read.request);
  const Result result = solve(read.request->model, read.request->analysis);
  const api::PointOutcome outcome = sweep.outcome(api::write_result(*read.request, result, 0.0));
  EXPECT_FALSE(outcome.failed()) << outcome.detail;
  return nlohmann::json::parse(outcome.outputs).at(0).get<double>();
}

TEST(Thesis431, OneSweepOfFourFiguresMeetsTheExactValues) {
  const api::SweepOutcome read =
      api::read_sweep(text_of(SNAPTHROUGH_SOURCE_DIR "/examples/sweeps/columns_with_one_spring.json"));
  ASSERT_TRUE(read.sweep) << read.findings.front().pointer << ": " << read.findings.front().detail;
  ASSERT_EQ(read.sweep->size(), 4U * 21U * 101U);
  const std::vector<std::string> ends{"PP", "CF", "CP", "CC"};
  const Table table("column_discrete_spring_gamma.csv");
  int values = 0;
  for (const TableRow& row : table.rows()) {
    const double place = row.number("c_b") * 20.0;
    const double stiffness = row.number("kx") / 10.0;
    const bool in_sweep = stiffness == std::floor(stiffness) && stiffness <= 100.0;
    if (!in_sweep || std::abs(place - std::round(place)) > 1e-9) continue;
    const auto which =
        static_cast<std::uint64_t>(std::find(ends.begin(), ends.end(), row.text("bc")) - ends.begin());
    const std::uint64_t point = (which * 21 + static_cast<std::uint64_t>(std::lround(place))) * 101 +
                                static_cast<std::uint64_t>(stiffness);
    expect_relative(load_of(*read.sweep, point), row.number("Gamma"), 1e-11,
                    row.text("bc") + " c_b " + row.text("c_b") + " kx " + row.text("kx"));
    ++values;
  }
  EXPECT_EQ(values, 4 * 11 * 7);
}

}  // namespace
}  // namespace snapthrough
