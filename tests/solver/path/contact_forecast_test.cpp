#include "solver/path/contact_forecast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace snapthrough::testing {
namespace {

/// Zones of one foundation on one element, as functions of one unknown; no mechanics.
class Zones final : public EquilibriumProblem {
 public:
  using At = std::function<std::vector<MovingZone>(double)>;
  explicit Zones(At at) : at_(std::move(at)), metric_(Eigen::VectorXd::Ones(1)) {}

  [[nodiscard]] Eigen::Index size() const override { return 1; }
  [[nodiscard]] const Eigen::VectorXd& metric() const override { return metric_; }
  [[nodiscard]] MovingZones moving_zones(const Eigen::VectorXd& y, const Eigen::VectorXd&) const override {
    return {at_(y[0])};
  }
  [[nodiscard]] FrozenContact freeze(const MovingZones& zones, const Eigen::VectorXd&) const override {
    FrozenContact out;
    out.contacts.resize(1);
    for (const MovingZone& zone : zones[0]) out.contacts[0].push_back({zone.from, zone.to});
    return out;
  }
  void load(const Eigen::VectorXd&, double, Eigen::VectorXd&) override {}
  void solve(Eigen::Ref<Eigen::MatrixXd>) override {}
  [[nodiscard]] double relative_residual(const Eigen::VectorXd&, const Eigen::VectorXd&, double) override {
    return 0.0;
  }

 protected:
  void find_residual(const Eigen::VectorXd&, double, const Regime&, Eigen::VectorXd&) override {}
  TangentReport factorise(const Eigen::VectorXd&, double, const Regime&, Eigen::VectorXd&) override {
    return {};
  }
  [[nodiscard]] Eigen::MatrixXd find_products(const Eigen::VectorXd&, double, const Regime&,
                                              const Eigen::Ref<const Eigen::MatrixXd>& motions) override {
    return motions;
  }

 private:
  At at_;
  Eigen::VectorXd metric_;
};

Eigen::VectorXd at(double y) { return Eigen::VectorXd::Constant(1, y); }

/// Parts that are forecast a step beyond `now`, after one of length `chord` that ended there.
std::vector<ElementPart> forecast(const Zones& problem, double chord, double now, double step,
                                  double predicted) {
  ContactForecast forecast;
  const Eigen::VectorXd tangent = at(1.0);
  if (chord > 0.0) {
    forecast.begin(problem, at(now - chord), tangent);
    forecast.follow(chord);
  }
  forecast.begin(problem, at(now), tangent);
  return forecast.at(problem, step, at(predicted))->contacts[0];
}

TEST(ContactForecast, FirstStepGoesByRates) {
  const Zones problem([](double y) { return std::vector{MovingZone{0.0, 0.4 + 0.3 * y, 0.0, 0.3}}; });
  const auto parts = forecast(problem, 0.0, 0.0, 1.0, 1.0);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].from, 0.0);
  EXPECT_NEAR(parts[0].to, 0.7, 1e-15);
}

TEST(ContactForecast, AcceleratingEndIsAParabola) {
  const Zones problem([](double y) { return std::vector{MovingZone{0.0, 0.1 * y * y, 0.0, 0.2 * y}}; });
  EXPECT_NEAR(forecast(problem, 0.5, 1.0, 0.8, 1.8)[0].to, 0.1 * 1.8 * 1.8, 1e-15);
}

TEST(ContactForecast, EndThatSlowsDownIsAHyperbola) {
  const Zones problem([](double y) {
    return std::vector{MovingZone{0.0, y / (1.0 + y), 0.0, 1.0 / ((1.0 + y) * (1.0 + y))}};
  });
  EXPECT_NEAR(forecast(problem, 1.0, 1.0, 20.0, 21.0)[0].to, 21.0 / 22.0, 1e-14);
}

TEST(ContactForecast, ZoneThatWouldEndBeforeItBeginsIsGone) {
  const Zones problem([](double y) {
    return std::vector{MovingZone{0.0, 0.2, 0.0, 0.0}, MovingZone{0.5 + 0.1 * y, 0.7 - 0.1 * y, 0.1, -0.1}};
  });
  EXPECT_EQ(forecast(problem, 0.0, 0.0, 2.0, 0.0).size(), 1U);
}

TEST(ContactForecast, ZonesThatMeetAreOne) {
  const Zones problem([](double y) {
    return std::vector{MovingZone{0.0, 0.2 + 0.1 * y, 0.0, 0.1}, MovingZone{0.4 - 0.1 * y, 0.7, -0.1, 0.0}};
  });
  const auto parts = forecast(problem, 0.0, 0.0, 2.0, 0.0);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].from, 0.0);
  EXPECT_EQ(parts[0].to, 0.7);
}

/// A part that lands is taken from the predicted displacement; a known zone never is.
TEST(ContactForecast, OnlyWhatLandsIsTakenFromThePrediction) {
  const Zones problem([](double y) {
    std::vector<MovingZone> zones{{0.0, y < 1.0 ? 0.2 : 0.35, 0.0, 0.01}};
    if (y >= 1.0) zones.push_back({0.6, 0.7, 0.0, 0.0});
    return zones;
  });
  const auto parts = forecast(problem, 0.0, 0.0, 1.0, 1.0);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].to, 0.21, 1e-15);
  EXPECT_EQ(parts[1].from, 0.6);
  EXPECT_EQ(parts[1].to, 0.7);
}

TEST(ContactForecast, WhatIsForgottenIsNotUsed) {
  const Zones problem([](double y) { return std::vector{MovingZone{0.0, 0.1 * y * y, 0.0, 0.2 * y}}; });
  ContactForecast forecast;
  forecast.begin(problem, at(0.0), at(1.0));
  forecast.follow(1.0);
  forecast.forget();
  forecast.begin(problem, at(1.0), at(1.0));
  EXPECT_NEAR(forecast.at(problem, 1.0, at(2.0))->contacts[0][0].to, 0.3, 1e-15);
}

}  // namespace
}  // namespace snapthrough::testing
