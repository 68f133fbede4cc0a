/// Curves of critical points of a shallow arch over its bending stiffness, against collocation of the beam's
/// differential equation (data/arch_critical_locus.py), which shares no code with the solver.

#include "solver/sweep/critical_locus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "reference_table.h"
#include "tests/solver/sweep/arches.h"

namespace snapthrough {
namespace {

using namespace testing;

CriticalLocusRequest request_on(int elements, int order) {
  CriticalLocusRequest request;
  request.model = pinned_shallow_arch;
  request.analysis.type = AnalysisType::critical;
  request.analysis.discretization.elements = elements;
  request.analysis.discretization.order = order;
  request.analysis.discretization.fixed_mesh = true;
  request.values = {25.0, 40.0, 80.0, 120.0, 160.0, 200.0, 240.0, 280.0};
  return request;
}

const LocusCurve* curve_of(const CriticalLocus& locus, bool bifurcation) {
  const auto found =
      std::find_if(locus.curves.begin(), locus.curves.end(),
                   [bifurcation](const LocusCurve& curve) { return curve.bifurcation == bifurcation; });
  return found == locus.curves.end() ? nullptr : &*found;
}

std::vector<LocusEvent> events_of(const LocusCurve& curve, LocusEventType type) {
  std::vector<LocusEvent> out;
  std::copy_if(curve.events.begin(), curve.events.end(), std::back_inserter(out),
               [type](const LocusEvent& event) { return event.type == type; });
  return out;
}

std::vector<TableRow> rows_of(const Table& table, const std::string& kind) {
  std::vector<TableRow> out;
  for (const TableRow& row : table.rows())
    if (row.text("kind") == kind) out.push_back(row);
  return out;
}

/// The wanted accuracy, on two meshes.
constexpr double kAccuracy = 1e-7;

class ArchLocus : public ::testing::TestWithParam<std::pair<int, int>> {
 protected:
  const CriticalLocus locus_ = follow_critical_locus(request_on(GetParam().first, GetParam().second));
  const Table table_{"arch_critical_locus.csv"};
};

TEST_P(ArchLocus, FoldsMeetInTheCuspOfTheDifferentialEquation) {
  ASSERT_EQ(locus_.failure, "");
  const LocusCurve* folds = curve_of(locus_, false);
  ASSERT_NE(folds, nullptr);
  const auto cusps = events_of(*folds, LocusEventType::cusp);
  const auto rows = rows_of(table_, "cusp");
  ASSERT_EQ(rows.size(), 1U);
  ASSERT_EQ(cusps.size(), 1U);
  EXPECT_NEAR(cusps[0].value / rows[0].number("EI"), 1.0, kAccuracy);
  EXPECT_NEAR(cusps[0].load_factor / rows[0].number("P"), 1.0, kAccuracy);
  EXPECT_EQ(folds->end, LocusEnd::first_value);
}

TEST_P(ArchLocus, HasBothFoldsOfEachValue) {
  const LocusCurve* folds = curve_of(locus_, false);
  ASSERT_NE(folds, nullptr);
  const auto rows = rows_of(table_, "fold");
  ASSERT_EQ(rows.size(), 12U);
  const std::vector<double> values = request_on(8, 5).values;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const CriticalType type = i % 2 == 0 ? CriticalType::limit_max : CriticalType::limit_min;
    const auto load = std::find_if(folds->loads.begin(), folds->loads.end(), [&](const LocusLoad& at) {
      return values[at.value] == rows[i].number("EI") && at.type == type;
    });
    ASSERT_NE(load, folds->loads.end()) << rows[i].text("EI");
    EXPECT_NEAR(load->load_factor / rows[i].number("P"), 1.0, kAccuracy) << rows[i].text("EI");
  }
  // both folds at seven values, none beyond the cusp
  EXPECT_EQ(folds->loads.size(), 14U);
}

TEST_P(ArchLocus, FoldsMeetTheBifurcationsOfTheDifferentialEquation) {
  const auto rows = rows_of(table_, "fold_bifurcation");
  ASSERT_EQ(rows.size(), 2U);
  for (const bool bifurcation : {false, true}) {
    const LocusCurve* curve = curve_of(locus_, bifurcation);
    ASSERT_NE(curve, nullptr);
    const auto meetings = events_of(*curve, LocusEventType::fold_bifurcation);
    ASSERT_EQ(meetings.size(), 2U) << bifurcation;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(meetings[i].value / rows[i].number("EI"), 1.0, kAccuracy) << bifurcation;
      EXPECT_NEAR(meetings[i].load_factor / rows[i].number("P"), 1.0, kAccuracy) << bifurcation;
    }
  }
}

TEST_P(ArchLocus, SaysUpToWhichLoadThereIsNoCriticalPointBeyondTheCusp) {
  EXPECT_EQ(locus_.curves.size(), 2U);
  ASSERT_EQ(locus_.none_up_to.size(), 8U);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_FALSE(locus_.none_up_to[i]) << i;
  ASSERT_TRUE(locus_.none_up_to[7]);
  EXPECT_GT(*locus_.none_up_to[7], 100.0);
}

INSTANTIATE_TEST_SUITE_P(Meshes, ArchLocus, ::testing::Values(std::pair(8, 5), std::pair(16, 6)));

}  // namespace
}  // namespace snapthrough
