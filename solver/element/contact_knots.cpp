#include <algorithm>
#include <cmath>
#include <cstddef>

#include "solver/element/foundation_contact.h"
#include "solver/element/zone_search.h"
#include "solver/numeric/max_order.h"

namespace snapthrough {
namespace {

/// Number of a law along a member that counts as zero, over its largest value. Source: docs/decisions/0022.
constexpr double kVanishing = 1e-12;

}  // namespace

/// Stiffness, capacity and shape of a law at the samples. Where a number along the member vanishes, a very
/// small one stands for it, so that quotients exist.
void FoundationContact::laws_at_samples(std::array<Values, 3>& out) const {
  const double width = range_[1] - range_[0];
  for (int i = 0; i < samples_->count; ++i) {
    double stiffness = 1.0;
    double capacity = 1.0;
    if (foundation_law_.variation) {
      const double xi = range_[0] + samples_->z[i] * width;
      const double fraction = place_.from + xi * (place_.to - place_.from);
      stiffness = std::max(foundation_law_.variation->stiffness.at(fraction), kVanishing);
      capacity = std::max(foundation_law_.variation->capacity.at(fraction), kVanishing);
    }
    out[0][i] = law_.stiffness * stiffness;
    out[1][i] = law_.capacity * capacity;
    out[2][i] = law_.shape * stiffness / capacity;
  }
}

/// Appends the places at which the argument k w / P of the curve is sign times that of a knot, x: the roots
/// of k w - sign x P, which is smooth where P vanishes.
/// @param w penetrations, @param laws see laws_at_samples()
void FoundationContact::add_knot(int knot, double sign, const Values& w, const std::array<Values, 3>& laws,
                                 std::vector<KnotPlace>& out) const {
  const auto count = static_cast<std::ptrdiff_t>(samples_->count);
  const double width = range_[1] - range_[0];
  Values beyond;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    beyond[i] = laws[0][i] * w[i] - sign * law_.curve->knot(knot, laws[2][i]).x * laws[1][i];
  const SampledGap gap(std::span<const double>(beyond).first(count));
  std::vector<Interval> above;
  search_zones(gap, samples_->z, beyond, samples_->count, range_, above);
  const auto add = [&](double xi) {
    if (xi == range_[0] || xi == range_[1]) return;
    const Law law = law_at(xi);
    if (!(law.stiffness > 0.0)) return;
    out.push_back({xi, sign * law.stiffness * law_.curve->knot(knot, law.shape).slope_change,
                   gap.slope((xi - range_[0]) / width) / (width * law.stiffness)});
  };
  for (const Interval& part : above) {
    add(part.from);
    add(part.to);
  }
}

/// Appends the places at which numbers of the law bend, for fixed meshes whose elements do not end there.
void FoundationContact::add_bends(std::vector<KnotPlace>& out) const {
  if (!foundation_law_.variation) return;
  for (const AlongMember* value :
       {&foundation_law_.variation->stiffness, &foundation_law_.variation->capacity}) {
    for (const auto& [fraction, unused] : value->points) {
      const double xi = (fraction - place_.from) / (place_.to - place_.from);
      if (xi > range_[0] && xi < range_[1]) out.push_back({xi, 0.0, 1.0});
    }
  }
}

/// Distance of the moved axis ahead of a seam, along the surface; on the range scaled to [0, 1].
class AheadOfSeam {
 public:
  AheadOfSeam(const FoundationContact& contact, std::array<double, 2> ua, std::span<const double> dx,
              std::span<const double> dy, const SurfaceSeam& seam)
      : contact_(contact), ua_(ua), dx_(dx), dy_(dy), seam_(seam) {}

  [[nodiscard]] double value(double z) const {
    const double xi = at(z);
    const auto x = contact_.place_at(xi).x;
    const auto u = contact_.displacement(xi, ua_, dx_, dy_);
    return (x[0] + u[0] - seam_.x[0]) * seam_.tangent[0] + (x[1] + u[1] - seam_.x[1]) * seam_.tangent[1];
  }
  [[nodiscard]] double slope(double z) const {
    const double xi = at(z);
    std::array<double, kMaxOrder> l{};
    contact_.rule_->values_at(xi, std::span(l).first(dx_.size()));
    const auto du = FoundationContact::combined({0.0, 0.0}, l, dx_, dy_);
    const double angle = contact_.place_at(xi).angle;
    const double length = contact_.place_.length;
    return (contact_.range_[1] - contact_.range_[0]) *
           ((length * std::cos(angle) + du[0]) * seam_.tangent[0] +
            (length * std::sin(angle) + du[1]) * seam_.tangent[1]);
  }
  [[nodiscard]] Eigen::Array4d values(const Eigen::Array4d& z) const {
    return {value(z[0]), value(z[1]), value(z[2]), value(z[3])};
  }

 private:
  [[nodiscard]] double at(double z) const {
    return contact_.range_[0] + z * (contact_.range_[1] - contact_.range_[0]);
  }

  const FoundationContact& contact_;
  std::array<double, 2> ua_;
  std::span<const double> dx_, dy_;
  const SurfaceSeam& seam_;
};

/// Appends the places at which the axis passes a seam of the surface. The stiffness normal to the surface
/// does not change there.
void FoundationContact::add_seams(std::array<double, 2> ua, std::span<const double> dx,
                                  std::span<const double> dy, std::vector<KnotPlace>& out) const {
  std::vector<Interval> ahead;
  for (const SurfaceSeam& seam : foundation_law_.surface->seams()) {
    const AheadOfSeam gap(*this, ua, dx, dy, seam);
    Values g;
    for (int i = 0; i < samples_->count; ++i) g[i] = gap.value(samples_->z[i]);
    ahead.clear();
    search_zones(gap, samples_->z, g, samples_->count, range_, ahead);
    const double width = range_[1] - range_[0];
    for (const Interval& part : ahead) {
      for (const double xi : {part.from, part.to}) {
        if (xi == range_[0] || xi == range_[1]) continue;
        const SurfacePoint at = penetration_at(xi, displacement(xi, ua, dx, dy));
        const double turn = at.into[0] * seam.tangent[1] - at.into[1] * seam.tangent[0];
        out.push_back({xi, 0.0, gap.slope((xi - range_[0]) / width) / width,
                       std::copysign(1.0, turn) * seam.bend_change(at.depth)});
      }
    }
  }
}

void FoundationContact::knot_places(std::array<double, 2> ua, std::span<const double> dx,
                                    std::span<const double> dy, std::vector<KnotPlace>& out) const {
  out.clear();
  if (follows_surface()) add_seams(ua, dx, dy, out);
  if (law_.curve != nullptr) add_law_knots(ua, dx, dy, out);
  std::sort(out.begin(), out.end(), [](const KnotPlace& a, const KnotPlace& b) { return a.xi < b.xi; });
}

void FoundationContact::add_law_knots(std::array<double, 2> ua, std::span<const double> dx,
                                      std::span<const double> dy, std::vector<KnotPlace>& out) const {
  add_bends(out);
  Values w;
  Values x;
  std::array<Values, 3> laws;
  penetrations(ua, dx, dy, 0.0, w);
  laws_at_samples(laws);
  for (int i = 0; i < samples_->count; ++i) x[i] = laws[0][i] * w[i] / laws[1][i];
  const auto [least, most] = std::minmax_element(x.begin(), x.begin() + samples_->count);
  const auto ends = std::minmax_element(laws[2].begin(), laws[2].begin() + samples_->count);
  const std::array<double, 2> shapes{*ends.first, *ends.second};
  const auto places = [&](int k) {
    return std::array{law_.curve->knot(k, shapes[0]).x, law_.curve->knot(k, shapes[1]).x};
  };
  const int knots = law_.curve->knot_count();
  for (int k = 0; k < knots; ++k) {
    const auto at = places(k);
    if (k + 1 < knots && places(k + 1) == at) continue;  // one place, of which the last knot has the change
    const double low = std::min(at[0], at[1]);
    const double high = std::max(at[0], at[1]);
    if (high >= *least && low <= *most) add_knot(k, 1.0, w, laws, out);
    if (!law_.one_sided && high > 0.0 && -low >= *least && -high <= *most) add_knot(k, -1.0, w, laws, out);
  }
}

}  // namespace snapthrough
