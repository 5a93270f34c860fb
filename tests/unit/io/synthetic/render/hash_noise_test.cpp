#include <gtest/gtest.h>
#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/render/materials.h>

#include "tests/support/seed.h"

namespace placegraph::synthetic {
namespace hash_noise_test {

TEST(HashNoise, FloorsTowardsMinusInfinity) {
  EXPECT_EQ(floor_int(2.0), 2);
  EXPECT_EQ(floor_int(1.999), 1);
  EXPECT_EQ(floor_int(-0.001), -1);
  EXPECT_EQ(floor_int(-3.0), -3);
}

TEST(HashNoise, IsContinuousBoundedAndWithoutMean) {
  Random random = test::seeded_random(1);
  double sum = 0, square = 0, largest_step = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double x = random.uniform(-500, 500), y = random.uniform(-500, 500);
    const double value = value_noise(x, y, 7);
    ASSERT_LE(std::abs(value), 1);
    sum += value;
    square += value * value;
    largest_step = std::max(largest_step, std::abs(value_noise(x + 1e-3, y, 7) - value));
  }
  // Lattice values are uniform in [-1, 1]: sigma 0.58 there, less between; steepest slope 1.5 * 2.
  EXPECT_NEAR(sum / kCount, 0, 5 * 0.6 / std::sqrt(kCount));
  EXPECT_GT(std::sqrt(square / kCount), 0.3);
  EXPECT_LT(largest_step, 3e-3 * 1.05);
}

TEST(HashNoise, NeighbouringLatticeValuesAreUncorrelated) {
  double along = 0, across = 0, seeds = 0;
  constexpr int kSide = 200;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double here = value_noise(x, y, 3);
      along += here * value_noise(x + 1, y, 3);
      across += here * value_noise(x, y + 1, 3);
      seeds += here * value_noise(x, y, 4);
    }
  }
  // Products of independent uniform values: mean 0, sigma 1/3.
  const double tolerance = 5.0 / 3 * kSide;
  EXPECT_NEAR(along, 0, tolerance);
  EXPECT_NEAR(across, 0, tolerance);
  EXPECT_NEAR(seeds, 0, tolerance);
}

TEST(HashNoise, StripesSeenThroughAWideFootprintBecomeTheirMean) {
  for (const double x : {-17.3, 0.0, 0.4, 123.456}) {
    EXPECT_NEAR(periodic_pulse(x, 0.5F, 0.1F, 0.25F, 50.0F), 0.3, 0.005);
    EXPECT_NEAR(periodic_pulse(x, 0.5F, 0.1F, 0.25F, 1.0F), 0.3, 1e-4);  // two whole periods
  }
  EXPECT_NEAR(periodic_pulse(0.2, 0.5F, 0.1F, 0.25F, 0.01F), 1, 1e-5);
  EXPECT_FLOAT_EQ(periodic_pulse(-0.1, 0.5F, 0.1F, 0.25F, 0.01F), 0);
  EXPECT_NEAR(periodic_pulse(0.6, 0.5F, 0.1F, 0.25F, 0.02F), 0.5, 1e-4);  // centred on an edge
}

TEST(Octave, FadesOutBelowTwoPixelsAWavelength) {
  Spot spot;
  spot.s = 3.21;
  spot.t = 7.65;
  spot.su = 0.11F;
  spot.tv = 0.11F;
  spot.finish();
  EXPECT_EQ(octave(spot, 0.2F, 5), 0);
  EXPECT_NE(octave(spot, 2.0F, 5), 0);
}

TEST(Octave, AveragesAlongAnElongatedFootprintAsManyThinOnesDo) {
  Spot wide;
  wide.s = 3.21;
  wide.t = 7.65;
  wide.su = 0.01F;
  wide.tv = 1.2F;  // one pixel is 1.2 m long on a wavelength of 1 m
  wide.finish();
  double mean = 0;
  constexpr int kSlices = 240;
  for (int i = 0; i < kSlices; ++i)
    mean += value_noise(wide.s, wide.t + 1.2 * ((i + 0.5) / kSlices - 0.5), 5) / kSlices;
  EXPECT_NEAR(octave(wide, 1.0F, 5), mean, 0.1);  // three samples for 240
}

}  // namespace hash_noise_test
}  // namespace placegraph::synthetic
