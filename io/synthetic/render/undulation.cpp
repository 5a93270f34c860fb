#include <placegraph/graph/core/random.h>
#include <placegraph/io/synthetic/render/undulation.h>

#include <algorithm>
#include <cmath>

namespace placegraph::synthetic {
namespace {

constexpr double kShortest_m = 3, kLongest_m = 30;
constexpr int kWaves = 12;

/// A wave between -1 and 1 with period 1, smooth, free of libm: the same bits on every machine.
double wave(double phase) {
  const double x = std::abs(2 * (phase - std::floor(phase)) - 1);
  return 1 - 2 * x * x * (3 - 2 * x);
}
constexpr double kWaveVariance = 17.0 / 35;

Eigen::Vector2d random_direction(Random& random) {
  Eigen::Vector2d d(2, 0);
  while (d.squaredNorm() > 1 || d.squaredNorm() < 0.01)
    d = Eigen::Vector2d{random.uniform(-1, 1), random.uniform(-1, 1)};
  return d.normalized();
}

}  // namespace

Undulation::Undulation(double rms_m, std::uint64_t seed) {
  if (rms_m == 0) return;
  Random random(seed, 91);
  double sum = 0;
  for (int i = 0; i < kWaves; ++i) {
    const double length_m =
        kShortest_m * std::pow(kLongest_m / kShortest_m, 1.0 * i / (kWaves - 1));
    const Eigen::Vector2d direction = random_direction(random);
    waves_.push_back({direction / length_m, random.uniform(), std::sqrt(length_m)});
    sum += kWaveVariance * length_m;
  }
  for (Wave& w : waves_) w.amplitude_m *= rms_m / std::sqrt(sum);
}

double Undulation::height(double x, double z) const {
  double sum = 0;
  for (const Wave& w : waves_)
    sum += w.amplitude_m * wave(w.periods_per_m.dot(Eigen::Vector2d(x, z)) + w.phase);
  return sum;
}

}  // namespace placegraph::synthetic
