#include <gtest/gtest.h>
#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/loops/keyframe_describer.h>

#include "tests/support/scenes/street.h"

namespace placegraph {
namespace keyframe_describer_test {

using namespace test;

const StreetDataset& street_of(bool with_depth) {
  static const StreetDataset stereo(4), depth(1, 0, 0, true);
  return with_depth ? depth : stereo;
}
KeyframeDescriber describer_of(Sensor sensor) {
  return KeyframeDescriber({}, {}, street_of(sensor == Sensor::kRgbd).calibration(sensor));
}

/// How far points are off the road, the house fronts and the end wall [m].
double off_the_street(const DescribedKeyframe& keyframe, const SE3& T_world_cam) {
  std::vector<double> off;
  for (const Feature& feature : keyframe.features) {
    if (!feature.point_cam) continue;
    const Eigen::Vector3d p = T_world_cam * feature.point_cam->cast<double>();
    off.push_back(std::min({std::abs(p.y()), std::abs(std::abs(p.x()) - 5), std::abs(p.z() - 32)}));
  }
  return off.size() < 20 ? 1e3 : median_of(off);
}

TEST(KeyframeDescriber, ADepthImagePlacesTheFeaturesThatItCovers) {
  const auto keyframe = describer_of(Sensor::kRgbd)
                            .describe(KeyframeId(7), street_of(true).frame(0, Sensor::kRgbd), {});
  EXPECT_EQ(keyframe.keyframe, KeyframeId(7));
  EXPECT_EQ(keyframe.frame, FrameId(0));
  EXPECT_LT(off_the_street(keyframe, street_T_world_cam(0)), 0.02);
  EXPECT_GT(farthest_depth(keyframe), 10);
  EXPECT_LT(farthest_depth(keyframe), 40);
}

TEST(KeyframeDescriber, ParallaxPlacesTheFeaturesThatTwoKeyframesShare) {
  const KeyframeDescriber describer = describer_of(Sensor::kMono);
  auto before = describer.describe(KeyframeId(0), street_of(false).frame(0, Sensor::kMono), {});
  auto now = describer.describe(KeyframeId(1), street_of(false).frame(3, Sensor::kMono), {});
  EXPECT_EQ(farthest_depth(now), 0);
  describer.triangulate(before, now, street_T_world_cam(0).inverse() * street_T_world_cam(3));
  EXPECT_LT(off_the_street(before, street_T_world_cam(0)), 0.3);
  EXPECT_LT(off_the_street(now, street_T_world_cam(3)), 0.3);
}

TEST(KeyframeDescriber, LinesGetTheirDescriptors) {
  LineFeature line;
  line.segment = {{100, 60}, {100, 200}};
  const auto keyframe =
      describer_of(Sensor::kMono)
          .describe(KeyframeId(0), street_of(false).frame(0, Sensor::kMono), {line});
  ASSERT_EQ(keyframe.lines.size(), 1u);
  EXPECT_NE(keyframe.lines[0].descriptor, line.descriptor);
}

TEST(KeyframeDescriber, CorrectsAKeyframeAsIfTheErrorsHadBeenKnown) {
  const KeyframeDescriber describer = describer_of(Sensor::kRgbd);
  const Frame frame = street_of(true).frame(0, Sensor::kRgbd);
  RgbdErrors::Vector values;
  values << 0.01, 0.004, -0.006, 0.02, -0.02, 0.003, 0.002;
  Vector6d twist;
  twist << 0.2, 0, 0.5, 0.1, 0.6, 0;
  const FrameErrors errors{RgbdErrors(values), twist};
  const auto known = describer.describe(KeyframeId(0), frame, {}, errors);
  auto later = describer.describe(KeyframeId(0), frame, {}, {RgbdErrors(), twist});
  const auto differences = [&] {
    std::vector<double> px, depth;
    for (std::size_t i = 0; i < known.features.size(); ++i) {
      const Feature &a = known.features[i], &b = later.features[i];
      px.push_back((a.px - b.px).norm());
      if (a.point_cam && b.point_cam)
        depth.push_back(std::abs(a.point_cam->z() / b.point_cam->z() - 1));
    }
    return std::pair(median_of(px), median_of(depth));
  };
  const auto [px_before, depth_before] = differences();
  EXPECT_TRUE(describer.correct(later, errors.errors));
  EXPECT_FALSE(describer.correct(later, errors.errors));
  const auto [px_after, depth_after] = differences();
  EXPECT_GT(px_before, 2);
  EXPECT_LT(px_after, 0.1 * px_before);
  EXPECT_LT(depth_after, 0.3 * depth_before);
}

TEST(KeyframeDescriber, LeavesAKeyframeOfALoadedMap) {
  const KeyframeDescriber describer = describer_of(Sensor::kRgbd);
  auto loaded = describer.describe(KeyframeId(0), street_of(true).frame(0, Sensor::kRgbd), {});
  loaded.surfaces_cam.clear();
  const Eigen::Vector2f px = loaded.features.front().px;
  EXPECT_FALSE(describer.correct(loaded, RgbdErrors(RgbdErrors::Vector::Constant(0.01))));
  EXPECT_EQ(loaded.features.front().px, px);
}

TEST(KeyframeDescriber, RescalingMultipliesAllLengths) {
  auto keyframe = describer_of(Sensor::kRgbd)
                      .describe(KeyframeId(0), street_of(true).frame(0, Sensor::kRgbd), {});
  LineFeature line;
  line.line_cam = Line3::from_direction({1, 0, 4}, {0, 1, 0});
  keyframe.lines.push_back(line);
  const double farthest = farthest_depth(keyframe);
  rescale(keyframe, 2.5);
  EXPECT_NEAR(farthest_depth(keyframe), 2.5 * farthest, 1e-4);
  const Line3& rescaled = *keyframe.lines.back().line_cam;
  EXPECT_LT((rescaled.nearest_point() - Eigen::Vector3d(2.5, 0, 10)).norm(), 1e-9);
  EXPECT_LT((rescaled.direction().cross(Eigen::Vector3d::UnitY())).norm(), 1e-9);
}

}  // namespace keyframe_describer_test
}  // namespace placegraph
