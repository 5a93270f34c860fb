#pragma once
#include <cmath>

namespace placegraph::internal {

/// The Stumpff functions S_k(x) = sum_j (-x)^j / (2j + k)! at x = angle^2: S_1 = sin(a) / a,
/// S_2 = (1 - cos a) / a^2, S_3 = (a - sin a) / a^3, S_4 = (a^2 / 2 - 1 + cos a) / a^4,
/// S_5 = (a^3 / 6 - a + sin a) / a^5. Every Jacobian of the rotation groups consists of them. Here
/// they have full precision at any angle, which the closed forms lose by cancellation near zero.
struct RotationSeries {
  double s0, s1, s2, s3, s4, s5;

  explicit RotationSeries(double angle_squared) {
    const double x = angle_squared;
    if (x < 1) {
      s4 = s5 = 0;
      for (int j = 8; j > 0; --j) {  // Horner; the next term is below 1e-19
        s4 = (1 - s4) * x / ((2 * j + 3) * (2 * j + 4));
        s5 = (1 - s5) * x / ((2 * j + 4) * (2 * j + 5));
      }
      s4 = (1 - s4) / 24;
      s5 = (1 - s5) / 120;
      s3 = 1. / 6 - x * s5;
      s2 = 0.5 - x * s4;
      s1 = 1 - x * s3;
      s0 = 1 - x * s2;
    } else {
      const double angle = std::sqrt(x);
      s0 = std::cos(angle);
      s1 = std::sin(angle) / angle;
      s2 = (1 - s0) / x;
      s3 = (1 - s1) / x;
      s4 = (0.5 - s2) / x;
      s5 = (1. / 6 - s3) / x;
    }
  }
};

/// (1 - (a / 2) cot(a / 2)) / a^2 at x = angle^2, for 0 <= angle < 2 pi: the coefficient of
/// hat(w)^2 in the inverse of a rotation's left or right Jacobian. 1 / 12 at zero, finite at pi.
inline double inverse_jacobian_coefficient(const RotationSeries& series, double angle_squared) {
  // With a cot(a / 2) / 2 = S_1 / (2 S_2): (2 S_2 - S_1) / (2 S_2 x) = (S_3 - 2 S_4) / (2 S_2).
  if (angle_squared < 1) return (series.s3 - 2 * series.s4) / (2 * series.s2);
  const double half = std::sqrt(angle_squared) / 2;
  return (1 - half * std::cos(half) / std::sin(half)) / angle_squared;
}

}  // namespace placegraph::internal
