#include "solver/column/column_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "solver/numeric/cancelled.h"

namespace snapthrough {
namespace {

/// Power series of the fundamental solution. Source: their remainder, which is below rounding.
struct FrameSeries {
  static constexpr int terms = 13;  ///< terms of each series
  /// Largest length of a piece times its characteristic exponent: the series then lose one digit at most.
  static constexpr double longest = 2.2;
};

/// 1 / (2 k + i)! in row i, column k.
constexpr auto inverse_factorials() {
  std::array<std::array<double, FrameSeries::terms>, 4> out{};
  double factorial = 1.0;
  for (int n = 0; n < 2 * FrameSeries::terms + 2; ++n) {
    if (n > 0) factorial *= n;
    for (int i = n % 2; i < 4; i += 2)
      if (const int k = (n - i) / 2; n >= i && k < FrameSeries::terms) out[i][k] = 1.0 / factorial;
  }
  return out;
}

/// Solution of w'''' + q w'' + r w = 0 with w = w' = w'' = 0, w''' = 1 at the start, and its derivatives.
struct Fundamental {
  double w, d1, d2, d3;
};

/// Evaluates the fundamental solution by power series, which stay accurate for equal or zero exponents.
Fundamental fundamental(double q, double r, double h) {
  const double Q = q * h * h;
  const double R = r * h * h * h * h;
  static constexpr auto inverses = inverse_factorials();
  std::array<double, 4> sum{};
  double before = 0.0;
  double now = 1.0;
  for (int k = 0; k < FrameSeries::terms; ++k) {
    for (int i = 0; i < 4; ++i) sum[i] += now * inverses[i][k];
    const double next = -Q * now - R * before;
    before = now;
    now = next;
  }
  return {h * h * h * sum[3], h * h * sum[2], h * sum[1], sum[0]};
}

/// Transfer matrix of a piece, with the quantities for counting eigenvalues.
struct Transfer {
  std::array<std::array<double, 4>, 4> t;
  double s1, s2, s3;

  Transfer(double q, double r, double EI, double h) {
    const Fundamental f = fundamental(q, r, h);
    s3 = f.w;
    s2 = f.d1;
    s1 = f.d2;
    const double s0 = f.d3;
    const double f0 = s0 + q * s2;
    const double f1 = s1 + q * s3;
    t = {{{f0, s1, -s3 / EI, s2 / EI},
          {-r * s3, s0, -s2 / EI, s1 / EI},
          {EI * r * f1, EI * r * s2, f0, r * s3},
          {-EI * r * s2, -EI * (q * s1 + r * s3), -s1, s0}}};
  }
};

double sign_of(double x) { return x < 0.0 ? -1.0 : 1.0; }

double largest_exponent(double q, double r) {
  const double d = 0.25 * q * q - r;
  return std::sqrt(d >= 0.0 ? 0.5 * std::abs(q) + std::sqrt(d) : std::sqrt(r));
}

double pieces_of(const ColumnSpan& span, double q) {
  return std::max(
      1.0, std::ceil(largest_exponent(q, span.foundation / span.EI) * span.length / FrameSeries::longest));
}

double coefficient_q(const ColumnSpan& span, double lambda) {
  return (span.constant + lambda * span.proportional - span.layer) / span.EI;
}

Matrix2 product(const Matrix2& a, const Matrix2& b) {
  Matrix2 out{};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) out[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
  return out;
}

/// Transfers a frame along the column and counts eigenvalues.
///
/// Joints are eliminated from left to right. The pivot A = S + K_11 of a joint (K: stiffness of the piece on
/// its right) has as many negative eigenvalues as U^T B^-1 U+, with U, U+ the displacement rows at the joint
/// and at the next one and B = -K_12^-1. Whether their number is one follows from the signs of det U and det
/// U+, each computed once; a sign lost to rounding shifts an eigenvalue to the next joint but does not change
/// the sum.
class Walk {
 public:
  Walk() { f_.rows = {{{1.0, 0.0}, {0.0, 1.0}, {0.0, 0.0}, {0.0, 0.0}}}; }

  void start(const ColumnJoint& joint) {
    put(joint.right);
    put_lateral(joint);
  }
  void pass(const ColumnJoint& joint) {
    put(joint.left);
    if (joint.hinge) release();
    put(joint.right);
    put_lateral(joint);
  }
  void advance(const Transfer& transfer);
  /// Orthonormalises the frame; returns the map from new to old coordinates.
  Matrix2 orthonormalise();
  void finish(const ColumnJoint& joint);

  [[nodiscard]] const ColumnFrame& frame() const { return f_; }
  [[nodiscard]] const ColumnCount& count() const { return count_; }
  /// Map from coordinates right of the last joint to those left of it.
  [[nodiscard]] const Matrix2& joint_map() const { return joint_map_; }
  /// Orthonormalises the frame after a joint.
  void settle_joint() { joint_map_ = product(joint_map_, orthonormalise()); }
  void forget_joint() { joint_map_ = {{{1.0, 0.0}, {0.0, 1.0}}}; }

 private:
  void put(const ColumnSide& side) {
    add_spring(1, side.spring);
    if (side.held) replace(1, 3);
  }
  void put_lateral(const ColumnJoint& joint) {
    add_spring(0, joint.spring);
    if (joint.held) replace(0, 2);
  }
  void add_spring(int row, double stiffness);
  void replace(int zero, int unit);
  void release();
  [[nodiscard]] double minor(int i, int j) const {
    return f_.rows[i][0] * f_.rows[j][1] - f_.rows[i][1] * f_.rows[j][0];
  }
  void multiply(double factor);

  ColumnFrame f_;
  double sign_ = 1.0;  ///< sign of det U
  ColumnCount count_;
  Matrix2 joint_map_{{{1.0, 0.0}, {0.0, 1.0}}};
};

/// Adds a spring after rotating one column to zero displacement in `row`: preserves digits for stiff springs.
void Walk::add_spring(int row, double stiffness) {
  if (stiffness == 0.0) return;
  const double size = std::hypot(f_.rows[row][0], f_.rows[row][1]);
  if (size == 0.0) return;
  const double a = f_.rows[row][1] / size;
  const double b = -f_.rows[row][0] / size;
  for (auto& r : f_.rows) r = {a * r[0] + b * r[1], a * r[1] - b * r[0]};
  f_.rows[row][0] = 0.0;
  f_.rows[row + 2][1] += stiffness * f_.rows[row][1];
  joint_map_ = product(joint_map_, {{{a, -b}, {b, a}}});
  settle_joint();
}

/// Replaces the frame by the combination with zero in row `zero`, and the unit vector of row `unit`.
void Walk::replace(int zero, int unit) {
  double a = f_.rows[zero][1];
  double b = -f_.rows[zero][0];
  const double size = std::hypot(a, b);
  multiply(size);
  if (size > 0.0) {
    a /= size;
    b /= size;
    // both columns have a zero there and span the unit vector, so that any other combination completes it
  } else {
    (std::abs(f_.rows[unit][0]) <= std::abs(f_.rows[unit][1]) ? a : b) = 1.0;
  }
  for (auto& row : f_.rows) row = {a * row[0] + b * row[1], 0.0};
  f_.rows[zero][0] = 0.0;
  f_.rows[unit][1] = 1.0;
  joint_map_ = {{{joint_map_[0][0] * a + joint_map_[0][1] * b, 0.0},
                 {joint_map_[1][0] * a + joint_map_[1][1] * b, 0.0}}};
}

/// Eliminates the rotation left of a hinge and starts the rotation right of it.
void Walk::release() {
  replace(3, 1);
  const double sign = sign_of(f_.rows[0][0]);
  if (sign != sign_) ++count_.negative;
  sign_ = sign;
}

void Walk::advance(const Transfer& transfer) {
  const ColumnFrame before = f_;
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 2; ++c)
      f_.rows[i][c] = transfer.t[i][0] * before.rows[0][c] + transfer.t[i][1] * before.rows[1][c] +
                      transfer.t[i][2] * before.rows[2][c] + transfer.t[i][3] * before.rows[3][c];
  const double sign = sign_of(minor(0, 1));
  if (sign != sign_) {
    ++count_.negative;
  } else {
    double trace = 0.0;
    for (int c = 0; c < 2; ++c)
      trace += before.rows[0][c] * (transfer.s1 * f_.rows[0][c] - transfer.s2 * f_.rows[1][c]) +
               before.rows[1][c] * (transfer.s2 * f_.rows[0][c] - transfer.s3 * f_.rows[1][c]);
    if (trace < 0.0) count_.negative += 2;
  }
  sign_ = sign;
}

void Walk::multiply(double factor) {
  WideNumber& d = count_.determinant;
  d.mantissa *= factor;
  if (const double size = std::abs(d.mantissa); size > 1e60 || size < 1e-60) {
    int exponent = 0;
    d.mantissa = std::frexp(d.mantissa, &exponent);
    d.exponent += exponent;
  }
}

Matrix2 Walk::orthonormalise() {
  auto& f = f_.rows;
  const auto norm = [&f](int c) {
    return std::sqrt(f[0][c] * f[0][c] + f[1][c] * f[1][c] + f[2][c] * f[2][c] + f[3][c] * f[3][c]);
  };
  const double first = norm(0);
  double along = 0.0;
  for (auto& row : f) {
    row[0] /= first;
    along += row[0] * row[1];
  }
  for (auto& row : f) row[1] -= along * row[0];
  const double second = norm(1);
  for (auto& row : f) row[1] /= second;
  multiply(first * second);
  return {{{1.0 / first, -along / (first * second)}, {0.0, 1.0 / second}}};
}

/// Counts the negative eigenvalues of the last joint's pivot in its free components.
void Walk::finish(const ColumnJoint& joint) {
  add_spring(1, joint.left.spring);
  add_spring(0, joint.spring);
  double last = 0.0;
  if (joint.held && joint.left.held) {
    multiply(minor(0, 1));
    return;
  }
  if (joint.held) {
    last = minor(0, 3);
  } else if (joint.left.held) {
    last = minor(2, 1);
  } else {
    last = minor(2, 3);
  }
  if (sign_of(last) != sign_) {
    ++count_.negative;
  } else if (!joint.held && !joint.left.held) {
    double trace = 0.0;
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 2; ++c) trace += f_.rows[i][c] * f_.rows[i + 2][c];
    if (trace < 0.0) count_.negative += 2;
  }
  multiply(last);
}

}  // namespace

double piece_count(const ColumnLine& line, double lambda) {
  double pieces = 0.0;
  for (const ColumnSpan& span : line.spans) pieces += pieces_of(span, coefficient_q(span, lambda));
  return pieces;
}

ColumnCount count_below(const ColumnLine& line, double lambda, bool cut_finer) {
  if (line.stop.stop_requested()) throw Cancelled{};
  Walk walk;
  walk.start(line.joints[0]);
  for (std::size_t i = 0; i < line.spans.size(); ++i) {
    const ColumnSpan& span = line.spans[i];
    if (i > 0) walk.pass(line.joints[i]);
    const double q = coefficient_q(span, lambda);
    const int pieces = static_cast<int>(pieces_of(span, q)) + (cut_finer ? 1 : 0);
    const Transfer transfer(q, span.foundation / span.EI, span.EI, span.length / pieces);
    for (int k = 0; k < pieces; ++k) {
      walk.advance(transfer);
      walk.orthonormalise();
    }
  }
  walk.finish(line.joints.back());
  return walk.count();
}

std::vector<ColumnPiece> pieces_at(const ColumnLine& line, double lambda) {
  std::vector<ColumnPiece> out;
  out.reserve(static_cast<std::size_t>(piece_count(line, lambda)));
  Walk walk;
  walk.start(line.joints[0]);
  for (std::size_t i = 0; i < line.spans.size(); ++i) {
    const ColumnSpan& span = line.spans[i];
    const double q = coefficient_q(span, lambda);
    const int pieces = static_cast<int>(pieces_of(span, q));
    const double h = span.length / pieces;
    const Transfer transfer(q, span.foundation / span.EI, span.EI, h);
    walk.forget_joint();
    if (i > 0) walk.pass(line.joints[i]);
    walk.settle_joint();
    for (int k = 0; k < pieces; ++k) {
      if (!out.empty()) out.back().end_from_next = walk.joint_map();
      walk.forget_joint();
      ColumnPiece piece{static_cast<int>(i), k * h, h,  q, span.foundation / span.EI, span.EI,
                        walk.frame(),        {},    {}, {}};
      walk.advance(transfer);
      piece.start_from_end = walk.orthonormalise();
      piece.end = walk.frame();
      out.push_back(piece);
    }
  }
  return out;
}

}  // namespace snapthrough
