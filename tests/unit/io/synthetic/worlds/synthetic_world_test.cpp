#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/scene/labelled_mesh.h>
#include <placegraph/io/synthetic/worlds/synthetic_world.h>
#include <placegraph/io/synthetic/worlds/tours.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <set>

#include "tests/support/message_of.h"

namespace placegraph {
namespace synthetic_world_test {

using test::message_of;
using testing::HasSubstr;

/// A walk through a corridor in small images.
SyntheticOptions small(int frames = 5) {
  SyntheticOptions options;
  options.world = "corridor-loop";
  options.difficulty = synthetic::Difficulty::kClean;
  options.frames = frames;
  options.width = 80;
  options.height = 60;
  return options;
}

std::string refusal(const SyntheticOptions& options) {
  return message_of<ArgumentError>([&] { SyntheticWorld world(options); });
}

TEST(SyntheticWorld, RefusesWhatDoesNotGoTogether) {
  SyntheticOptions options = small();
  options.world = "atlantis";
  const std::string unknown = refusal(options);
  EXPECT_THAT(unknown, HasSubstr("world 'atlantis'"));
  for (const std::string& name : SyntheticWorld::worlds()) EXPECT_THAT(unknown, HasSubstr(name));
  options = small();
  options.height = 0;
  EXPECT_THAT(refusal(options), HasSubstr("width and height go together"));
  options.width = options.height = 31;
  EXPECT_THAT(refusal(options), HasSubstr("at least 32 x 32"));
  options = small();
  options.duration_s = 3;
  EXPECT_THAT(refusal(options), HasSubstr("duration_s"));
  options = small();
  options.defects.undulation_m = 0.02;
  EXPECT_THAT(refusal(options), HasSubstr("defects.undulation_m"));
  options = small();
  options.world.clear();
  EXPECT_THAT(refusal(options), HasSubstr("world: is empty"));
  const SyntheticWorld world(small(2));
  EXPECT_THROW((void)world.render(2, {}), ArgumentError);
}

TEST(SyntheticWorld, AResizedCameraSeesTheSameViewToItsEdges) {
  SyntheticOptions options = small(1);
  const Camera resized = SyntheticWorld(options).calibration().camera;
  options.width = options.height = 0;
  const Camera own = SyntheticWorld(options).calibration().camera;
  EXPECT_EQ(resized.width, 80);
  // The outer edges of an image are half a pixel beyond the centres of its first and last pixels.
  const auto edge = [](const Camera& c, double share) -> Eigen::Vector3d {
    return *c.unproject({share * c.width - 0.5, share * c.height - 0.5});
  };
  for (const double share : {0.0, 0.3, 1.0})
    EXPECT_LT((edge(resized, share) - edge(own, share)).norm(), 1e-12);
}

TEST(SyntheticWorld, PosesBeginAtTheFirstCameraAndKeepTheMotionOfTheTour) {
  const SyntheticWorld world(small());
  const Trajectory truth = world.ground_truth();
  const std::vector<SE3>& T_scene_cam = world.tour().T_scene_cam;
  ASSERT_EQ(truth.size(), 5u);
  EXPECT_TRUE(truth.poses[0].T_world_body->isApprox(Eigen::Isometry3d::Identity(), 0));
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Eigen::Isometry3d moved =
        truth.poses[i - 1].T_world_body->inverse() * *truth.poses[i].T_world_body;
    const SE3 expected = T_scene_cam[i - 1].inverse() * T_scene_cam[i];
    EXPECT_TRUE(moved.isApprox(expected.isometry(), 1e-9));
    EXPECT_EQ(truth.poses[i].stamp_ns, world.stamp_ns(i));
  }
}

TEST(SyntheticWorld, DepthAndPlanesAgreeInEveryPixel) {
  const SyntheticWorld world(small());
  SyntheticContents contents;
  contents.depth = contents.planes = true;
  const SyntheticFrame frame = world.render(3, contents);
  const std::vector<Eigen::Vector4d> planes = world.planes();
  const Eigen::Isometry3d T_first_cam = *world.ground_truth().poses[3].T_world_body;
  const Camera camera = world.calibration().camera;
  int checked = 0;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const std::size_t plane = frame.planes.at<std::uint16_t>(v, u);
      if (plane == 0) continue;
      ++checked;
      const double depth = frame.frame.depth.at<float>(v, u);
      const Eigen::Vector3d p = T_first_cam * (depth * *camera.unproject({u, v}));
      // Depth is a float: 1e-7 of it, on a surface that may be seen at a flat angle.
      ASSERT_NEAR(planes.at(plane).head<3>().dot(p), planes[plane][3], 1e-5 * depth);
    }
  EXPECT_GE(checked, 80 * 60 / 2);
}

TEST(SyntheticWorld, TheFlowLeadsToTheSamePointInTheNextFrame) {
  const SyntheticWorld world(small());
  SyntheticContents contents;
  contents.depth = contents.flow = true;
  const SyntheticFrame frame = world.render(1, contents);
  const Trajectory truth = world.ground_truth();
  const Eigen::Isometry3d T_next_cam =
      truth.poses[2].T_world_body->inverse() * *truth.poses[1].T_world_body;
  const Camera camera = world.calibration().camera;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const auto flow = frame.flow.at<cv::Vec2f>(v, u);
      const double depth = frame.frame.depth.at<float>(v, u);
      if (depth == 0 || std::isnan(flow[0])) continue;
      const auto px = camera.project(T_next_cam * (depth * *camera.unproject({u, v})));
      ASSERT_TRUE(px);
      ASSERT_NEAR(u + flow[0], px->x(), 1e-3);
      ASSERT_NEAR(v + flow[1], px->y(), 1e-3);
    }
  EXPECT_TRUE(world.render(4, contents).flow.empty());  // there is no next one
}

TEST(SyntheticWorld, ThreadsAndOtherContentsDoNotChangeAPixel) {
  SyntheticOptions options = small(2);
  options.difficulty = synthetic::Difficulty::kHard;
  const Image alone = SyntheticWorld(options).render(1, {}).frame.image;
  options.threads = 3;
  const SyntheticFrame all = SyntheticWorld(options).render(1, {true, true, true, true, true});
  EXPECT_EQ(cv::norm(all.frame.image, alone, cv::NORM_INF), 0);
  options.seed = 2;
  EXPECT_NE(cv::norm(SyntheticWorld(options).render(1, {}).frame.image, alone, cv::NORM_INF), 0);
}

TEST(SyntheticWorld, JitterMovesTheExposureButNotTheWrittenTime) {
  SyntheticOptions options = small(100);
  const SyntheticWorld exact(options);
  options.defects.time_jitter_s = 0.004;
  const SyntheticWorld world(options);
  double squares = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(world.stamp_ns(i), exact.stamp_ns(i));
    EXPECT_NEAR(exact.exposure_time_s(i), 1e-9 * static_cast<double>(exact.stamp_ns(i)), 1e-9);
    squares += std::pow(world.exposure_time_s(i) - exact.exposure_time_s(i), 2);
  }
  EXPECT_NEAR(std::sqrt(squares / 100), 0.004, 0.001);  // 100 samples: known to 7 %
}

TEST(SyntheticWorld, LabelsHaveOneNumberInAllLists) {
  const std::vector<std::string> names = SyntheticWorld::class_names();
  const std::vector<SceneClass> classes = SyntheticWorld::scene_classes();
  ASSERT_EQ(classes.size(), names.size());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    EXPECT_EQ(classes[i].id, static_cast<int>(i));
    if (!classes[i].surface) {
      EXPECT_EQ(classes[i].name, names[i]);
    }
  }
  const SyntheticWorld world(small(1));
  const LabelledMesh mesh = world.static_mesh();
  EXPECT_EQ(std::set<std::string>(mesh.classes.begin(), mesh.classes.end()).size(),
            mesh.classes.size());
  std::size_t faces = 0;
  for (const synthetic::Part& part : world.tour().scene.parts) faces += part.faces.size();
  ASSERT_EQ(mesh.faces.size(), faces);
  for (const LabelledMesh::Face& face : mesh.faces)
    EXPECT_TRUE(face.corners.size() >= 3 && face.corners.back() <= std::ssize(mesh.vertices) - 1);
}

}  // namespace synthetic_world_test
}  // namespace placegraph
