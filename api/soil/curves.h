#pragma once
/// @file
/// Soil reaction curves at one place of a pile: p-y, m-psi, t-z, q-z, base shear and base moment.
///
/// Each curve is a pure function of a soil's parameters and of a place. X is the depth below the surface, D
/// the diameter, s the vertical effective stress at X, y a displacement and p a force per length. All numbers
/// are in one consistent set of units; LiquefiedSand alone needs to know which.
///
/// A source is called primary where its own text was read, and secondary where another text or program that
/// quotes it was read.

#include <array>
#include <variant>
#include <vector>

#include "api/soil/profile.h"

namespace snapthrough::api::soil {

/// Accepted dimensionless parameters; both ends are allowed. Every other parameter is positive and finite,
/// unless its description allows zero.
inline constexpr double kLeastEps50 = 1e-4;
inline constexpr double kLargestEps50 = 0.2;
inline constexpr double kLeastJ = 0.0;
inline constexpr double kLargestJ = 2.0;
inline constexpr double kLeastFirstPoint = 0.0;  ///< y/y50
inline constexpr double kLargestFirstPoint = 1.0;
inline constexpr double kLeastCycles = 1.0;
inline constexpr double kLargestCycles = 1e6;
inline constexpr double kLeastRqd = 0.0;  ///< percent
inline constexpr double kLargestRqd = 100.0;
inline constexpr double kLeastKrm = 1e-6;  ///< the source's range is 0.00005 to 0.0005
inline constexpr double kLargestKrm = 1e-2;
inline constexpr double kLeastRelativeDensity = 0.0;  ///< the source's range is 0.45 to 0.9
inline constexpr double kLargestRelativeDensity = 1.0;
inline constexpr double kLeastResidual = 0.0;  ///< the source's range is 0.7 to 0.9
inline constexpr double kLargestResidual = 1.0;

/// What a curve needs to know about its place.
struct Place {
  double depth = 0.0;            ///< X >= 0
  double stress = 0.0;           ///< s >= 0
  double diameter = 0.0;         ///< outer diameter D
  double embedded_length = 0.0;  ///< depth L of the pile's tip; only the curves of PISA depend on it
  double layer_top = 0.0;        ///< depth of the surface of the rock, <= depth; only WeakRock depends on it
  Loading loading = Loading::static_;
};

/// @brief Reaction against displacement: straight lines from the origin through the points, constant beyond
/// the last.
///
/// Displacements ascend strictly from 0, forces are >= 0, and the force at 0 is 0. Forces may fall behind the
/// largest. Kinks of the formula are points. All other points lie on the formula, so close that the lines
/// differ from it by at most `accuracy` times the largest force. (0, 0) is the only point where the place
/// gives no resistance.
struct Curve {
  std::vector<std::array<double, 2>> points;  ///< (displacement, force)

  [[nodiscard]] bool has_resistance() const { return points.size() > 1; }
};

/// Beginning of the curve of soft clay. The cube root starts vertically.
enum class SoftClayStart {
  formula,  ///< the cube root from `first_point` on, a straight line up to there
  /// Straight lines through the rounded points (y/y50, p/Pmax) of API RP 2GEO: (0.1, 0.23), (0.3, 0.33),
  /// (1, 0.5), (3, 0.72), (8, 1).
  api_points
};

/// @brief Soft clay under water.
///
///   Pmax = min((3 Su + s) D + J Su X, 9 Su D),  y50 = 2.5 eps50 D
///   static: p/Pmax = 0.5 (y/y50)^(1/3), at most 1
///   cyclic: p/Pmax = 0.5 (y/y50)^(1/3), at most 0.72; where X < X_R it falls from 0.72 at 3 y50 linearly to
///           0.72 X/X_R at 15 y50
/// X_R is the depth of transition of a homogeneous clay with this Su and the mean unit weight s/X, thus
/// X/X_R = (s D + J Su X) / (6 Su D).
///
/// Source: H. Matlock, Correlations for design of laterally loaded piles in soft clay, OTC 1204, 1970;
/// secondary, read in the documentation of OpenBrIM and of openpile, where API RP 2GEO's points are, too.
struct SoftClayMatlock {
  double Su = 0.0;     ///< undrained shear strength at the place; 0 is allowed
  double eps50 = 0.0;  ///< strain at half the strength in an undrained compression test
  double J = 0.0;      ///< dimensionless, 0.5 for soft and 0.25 for medium clay
  SoftClayStart start = SoftClayStart::formula;
  double first_point = 0.1;  ///< y/y50 at the end of the first line of `formula`; API: 0.1; 0: no such line
};

/// @brief Stiff clay under water that reaches the pile, which softens.
///
///   pc = min((2 c + s) D + 2.83 c X, 11 Su D),  y50 = eps50 D,  c = mean strength from the surface to X
///   static, with A = 0.2 + 0.4 tanh(0.62 X/D) and r = y/y50:
///     r <= A         0.5 pc sqrt(r)
///     r <= 6 A       0.5 pc sqrt(r) - 0.055 pc ((r - A)/A)^1.25
///     r <= 18 A      falls by 0.0625 pc for each y50, constant beyond
///   cyclic, with A = 0.2 + 0.1 tanh(1.5 X/D) and yp = 4.1 A y50:
///     y <= 0.6 yp    A pc (1 - |y/(0.45 yp) - 1|^2.5)
///     y <= 1.8 yp    falls by 0.085 pc for each y50, constant beyond
/// and nowhere above the line p = k X y that begins the curve. Near the surface the last static value would
/// be negative and is 0.
///
/// Source: L. C. Reese, W. R. Cox, F. D. Koop, Field testing and analysis of laterally loaded piles in stiff
/// clay, OTC 2312, 1975; secondary, read in the documentation of OpenBrIM and in the sources of OpenSees. The
/// paper gives A in a figure; the two formulas for A differ from another program's reading of it by at most
/// 0.05.
struct StiffClayFreeWater {
  double Su = 0.0;       ///< undrained shear strength at the place
  double Su_mean = 0.0;  ///< mean of Su from the surface to the place
  double eps50 = 0.0;    ///< strain at half the strength
  double k = 0.0;        ///< initial modulus, force/length^3; less for cyclic than for static loads
};

/// @brief Stiff clay without free water.
///
///   Pmax = min((3 c + s) D + J c X, 9 Su D),  y50 = 2.5 eps50 D,  c = mean strength from the surface to X
///   p/Pmax = (y / (e y50))^(1/4), at most 1, where e = 16, under N cycles e = 16 + 9.6 log10(N)
/// The source adds y50 9.6 (p/Pmax)^4 log10(N) to the static displacement, which is the same. The fourth root
/// starts vertically: without `first_point` the first line of the curve follows from the accuracy alone.
///
/// Source: R. C. Welch, L. C. Reese, Laterally loaded behavior of drilled shafts, Research Report 89-10,
/// University of Texas, 1972; secondary, read in the documentation of OpenBrIM and in open programs.
struct StiffClay {
  double Su = 0.0;       ///< undrained shear strength at the place
  double Su_mean = 0.0;  ///< mean of Su from the surface to the place
  double eps50 = 0.0;    ///< strain at half the strength
  double J = 0.0;        ///< dimensionless, 0.5
  double cycles = 1.0;   ///< N; ignored under static loading
  /// y/y50 at the end of a first straight line, where static p = 0.05 Pmax by default; 0: no such line.
  double first_point = 1e-4;
};

/// @brief Sand.
///
///   ps = min((C1 X + C2 D) s, C3 D s), with the coefficients that sand_coefficients() gives
///   pu = A ps at yu = 3 D/80, constant beyond;  pm = B ps at ym = D/60, a line from there to yu
///   p = pm (y/ym)^(1/n) up to ym, with the slope of that line at ym: 1/n = (pu/pm - 1) ym / (yu - ym)
/// and nowhere above the line p = k X y that begins the curve. A and B depend on X/D and on the loading.
///
/// Source: L. C. Reese, W. R. Cox, F. D. Koop, Analysis of laterally loaded piles in sand, OTC 2080, 1974;
/// secondary, read in the documentation of OpenBrIM. A and B are figures of the source; their values are
/// readings of the figures of FHWA-SA-91-048 (1993) in a public program, good to some 0.05.
struct ReeseSand {
  double phi = 0.0;  ///< friction angle in degrees, from kLeastPhi to kLargestPhi
  double k = 0.0;    ///< initial modulus of subgrade reaction, force/length^3
};

/// @brief Shape of PISA's curves: a conic from (0, 0) with slope k to (x_u, y_u), constant beyond.
///
///   -n (y/y_u - x/x_u)^2 + (1 - n) (y/y_u - k x/y_u) (y/y_u - 1) = 0
/// n = 0 gives two straight lines, n = 1 one. n beyond 0 or 1 counts as 0 or 1, and k less than y_u/x_u as
/// y_u/x_u. There is no resistance unless x_u > 0 and y_u > 0.
struct Conic {
  double k = 0.0, n = 0.0, x_u = 0.0, y_u = 0.0;
};

/// Returns y of a conic at x >= 0. @pre x_u > 0, y_u > 0
[[nodiscard]] double conic_value(const Conic& conic, double x);
/// @brief Returns the curve (x_scale x, y_scale y) of a conic.
/// @param x_scale, y_scale positive; y_scale may be 0
[[nodiscard]] Curve conic_curve(const Conic& conic, double x_scale, double y_scale, double accuracy);

/// @brief Stiff clay of PISA, calibrated with piles in glacial till at Cowden, for L/D from 2 to 6 and
/// monotonic loading.
///
/// Conics of p/(Su D) and H/(Su D^2) over y G0/(Su D), and of m/(Su D^2) and M/(Su D^3) over psi G0/Su:
///   p    k = 10.6 - 1.65 X/D, n = 0.939 - 0.03345 X/D, x_u = 241.4, y_u = 10.7 - 7.101 exp(-0.3085 X/D)
///   m    k = 1.42 - 0.09643 X/D, n = 0, y_u = 0.2899 - 0.04775 X/D, x_u = y_u/k
///   H    k = 2.717 - 0.3575 L/D, n = 0.8793 - 0.0315 L/D, x_u = 235.7, y_u = 0.4038 + 0.04812 L/D
///   M    k = 0.2146 - 0.002132 L/D, n = 1.079 - 0.1087 L/D, x_u = 173.1, y_u = 0.8192 - 0.08588 L/D
///
/// Source: B. W. Byrne et al., PISA design model for monopiles for offshore wind turbines: application to a
/// stiff glacial clay till, Geotechnique 70 (11), 2020; secondary, read in the sources of openpile 1.0.2.
struct PisaClay {
  double Su = 0.0;  ///< undrained shear strength at the place
  double G0 = 0.0;  ///< shear modulus at small strains
};

/// @brief Sand of PISA, calibrated with analyses for sand at Dunkirk, for L/D from 2 to 6, relative densities
/// R from 0.45 to 0.9 and monotonic loading.
///
/// Conics of p/(s D) and H/(s D^2) over y G0/(s D), and of m/(p D) and M/(s D^3) over psi G0/s:
///   p    k = 8.731 - 0.6982 R - 0.9178 X/D, n = 0.917 + 0.06193 R
///        x_u = 146.1 - 92.11 R, y_u = 0.3667 + 25.89 R + (0.3375 - 8.9 R) X/L
///   m    k = 17, n = 0, y_u = 0.2605 + (-0.1989 + 0.2019 R) X/L, x_u = y_u/k
///   H    k = 6.505 - 2.985 R + (-0.007969 - 0.4299 R) L/D
///        n = 0.09978 + 0.7974 R + (0.004994 - 0.07005 R) L/D
///        x_u = 0.515 + 2.883 R + (0.1695 - 0.7018 R) L/D
///        y_u = 0.09952 + 0.7996 R + (0.03988 - 0.1606 R) L/D
///   M    k = 0.3515, n = 0.3 + 0.4986 R, x_u = 44.89
///        y_u = 0.09981 + 0.371 R + (0.01998 - 0.09041 R) L/D
///
/// Source: H. J. Burd et al., PISA design model for monopiles for offshore wind turbines: application to a
/// marine sand, Geotechnique 70 (11), 2020; secondary, read in the sources of openpile 1.0.2.
struct PisaSand {
  double relative_density = 0.0;  ///< R, from 0 to 1
  double G0 = 0.0;                ///< shear modulus at small strains
};

/// @brief Weak rock.
///
///   pu = a q D (1 + 1.4 min(x/D, 3)),  a = 1 - (2/3) RQD/100,  x = depth below the rock's surface
///   p = min(K y, (pu/2) (y/yr)^(1/4), pu),  K = E (100 + 400 min(x/(3 D), 1)),  yr = k_rm D
///
/// Source: L. C. Reese, Analysis of laterally loaded piles in weak rock, J. Geotech. Geoenviron. Eng. 123
/// (11), 1997; secondary, read in the documentation of OpenBrIM and of openpile.
struct WeakRock {
  double q_u = 0.0;   ///< unconfined compressive strength q
  double E_ir = 0.0;  ///< initial modulus E of the rock mass
  double RQD = 0.0;   ///< rock quality designation in percent
  double k_rm = 0.0;  ///< dimensionless, 0.00005 to 0.0005
};

/// @brief Liquefied sand, which stiffens.
///
/// In metres, millimetres of y and kN/m:
///   p = Pd min(A (B y)^C, 15), y at most 150 mm
///   A = 3e-7 (X + 1)^6.05,  B = 2.8 (X + 1)^0.11,  C = 2.85 (X + 1)^-0.41
///   Pd = 3.81 ln(D) + 5.6 for D from 0.3 to 2.6; proportional to D below and constant above
/// The tests behind it: relative density about 50 %, piles of 0.3 m, water near the surface, depths of a few
/// metres. Some hundreds of metres down the curve ends in a displacement of zero.
///
/// Source: K. M. Rollins, T. M. Gerber, J. D. Lane, S. A. Ashford, Lateral resistance of a full-scale pile
/// group in liquefied sand, J. Geotech. Geoenviron. Eng. 131 (1), 2005; secondary, read in the documentation
/// of OpenBrIM and the sources of OpenSees; proportional to D below 0.3 m: in a program after RSPile's
/// manual.
struct LiquefiedSand {
  double metre = 0.0;       ///< one metre in the unit of length
  double kilonewton = 0.0;  ///< one kN in the unit of force
};

/// @brief t-z curve of clay: t over the displacement z along the pile, t a force per length.
///
/// t/(pi D f) = 0.3, 0.5, 0.75, 0.9, 1 at z/D = 0.0016, 0.0031, 0.0057, 0.008, 0.01, and `residual` from 0.02
/// on.
///
/// Source: API RP 2GEO, axial load transfer curves; secondary, read in the sources of openpile 1.0.2.
struct ApiTzClay {
  double friction = 0.0;  ///< unit skin friction f, force/length^2; 0 is allowed
  double residual = 0.0;  ///< 0.7 to 0.9
};

/// @brief t-z curve of sand: proportional to z up to pi D f, constant beyond. Source: that of ApiTzClay.
struct ApiTzSand {
  double friction = 0.0;           ///< unit skin friction f, force/length^2; 0 is allowed
  double peak_displacement = 0.0;  ///< z at which t is largest; API: 2.5 mm
};

/// @brief q-z curve of a pile's tip: force over displacement into the ground.
///
/// Q/(area q) = 0.25, 0.5, 0.75, 0.9, 1 at z/D = 0.002, 0.013, 0.042, 0.073, 0.1; constant beyond. Source:
/// that of ApiTzClay.
struct ApiQz {
  double end_bearing = 0.0;  ///< unit end bearing q, force/length^2; 0 is allowed
  double area = 0.0;         ///< area of the tip that bears
};

/// Types of soil with a lateral curve.
using LayerType = std::variant<SoftClayMatlock, StiffClayFreeWater, StiffClay, ReeseSand, PisaClay, PisaSand,
                               WeakRock, LiquefiedSand>;
/// Types of soil with an axial curve.
using AxialType = std::variant<ApiTzClay, ApiTzSand>;

/// @{
/// @brief Returns the curve of force per length at a place.
/// @param accuracy largest difference from the formula over the largest force, from kLeastAccuracy to
/// kLargestAccuracy
[[nodiscard]] Curve curve_of(const SoftClayMatlock& clay, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const StiffClayFreeWater& clay, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const StiffClay& clay, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const ReeseSand& sand, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const PisaClay& clay, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const PisaSand& sand, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const WeakRock& rock, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const LiquefiedSand& sand, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const ApiTzClay& clay, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const ApiTzSand& sand, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const LayerType& type, const Place& place, double accuracy);
[[nodiscard]] Curve curve_of(const AxialType& type, const Place& place, double accuracy);
/// @}

/// @{
/// Returns the ultimate resistance per length, Pmax, pc or pu, of the formulas above.
[[nodiscard]] double ultimate_of(const SoftClayMatlock& clay, const Place& place);
[[nodiscard]] double ultimate_of(const StiffClayFreeWater& clay, const Place& place);
[[nodiscard]] double ultimate_of(const StiffClay& clay, const Place& place);
[[nodiscard]] double ultimate_of(const ReeseSand& sand, const Place& place);
/// @}

/// Returns the force of a pile's tip over its displacement into the ground.
[[nodiscard]] Curve tip_curve_of(const ApiQz& tip, const Place& place);

/// Returns the moment per length over the rotation.
[[nodiscard]] Curve moment_curve_of(const PisaClay& clay, const Place& place, double accuracy);
/// @brief Returns the moment per length over the rotation while the lateral force per length is `force`.
///
/// The moment of sand is proportional to the lateral force at the same place and time, so that no law of the
/// rotation alone has it. A constant `force` is a choice of the caller, for example the largest that
/// curve_of() gives.
/// @param force >= 0
[[nodiscard]] Curve moment_curve_of(const PisaSand& sand, const Place& place, double force, double accuracy);

/// @{
/// Returns the shear force of a pile's base over its displacement. The place is the tip.
[[nodiscard]] Curve base_shear_curve_of(const PisaClay& clay, const Place& place, double accuracy);
[[nodiscard]] Curve base_shear_curve_of(const PisaSand& sand, const Place& place, double accuracy);
/// @}

/// @{
/// Returns the moment of a pile's base over its rotation. The place is the tip.
[[nodiscard]] Curve base_moment_curve_of(const PisaClay& clay, const Place& place, double accuracy);
[[nodiscard]] Curve base_moment_curve_of(const PisaSand& sand, const Place& place, double accuracy);
/// @}

/// @brief Returns the unit skin friction of clay: a Su, with a = 0.5 (Su/s)^-0.5, but 0.5 (Su/s)^-0.25 where
/// Su > s, and at most 1. It is 0 where Su or s is 0.
///
/// Source: API RP 2GEO; secondary, read in the sources of openpile 1.0.2.
[[nodiscard]] double api_clay_friction(double Su, double stress);

}  // namespace snapthrough::api::soil
