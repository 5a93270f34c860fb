#include <gtest/gtest.h>
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/graph/core/random.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace placegraph {
namespace corner_agreement_test {

std::vector<Feature> draw_corners(int count, Random& random) {
  std::vector<Feature> corners(static_cast<std::size_t>(count));
  for (Feature& corner : corners) {
    corner.px = {static_cast<float>(random.uniform(0, 320)),
                 static_cast<float>(random.uniform(0, 240))};
    corner.angle_rad = static_cast<float>(random.uniform(0, 2 * std::numbers::pi));
    corner.octave = random.index(3);
    for (std::uint64_t& word : corner.descriptor)
      word = static_cast<std::uint64_t>(random.next()) << 32 | random.next();
  }
  return corners;
}

/// The corners after a turn, `octaves` of growth and a shift.
std::vector<Feature> moved(std::vector<Feature> corners, double turn_rad, int octaves) {
  const double scale = std::pow(1.2, octaves);
  const auto c = static_cast<float>(scale * std::cos(turn_rad)),
             s = static_cast<float>(scale * std::sin(turn_rad));
  for (Feature& corner : corners) {
    corner.px = {30 + c * corner.px.x() - s * corner.px.y(), s * corner.px.x() + c * corner.px.y()};
    corner.angle_rad += static_cast<float>(turn_rad);
    corner.octave += octaves;
  }
  return corners;
}

TEST(CornerAgreementCount, IsAllCornersUnderAnySimilarityInAnyOrder) {
  Random random(1);
  const CornerAgreementOptions options;
  const std::vector<Feature> corners = draw_corners(50, random);
  for (const double turn_rad : {0.0, 0.4, -2.5})
    for (const int octaves : {-1, 0, 2}) {
      std::vector<Feature> other = moved(corners, turn_rad, octaves);
      for (std::size_t i = other.size() - 1; i > 0; --i)
        std::swap(other[i], other[random.index(static_cast<int>(i) + 1)]);
      EXPECT_EQ(corner_agreement(corners, other, options), 50) << turn_rad << ' ' << octaves;
      EXPECT_EQ(corner_agreement(other, corners, options), 50) << turn_rad << ' ' << octaves;
    }
  EXPECT_EQ(corner_agreement(corners, draw_corners(50, random), options), 0);
}

TEST(CornerAgreementCount, LeavesOutWhatIsBeyondTheTolerance) {
  Random random(2);
  const CornerAgreementOptions options;  // 0.06 of 320: 19.2 px
  const std::vector<Feature> corners = draw_corners(40, random);
  std::vector<Feature> other = corners;
  for (std::size_t i = 0; i < 10; ++i) other[i].px.x() += 18.5f;
  for (std::size_t i = 10; i < 18; ++i) other[i].px.y() += 20.0f;
  for (std::size_t i = 18; i < 23; ++i) other[i].descriptor = corners[i + 10].descriptor;
  // The descriptors of 28 to 32 are there twice, those of 18 to 22 not at all: no match for either.
  EXPECT_EQ(corner_agreement(corners, other, options), 40 - 8 - 5 - 5);
}

TEST(CornerAgreementCount, CountsTheLargerOfTwoMotions) {
  Random random(3);
  const CornerAgreementOptions options;
  const std::vector<Feature> corners = draw_corners(30, random);
  std::vector<Feature> other = moved(corners, 0, 0);
  for (std::size_t i = 0; i < 12; ++i) other[i].px += Eigen::Vector2f(-100, 60);
  EXPECT_EQ(corner_agreement(corners, other, options), 18);
}

}  // namespace corner_agreement_test
}  // namespace placegraph
