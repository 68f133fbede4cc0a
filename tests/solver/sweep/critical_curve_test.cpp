/// The first critical load followed in a number of the model, against the path of each value.

#include "solver/sweep/critical_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "solver/solve.h"
#include "tests/solver/sweep/arches.h"

namespace snapthrough {
namespace {

using namespace testing;

/// Two arches that have nothing to do with each other: the base of the second decides which one goes first.
Model two_arches(double k) {
  Model model = one_arch(0.02);
  add_arch(model, "other", 50.0, k);
  return model;
}

/// An arch that has no limit point while its base is stiff, and one with half the load, which has its own
/// later.
Model early_and_late(double k) {
  Model model = one_arch(k);
  add_arch(model, "late", 50.0, 0.0025, 0.5);
  return model;
}

CriticalCurveRequest request_for(Model (*model)(double), double from, double to, int count) {
  CriticalCurveRequest request;
  request.model = model;
  request.analysis.type = AnalysisType::critical;
  request.analysis.discretization.elements = 8;
  request.analysis.discretization.order = 4;
  request.analysis.discretization.fixed_mesh = true;
  request.logarithmic = true;
  for (int i = 0; i < count; ++i)
    request.values.push_back(from * std::pow(to / from, static_cast<double>(i) / (count - 1)));
  return request;
}

/// Both locate the point to 1e-9 of the load, and following adds at most 1e-8.
void expect_as_traced(const CriticalCurveRequest& request, const CriticalCurve& curve) {
  ASSERT_EQ(curve.points.size(), request.values.size());
  for (const CriticalCurvePoint& point : curve.points) {
    const Result traced = solve(request.model(point.value), request.analysis);
    ASSERT_TRUE(traced.summary.critical_load_factor && point.load_factor) << point.value;
    EXPECT_NEAR(*point.load_factor / *traced.summary.critical_load_factor, 1.0, 2e-8) << point.value;
    EXPECT_EQ(point.type, *traced.summary.critical_type) << point.value;
  }
}

TEST(CriticalCurve, IsThatOfThePathsAndCostsFewFactorisations) {
  const CriticalCurveRequest request = request_for(one_arch, 1e-3, 0.03, 40);
  const CriticalCurve curve = follow_critical_point(request);
  expect_as_traced(request, curve);
  EXPECT_GE(curve.followed, 38);
  EXPECT_EQ(curve.disagreed, 0);
  int factorizations = 0;
  for (const double value : request.values)
    factorizations += solve(request.model(value), request.analysis).diagnostics.factorizations;
  EXPECT_LT(3 * curve.factorizations, factorizations);
}

/// The same arch, pinned and loaded at its crown: it bifurcates sideways before its limit load.
Model crown_arch(double k) {
  Model model = one_arch(k);
  for (Support& support : model.supports) support.rotation = false;
  std::get<PointLoad>(model.loads[0]).at.fraction = 0.5;
  return model;
}

TEST(CriticalCurve, FollowsABifurcation) {
  const CriticalCurveRequest request = request_for(crown_arch, 1e-4, 0.03, 40);
  const CriticalCurve curve = follow_critical_point(request);
  EXPECT_EQ(curve.points.front().type, CriticalType::bifurcation);
  expect_as_traced(request, curve);
  EXPECT_GE(curve.followed, 36);
  EXPECT_EQ(curve.disagreed, 0);
}

/// A pinned column of length 10 on a Winkler base, whose critical shape has one
/// half wave until k L^4 / EI = 4 pi^4, k = 0.03896, and two beyond.
Model column_on_base(double k) {
  Model model;
  model.sections = {{"s", 1e6, 1.0, {}}};
  model.nodes = {{"foot", 0.0, 0.0}, {"head", 0.0, 10.0}};
  model.members.push_back({"column", "foot", "head", "s", LineCurve{}, false, false});
  for (const char* end : {"foot", "head"}) {
    Support support;
    support.node = end;
    support.x = true;
    support.y = support.node == "foot";
    model.supports.push_back(support);
  }
  PointLoad load;
  load.at = Location{};
  load.at.node = "head";
  load.force = {0.0, -1.0};
  model.loads.push_back(load);
  Foundation base;
  base.id = "base";
  base.member = "column";
  base.stiffness = k;
  model.foundations.push_back(base);
  return model;
}

TEST(CriticalCurve, FollowsTheBucklingOfAColumnOverAChangeOfMode) {
  const CriticalCurveRequest request = request_for(column_on_base, 2e-3, 0.2, 30);
  const CriticalCurve curve = follow_critical_point(request);
  expect_as_traced(request, curve);
  EXPECT_GE(curve.followed, 20);
}

TEST(CriticalCurve, NoticesThatAnotherPointComesFirst) {
  // Down: the first arch goes first until the base of the other is as soft as its own, 0.02.
  const CriticalCurveRequest request = request_for(two_arches, 0.2, 2e-3, 21);
  const CriticalCurve curve = follow_critical_point(request);
  expect_as_traced(request, curve);
  EXPECT_GT(curve.followed, 10);
}

TEST(CriticalCurve, NoticesItTheOtherWayToo) {
  // Up: the other arch goes first until its base is stiffer than 0.02; from there on the first one has lost
  // its stability before, which the inertia shows.
  const CriticalCurveRequest request = request_for(two_arches, 2e-3, 0.2, 21);
  const CriticalCurve curve = follow_critical_point(request);
  expect_as_traced(request, curve);
  EXPECT_GT(curve.followed, 15);
}

TEST(CriticalCurve, ChecksFindAnEarlierPointThatTheInertiaDoesNotShow) {
  // As the first base softens a maximum and a minimum of the load come up on its arch, one after the other
  // and before the other arch's limit point: the state shortly before that is stable again.
  const CriticalCurveRequest request = request_for(early_and_late, 0.06, 0.025, 9);
  const CriticalCurve curve = follow_critical_point(request);
  EXPECT_EQ(curve.disagreed, 1);
  EXPECT_GT(*curve.points.front().load_factor, *curve.points.back().load_factor * 1.3);
  expect_as_traced(request, curve);
}

TEST(CriticalCurve, DoesNotDependOnHowOftenItIsChecked) {
  CriticalCurveRequest request = request_for(one_arch, 1e-3, 0.03, 20);
  const CriticalCurve seldom = follow_critical_point(request);
  request.check_every = 5;
  const CriticalCurve often = follow_critical_point(request);
  EXPECT_GT(often.traced, seldom.traced);
  for (std::size_t i = 0; i < request.values.size(); ++i)
    EXPECT_EQ(*seldom.points[i].load_factor, *often.points[i].load_factor) << "bits, at value " << i;
}

TEST(CriticalCurve, BifurcationsBetweenPointsWithOwnFactorsAreAsAccurate) {
  // Failed once by 4e-6: the convergence at one value was taken for that at its neighbours.
  const CriticalCurveRequest request = request_for(pinned_shallow_arch, 0.42, 4.2, 25);
  const CriticalCurve curve = follow_critical_point(request);
  EXPECT_EQ(curve.points.front().type, CriticalType::bifurcation);
  expect_as_traced(request, curve);
  EXPECT_GE(curve.followed, 20);
}

TEST(CriticalCurve, SaysUpToWhichLoadAPathHasNone) {
  CriticalCurveRequest request = request_for(pinned_shallow_arch, 120.0, 300.0, 13);
  request.logarithmic = false;
  const CriticalCurve curve = follow_critical_point(request);
  ASSERT_EQ(curve.points.size(), 13U);
  for (const CriticalCurvePoint& point : curve.points) {
    const bool is_below_cusp = point.value < 254.153;
    EXPECT_EQ(point.failure, "");
    EXPECT_EQ(point.load_factor.has_value(), is_below_cusp) << point.value;
    EXPECT_EQ(point.none_up_to.has_value(), !is_below_cusp) << point.value;
    EXPECT_GT(point.none_up_to.value_or(100.0), 10.0) << point.value;
  }
  EXPECT_GE(curve.followed, 5);
}

TEST(CriticalCurve, RefusesWhatItCannotFollow) {
  CriticalCurveRequest request = request_for(one_arch, 1e-3, 1.0, 3);
  request.analysis.type = AnalysisType::path;
  EXPECT_THROW(static_cast<void>(follow_critical_point(request)), std::invalid_argument);
  request = request_for(one_arch, 1e-3, 1.0, 3);
  request.values.front() = -1.0;
  EXPECT_THROW(static_cast<void>(follow_critical_point(request)), std::invalid_argument);
  request.values.clear();
  EXPECT_THROW(static_cast<void>(follow_critical_point(request)), std::invalid_argument);
}

}  // namespace
}  // namespace snapthrough
