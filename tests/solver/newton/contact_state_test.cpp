/// Equilibrium on one-sided supports from nothing known: each way to it, on bars whose answer is a closed
/// form.
#include "solver/newton/contact_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace snapthrough {
namespace {

/// Support at the end of each bar of a row: acts where its bar moves farther than the gap.
struct Stop {
  double stiffness = 1.0;
  double gap = 0.0;
};

/// Independent bars, each held by a spring (0: by nothing) and a stop that pushes back; forces lambda q.
class Bars final : public EquilibriumProblem {
 public:
  Bars(std::vector<double> springs, std::vector<Stop> stops, std::vector<double> forces)
      : springs_(std::move(springs)),
        stops_(std::move(stops)),
        forces_(Eigen::Map<Eigen::VectorXd>(forces.data(), static_cast<Eigen::Index>(forces.size()))),
        metric_(Eigen::VectorXd::Ones(forces_.size())),
        tangent_(metric_) {
    traits_.one_sided = true;
  }

  bool gripped = false;   ///< a grip was asked for
  bool softened = false;  ///< softer supports were

  [[nodiscard]] Eigen::Index size() const override { return forces_.size(); }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return metric_; }
  [[nodiscard]] const ModelTraits& traits() const override { return traits_; }
  void load(const Eigen::VectorXd&, double, Eigen::VectorXd& out) override { out = forces_; }
  void solve(Eigen::Ref<Eigen::MatrixXd> x) override {
    for (Eigen::Index i = 0; i < x.cols(); ++i) x.col(i) = x.col(i).cwiseQuotient(tangent_).eval();
  }
  [[nodiscard]] double relative_residual(const Eigen::VectorXd& f, const Eigen::VectorXd&,
                                         double lambda) override {
    return f.norm() / (std::abs(lambda) * forces_.norm());
  }

 protected:
  void find_residual(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                     Eigen::VectorXd& f) override {
    gripped = gripped || regime.grip > 0.0;
    softened = softened || regime.softness < 1.0;
    f.resize(size());
    for (Eigen::Index i = 0; i < size(); ++i) f[i] = force(regime, i, y[i]) - lambda * forces_[i];
  }
  TangentReport factorise(const Eigen::VectorXd& y, double lambda, const Regime& regime,
                          Eigen::VectorXd& f) override {
    find_residual(y, lambda, regime, f);
    for (Eigen::Index i = 0; i < size(); ++i) tangent_[i] = stiffness(regime, i, y[i]);
    return {0, tangent_.array().log().sum()};
  }
  [[nodiscard]] Eigen::MatrixXd find_products(const Eigen::VectorXd& y, double, const Regime& regime,
                                              const Eigen::Ref<const Eigen::MatrixXd>& motions) override {
    Eigen::MatrixXd out = motions;
    for (Eigen::Index i = 0; i < size(); ++i) out.row(i) *= stiffness(regime, i, y[i]);
    return out;
  }

 private:
  [[nodiscard]] const Stop& stop(Eigen::Index i) const { return stops_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double spring(Eigen::Index i) const { return springs_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] double force(const Regime& regime, Eigen::Index i, double y) const {
    const double k = regime.softness * stop(i).stiffness;
    if (regime.bilateral()) return (spring(i) + k) * y;
    return (spring(i) + regime.grip * k) * y + k * std::max(y - stop(i).gap, 0.0);
  }
  [[nodiscard]] double stiffness(const Regime& regime, Eigen::Index i, double y) const {
    const double k = regime.softness * stop(i).stiffness;
    return spring(i) + regime.grip * k + (regime.bilateral() || y > stop(i).gap ? k : 0.0);
  }

  ModelTraits traits_;
  std::vector<double> springs_;
  std::vector<Stop> stops_;
  Eigen::VectorXd forces_;
  Eigen::VectorXd metric_;
  Eigen::VectorXd tangent_;
};

/// What the search leaves: its answer is good to 1e-5 of its size, squared by the last correction.
constexpr double kTolerance = 1e-9;

struct Found {
  std::optional<ContactState> state;
  int factorisations = 0;
};

Found find(Bars& problem, double lambda, const Eigen::VectorXd* guess = nullptr) {
  const PathMetric metric{&problem.metric(), 0.0};
  Workspace work;
  Found out;
  out.state = find_contact_state(problem, metric, lambda, work, out.factorisations, guess);
  return out;
}

/// One bar leans on its stop, another leaves it.
TEST(ContactState, TellsWhichSupportsAct) {
  Bars problem({1.0, 2.0}, {{9.0, 0.0}, {1e6, 0.0}}, {1.0, -1.0});
  const Found found = find(problem, 0.1);
  ASSERT_TRUE(found.state);
  EXPECT_NEAR(found.state->y[0], 0.01, kTolerance * 0.01);
  EXPECT_NEAR(found.state->y[1], -0.05, kTolerance * 0.05);
  EXPECT_FALSE(problem.gripped || problem.softened) << "the response with bilateral supports is near enough";
}

/// Nothing holds the bar until its gap closes. On a bilateral support it moves by 0.002: beyond the first
/// gap, not to the others.
TEST(ContactState, ClosesAGapThatNothingHoldsUntilThen) {
  for (const double gap : {1e-3, 1.0, 30.0}) {
    Bars problem({0.0}, {{50.0, gap}}, {1.0});
    const Found found = find(problem, 0.1);
    ASSERT_TRUE(found.state) << gap;
    EXPECT_NEAR(found.state->y[0], gap + 0.002, kTolerance * (gap + 0.002));
    EXPECT_EQ(problem.gripped || problem.softened, gap > 0.002) << gap;
  }
}

/// A bar that is pulled off its stop and held by nothing has no equilibrium, and none is made up.
TEST(ContactState, HasNoneWhereNothingHolds) {
  Bars problem({0.0, 1.0}, {{50.0, 0.0}, {1.0, 0.0}}, {-1.0, 1.0});
  const Found found = find(problem, 0.1);
  EXPECT_FALSE(found.state);
  EXPECT_TRUE(problem.gripped) << "it gave up before it had tried all ways";
}

/// A guess that is right takes the place of everything else.
TEST(ContactState, BeginsWithTheGuess) {
  Bars problem({0.0}, {{50.0, 1.0}}, {1.0});
  const Eigen::VectorXd guess = Eigen::VectorXd::Constant(1, 1.0019);
  const Found near = find(problem, 0.1, &guess);
  ASSERT_TRUE(near.state);
  EXPECT_NEAR(near.state->y[0], 1.002, kTolerance);
  EXPECT_FALSE(problem.gripped || problem.softened);
  EXPECT_LE(near.factorisations, 3);
  // one that is wrong does no harm
  const Eigen::VectorXd wrong = Eigen::VectorXd::Constant(1, -5.0);
  const Found found = find(problem, 0.1, &wrong);
  ASSERT_TRUE(found.state);
  EXPECT_NEAR(found.state->y[0], 1.002, kTolerance);
}

/// The stiffness of the factorisation that is reported is that of the supports that act.
TEST(ContactState, ReportsTheTangentWithItsContact) {
  Bars problem({1.0, 2.0}, {{9.0, 0.0}, {1e6, 0.0}}, {1.0, -1.0});
  const Found found = find(problem, 0.1);
  ASSERT_TRUE(found.state);
  EXPECT_NEAR(found.state->tangent.log_abs_det, std::log(10.0 * 2.0), 1e-12);
}

}  // namespace
}  // namespace snapthrough
