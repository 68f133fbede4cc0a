#pragma once
/// @file
/// Bending laws of sections in ElementWorkOf: what they add to a curvature that is compliance times moment.
/// Included by element_work.h only.

namespace snapthrough {

/// Curve of an element's bending law at Gauss point q; the line through the origin that a regime asks for.
template <int P>
BendingCurve::Values ElementWorkOf<P>::bending_at(const Shape& shape, const ElementDofs& dofs, int q,
                                                  const double* y) const {
  const int at = dofs.s + 2 * P + q;
  const Eigen::VectorXd* linearised_at = regime_.linearised_at();
  if (linearised_at == nullptr) return shape.bending->at(y[at]);
  const double slope = shape.bending->at((*linearised_at)[at]).slope;
  return {slope * y[at], slope, 0.0};
}

template <int P>
void ElementWorkOf<P>::add_bending_residual(const Shape& shape, const ElementDofs& dofs, const double* y,
                                            double* residual) const {
  for (int q = 0; q < P; ++q) {
    const int at = dofs.s + 2 * P + q;
    residual[at] +=
        shape.hb[q] * shape.compliance[2 * P + q] * (y[at] - bending_at(shape, dofs, q, y).moment);
  }
}

template <int P>
void ElementWorkOf<P>::add_bending_product(const Shape& shape, const ElementDofs& dofs, const double* y,
                                           const double* direction, double* out) const {
  for (int q = 0; q < P; ++q) {
    const int at = dofs.s + 2 * P + q;
    const double less = 1.0 - bending_at(shape, dofs, q, y).slope;
    out[at] += shape.hb[q] * shape.compliance[2 * P + q] * less * direction[at];
  }
}

/// Adds the derivative of add_bending_product() along `along`.
template <int P>
void ElementWorkOf<P>::add_bending_rate(const Shape& shape, const ElementDofs& dofs, const double* y,
                                        const double* along, const double* direction, double* out) const {
  for (int q = 0; q < P; ++q) {
    const int at = dofs.s + 2 * P + q;
    const double second = bending_at(shape, dofs, q, y).second;
    out[at] -= shape.hb[q] * shape.compliance[2 * P + q] * second * along[at] * direction[at];
  }
}

/// Square roots of the compliances of an element with a bending law at a state.
template <int P>
auto ElementWorkOf<P>::roots_at(int element, const double* y) -> const std::array<double, kStrains>& {
  const Shape& shape = shapes_[element];
  std::array<double, kStrains>& out = roots_[element];
  out = shape.root;
  for (int q = 0; q < P; ++q) out[2 * P + q] *= std::sqrt(bending_at(shape, dofs_[element], q, y).slope);
  return out;
}

}  // namespace snapthrough
