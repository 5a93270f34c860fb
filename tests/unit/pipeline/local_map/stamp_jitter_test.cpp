#include <gtest/gtest.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/local_map/stamp_jitter.h>

#include <cmath>

namespace placegraph {
namespace stamp_jitter_test {

/// A drive that accelerates and brakes along a curve; each frame is taken `jitter_s` off its stamp,
/// and every fifth interval is twice as long.
StampJitter drive(double jitter_s, int frames) {
  StampJitter jitter;
  Random random(2);
  double stamp_s = 0;
  for (int i = 0; i < frames; ++i) {
    stamp_s += i % 5 == 0 ? 0.2 : 0.1;
    const double t = stamp_s + jitter_s * random.normal();
    const double path_m = 10 * t + 3 * std::sin(0.5 * t);
    const double heading = 0.02 * path_m;
    jitter.add(std::llround(1e9 * stamp_s),
               SE3(SO3::exp({0, heading, 0}),
                   Eigen::Vector3d(50 * (1 - std::cos(heading)), 0, 50 * std::sin(heading))));
  }
  return jitter;
}

TEST(StampJitter, IsZeroForExactStampsOfASmoothDrive) {
  EXPECT_LT(drive(0, 200).sigma_s(), 5e-5);
}

TEST(StampJitter, IsTheDeviationOfTheStamps) {
  EXPECT_NEAR(drive(0.001, 400).sigma_s(), 0.001, 0.00015);
  EXPECT_NEAR(drive(0.003, 400).sigma_s(), 0.003, 0.00045);
}

TEST(StampJitter, IsBoundedAndUnknownOfAFewFrames) {
  EXPECT_EQ(drive(0.1, 400).sigma_s(), 0.005);
  EXPECT_EQ(drive(0.001, 10).sigma_s(), 0);
}

TEST(StampJitter, ComparesNoFramesOfTwoTracks) {
  StampJitter jitter;
  for (int track = 0; track < 20; ++track) {
    for (int i = 0; i < 4; ++i)
      jitter.add((100 * track + i) * 100'000'000LL, SE3(SO3(), {0, 0, (track + 1.0) * i * i}));
    jitter.restart();
  }
  EXPECT_EQ(jitter.sigma_s(), 0);
}

TEST(StampJitter, ACameraThatStandsSaysNothing) {
  StampJitter jitter;
  for (int i = 0; i < 100; ++i) jitter.add(i * 100'000'000LL, SE3());
  EXPECT_EQ(jitter.sigma_s(), 0);
}

}  // namespace stamp_jitter_test
}  // namespace placegraph
