#include <gtest/gtest.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/local_map/distortion_evidence.h>

namespace placegraph {
namespace distortion_evidence_test {

Camera ideal_camera() {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 525;
  camera.cx = 320;
  camera.cy = 240;
  return camera;
}

/// A window over a room that a camera with radial distortion looked about in, its images taken for
/// undistorted; each point is seen
/// `views` times at most.
SlidingWindow view_directions(double k1, bool depth, int views) {
  Camera lens = ideal_camera();
  lens.distortion = Distortion::kRadialTangential;
  lens.coefficients = {k1};
  SlidingWindowOptions options;
  options.max_keyframes = 100;
  options.max_iterations = 50;
  options.relative_decrease = 1e-12;
  SlidingWindow window(options, ideal_camera());
  std::vector<SE3> T_map_cam;
  for (int k = 0; k < 8; ++k) {
    T_map_cam.emplace_back(SO3::exp({0.02 * (k % 3), 0.06 * k - 0.2, 0.03 * (k % 2)}),
                           Eigen::Vector3d(0.1 * k, 0.05 * (k % 3), 0.04 * (k % 2)));
    window.add_keyframe(KeyframeId(k), T_map_cam.back());
  }
  Random random(3);
  for (std::int64_t id = 0; id < 150; ++id) {
    const double z = random.uniform(1.5, 5);
    const Eigen::Vector3d p_map(z * random.uniform(-0.6, 0.8), z * random.uniform(-0.45, 0.45), z);
    bool added = false;
    for (int k = static_cast<int>(id) % 4, seen = 0; k < 8 && seen < views; ++k) {
      const Eigen::Vector3d p_cam = T_map_cam[static_cast<std::size_t>(k)].inverse() * p_map;
      const auto px = lens.project(p_cam);
      if (!px || !lens.contains(*px)) continue;
      if (!added) window.add_landmark(LandmarkId(id), p_map);
      added = true;
      WindowObservation o;
      o.keyframe = KeyframeId(k);
      o.landmark = LandmarkId(id);
      o.px = *px;
      o.sigma_px = 0.5;
      if (depth) {
        o.inverse_depth = 1 / p_cam.z();
        o.sigma_inverse_depth = 0.005;
      }
      window.add_observation(o);
      ++seen;
    }
  }
  if (views > 2) {  // pairs of views do not hold together
    EXPECT_TRUE(window.optimize().outcome);
  }
  return window;
}

double found(const DistortionEvidence& evidence) {
  return -evidence.gradient / evidence.information;
}

TEST(DistortionEvidence, TellsTheDistortionThatTheImagesHave) {
  for (const bool depth : {false, true})
    for (const double k1 : {0.02, -0.02}) {
      const DistortionEvidence evidence = lens_evidence(view_directions(k1, depth, 6).state());
      EXPECT_GT(evidence.residuals, 500);
      EXPECT_NEAR(found(evidence), k1, 0.1 * std::abs(k1)) << depth;
      EXPECT_GT(evidence.information, 1 / (0.004 * 0.004)) << depth;
    }
}

TEST(DistortionEvidence, FindsNoneWhereThereIsNone) {
  EXPECT_NEAR(found(lens_evidence(view_directions(0, false, 6).state())), 0, 1e-5);
}

TEST(DistortionEvidence, DepthsAddToIt) {
  EXPECT_GT(lens_evidence(view_directions(0, true, 6).state()).information,
            lens_evidence(view_directions(0, false, 6).state()).information);
}

TEST(DistortionEvidence, PointsInTwoViewsTellNothing) {
  const DistortionEvidence evidence = lens_evidence(view_directions(0.02, false, 2).state());
  EXPECT_EQ(evidence.residuals, 0);
  EXPECT_EQ(evidence.information, 0);
}

}  // namespace distortion_evidence_test
}  // namespace placegraph
