#include "solver/numeric/sine_cosine.h"

namespace snapthrough {

namespace {

// pi/2 = kHigh + kMiddle + kRest. The first two have 33 bits each, so that their products with whole numbers
// below 2^20 are exact, with and without fused multiply-add (W. J. Cody and W. Waite, Software Manual for the
// Elementary Functions, 1980).
constexpr double kHigh = 0x1.921fb544p+0;
constexpr double kMiddle = 0x1.0b4611a6p-34;
constexpr double kRest = 0x1.3198a2e037073p-69;

/// sin r, |r| <= pi/4.
Lanes sine_near_zero(const Lanes& r) {
  const Lanes z = r * r;
  const Lanes series =
      ((((1.58969099521155010221e-10 * z - 2.50507602534068634195e-08) * z + 2.75573137070700676789e-06) * z -
        1.98412698298579493134e-04) *
           z +
       8.33333333332248946124e-03) *
          z -
      1.66666666666666324348e-01;
  return r + (r * z) * series;
}

/// cos r, |r| <= pi/4.
Lanes cosine_near_zero(const Lanes& r) {
  const Lanes z = r * r;
  const Lanes series =
      (((((-1.13596475577881948265e-11 * z + 2.08757232129817482790e-09) * z - 2.75573143513906633035e-07) *
             z +
         2.48015872894767294178e-05) *
            z -
        1.38888888888741095749e-03) *
           z +
       4.16666666666666019037e-02);
  return 1.0 - (0.5 * z - (z * z) * series);
}

}  // namespace

void find_sines(Angles& of) {
  for (std::size_t i = 0; i < of.angle.size(); ++i) {
    const Lanes turns = (of.angle[i] / kHigh).rint();
    const Lanes r = ((of.angle[i] - turns * kHigh) - turns * kMiddle) - turns * kRest;
    const Lanes s = sine_near_zero(r);
    const Lanes c = cosine_near_zero(r);
    // cosine and sine of whole quarter turns: m in -2..2
    const Lanes m = turns - 4.0 * (0.25 * turns).rint();
    const Lanes whole_cosine = 1.0 - m.abs();
    const Lanes whole_sine = m * (2.0 - m.abs());
    of.sine[i] = s * whole_cosine + c * whole_sine;
    of.cosine[i] = c * whole_cosine - s * whole_sine;
  }
}

}  // namespace snapthrough
