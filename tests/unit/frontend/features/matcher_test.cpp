#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/frontend/features/detector.h>
#include <placegraph/frontend/features/matcher.h>

#include "tests/support/scenes/scene.h"
#include "tests/support/scenes/texture.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace matcher_test {

using namespace test;
const Camera kCamera = pinhole(640, 480, 500);

Feature feature(const BinaryDescriptor& descriptor, const Eigen::Vector2d& px = {0, 0}) {
  Feature f;
  f.px = px.cast<float>();
  f.descriptor = descriptor;
  return f;
}

TEST(Matcher, FindsPartnersInAnyOrder) {
  Random random = seeded_random(71);
  std::vector<Feature> a, b(40);
  for (int i = 0; i < 40; ++i) {
    a.push_back(feature(random_descriptor(random)));
    b[static_cast<std::size_t>(39 - i)] = feature(flipped(a.back().descriptor, 20, random));
  }
  const auto matches = match_features(a, b, {});
  ASSERT_EQ(matches.size(), 40u);
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(matches[static_cast<std::size_t>(i)].a, i);
    EXPECT_EQ(matches[static_cast<std::size_t>(i)].b, 39 - i);
    EXPECT_EQ(matches[static_cast<std::size_t>(i)].distance, 20);
  }
  EXPECT_TRUE(match_features({}, b, {}).empty());
  EXPECT_TRUE(match_features(a, {}, {}).empty());
}

TEST(Matcher, TakesOnlyMutualDistinctAndNearMatches) {
  Random random = seeded_random(72);
  const BinaryDescriptor d = random_descriptor(random);
  // Both features of a like b[0] best; the nearer one gets it.
  EXPECT_THAT(match_features({feature(flipped(d, 12, random)), feature(flipped(d, 4, random))},
                             {feature(d)}, {}),
              testing::ElementsAre(testing::Field(&FeatureMatch::a, 1)));
  // Two that look alike: the ratio test refuses both.
  const std::vector<Feature> twins{feature(flipped(d, 20, random)),
                                   feature(flipped(d, 21, random))};
  EXPECT_TRUE(match_features({feature(d)}, twins, {}).empty());
  // ... unless only one of them may be looked at.
  EXPECT_THAT(match_features({feature(d)}, twins, {}, {false, true}),
              testing::ElementsAre(testing::Field(&FeatureMatch::b, 1)));
  MatcherOptions options;
  options.max_distance = 30;
  EXPECT_EQ(match_features({feature(d)}, {feature(flipped(d, 30, random))}, options).size(), 1u);
  EXPECT_TRUE(match_features({feature(d)}, {feature(flipped(d, 31, random))}, options).empty());
}

TEST(Matcher, StaysInTheBandAroundEpipolarLines) {
  Random random = seeded_random(73);
  const SE3 T_a_b = pose({0.02, -0.03, 0.01}, {0.8, 0.1, 0.3});
  const PointScene scene = make_scene(kCamera, {SE3(), T_a_b}, 60, random);
  std::vector<Feature> a, b;
  for (std::size_t i = 0; i < 60; ++i) {
    const BinaryDescriptor d = random_descriptor(random);
    a.push_back(feature(d, scene.px[0][i]));
    b.push_back(feature(flipped(d, 10, random), scene.px[1][i]));
  }
  const auto all = match_epipolar(kCamera, a, b, T_a_b, 1.0, {});
  EXPECT_EQ(all.size(), 60u);
  for (const FeatureMatch& m : all) EXPECT_EQ(m.a, m.b);
  // A twin off the line does not confuse; a partner off the line is not found. The motion goes
  // along x, so that the lines run across.
  auto off = b;
  for (Feature& f : off) f.px.y() += 25;
  std::vector<Feature> both = b;
  both.insert(both.end(), off.begin(), off.end());
  std::size_t right = 0;
  for (const FeatureMatch& m : match_epipolar(kCamera, a, both, T_a_b, 1.0, {})) {
    EXPECT_EQ(m.a, m.b);
    ++right;
  }
  EXPECT_GT(right, 54u);
  EXPECT_LT(match_epipolar(kCamera, a, off, T_a_b, 1.0, {}).size(), 4u);
  // Another size of patch is another thing.
  auto coarse = b;
  for (Feature& f : coarse) f.octave = 3;
  EXPECT_TRUE(match_epipolar(kCamera, a, coarse, T_a_b, 1.0, {}).empty());
}

TEST(Matcher, RefusesPartnersBehindTheCameras) {
  Random random = seeded_random(74);
  const SE3 T_a_b = pose({0, 0, 0}, {0.8, 0, 0});
  // With b right of a, a point moves left; a partner on the same line but right of it would lie
  // behind.
  const BinaryDescriptor d = random_descriptor(random);
  const std::vector<Feature> a{feature(d, {300, 200})};
  EXPECT_EQ(match_epipolar(kCamera, a, {feature(d, {270, 200})}, T_a_b, 1.5, {}).size(), 1u);
  EXPECT_TRUE(match_epipolar(kCamera, a, {feature(d, {330, 200})}, T_a_b, 1.5, {}).empty());
}

TEST(Matcher, FindsTheShiftBetweenTwoPictures) {
  const Texture texture{3, 16, 2, 60};
  const auto a = detect_features(texture_image(200, 150, texture), {});
  const auto b = detect_features(texture_image(200, 150, texture, 7, -4), {});
  const auto matches = match_features(a, b, {});
  ASSERT_GT(matches.size(), 50u);
  std::size_t right = 0;
  for (const FeatureMatch& m : matches)
    right += (a[static_cast<std::size_t>(m.a)].px - b[static_cast<std::size_t>(m.b)].px -
              Eigen::Vector2f(7, -4))
                 .norm() < 2.5f;  // a pixel of the coarsest octave
  EXPECT_GT(right, 0.9 * matches.size());
}

}  // namespace matcher_test
}  // namespace placegraph
