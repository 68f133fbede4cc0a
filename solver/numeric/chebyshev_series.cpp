#include "solver/numeric/chebyshev_series.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>

namespace snapthrough {
namespace {

/// Row j: contribution of the value at point j to the coefficients.
using Transform = std::array<std::array<double, ChebyshevSeries::kMostPoints>, ChebyshevSeries::kMostPoints>;

Transform make_transform(int n) {
  const int last = n - 1;
  Transform out{};
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < n; ++k) {
      const double ends = (j == 0 || j == last ? 0.5 : 1.0) * (k == 0 || k == last ? 0.5 : 1.0);
      const double sign = k % 2 == 0 ? 1.0 : -1.0;  // because the points ascend
      out[j][k] = sign * ends * 2.0 / last * std::cos(std::numbers::pi * j * k / last);
    }
  }
  return out;
}

const Transform& transform_of(int n) {
  static const std::array<std::unique_ptr<Transform>, ChebyshevSeries::kMostPoints + 1> transforms = []() {
    std::array<std::unique_ptr<Transform>, ChebyshevSeries::kMostPoints + 1> all;
    for (int i = 2; i <= ChebyshevSeries::kMostPoints; ++i)
      all[i] = std::make_unique<Transform>(make_transform(i));
    return all;
  }();
  return *transforms[n];
}

}  // namespace

ChebyshevSeries::ChebyshevSeries(std::span<const double> values) : size_(static_cast<int>(values.size())) {
  const Transform& transform = transform_of(size_);
  for (int j = 0; j < size_; ++j)
    for (int k = 0; k < kMostPoints; ++k) coefficients_[k] += transform[j][k] * values[j];
  for (int k = size_ - 1; k > 0; --k)
    slopes_[k - 1] = (k + 1 < size_ ? slopes_[k + 1] : 0.0) + 4.0 * k * coefficients_[k];
  slopes_[0] *= 0.5;
}

}  // namespace snapthrough
