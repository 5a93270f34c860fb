#include <gtest/gtest.h>
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/graph/internal/core/random.h>
#include <placegraph/pipeline/internal/health/focal_evidence.h>

#include <Eigen/LU>

namespace placegraph {
namespace {

constexpr double kBaseline_m = 0.2;

Camera camera_of(double focal_px) {
  Camera camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = focal_px;
  camera.cx = 320;
  camera.cy = 240;
  return camera;
}

enum class Depth { kNone, kMeasured, kDisparity };

/// A window over a room in which a camera moved and turned by `rotation_rad` in all. Its focal
/// length is 500 (1 + s), its k1 is `k1`, and 500 without distortion is assumed.
SlidingWindow window_of(double s, double k1, Depth depth, double rotation_rad) {
  const Camera assumed = camera_of(500);
  Camera lens = camera_of(500 * (1 + s));
  lens.distortion = Distortion::kRadialTangential;
  lens.coefficients = {k1};
  SlidingWindowOptions options;
  options.max_keyframes = 100;
  options.max_iterations = 100;
  options.relative_decrease = 1e-12;
  SlidingWindow window(options, assumed);
  std::vector<SE3> T_map_cam;
  for (int k = 0; k < 8; ++k) {
    T_map_cam.emplace_back(
        SO3::exp({0.3 * rotation_rad * (k % 3) / 3, rotation_rad * (k - 3.5) / 7, 0}),
        Eigen::Vector3d(0.1 * k, 0.05 * (k % 3), 0.04 * (k % 2)));
    window.add_keyframe(KeyframeId(k), T_map_cam.back());
  }
  Random random(3);
  for (std::int64_t id = 0; id < 150; ++id) {
    const double z = random.uniform(1.5, 5);
    const Eigen::Vector3d p_map(z * random.uniform(-0.6, 0.8), z * random.uniform(-0.45, 0.45), z);
    bool added = false;
    for (int k = 0; k < 8; ++k) {
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
      if (depth == Depth::kMeasured) {
        o.inverse_depth = 1 / p_cam.z();
        o.sigma_inverse_depth = 0.005;
      } else if (depth == Depth::kDisparity) {
        o.inverse_depth = (1 + s) / p_cam.z();  // disparity / (assumed focal length * baseline)
        o.sigma_inverse_depth = 0.5 / (assumed.fx * kBaseline_m);
      }
      window.add_observation(o);
    }
  }
  EXPECT_TRUE(window.optimize().outcome);
  return window;
}

Eigen::Vector2d found(const FocalEvidence& evidence) {
  return -evidence.information.inverse() * evidence.gradient;
}

TEST(FocalEvidence, TellsTheFocalLengthWhereTheCameraRotates) {
  for (const Depth depth : {Depth::kNone, Depth::kMeasured, Depth::kDisparity})
    for (const double s : {0.03, -0.03}) {
      const SlidingWindow window = window_of(s, 0, depth, 0.6);
      const FocalEvidence evidence = focal_evidence(window.state(), depth == Depth::kMeasured);
      EXPECT_NEAR(found(evidence)[0], s, 0.2 * std::abs(s)) << static_cast<int>(depth);
      EXPECT_GT(evidence.information(0, 0), 1 / (0.01 * 0.01)) << static_cast<int>(depth);
    }
}

TEST(FocalEvidence, FindsNoErrorWhereThereIsNone) {
  for (const Depth depth : {Depth::kNone, Depth::kMeasured, Depth::kDisparity}) {
    const SlidingWindow window = window_of(0, 0, depth, 0.6);
    EXPECT_NEAR(found(focal_evidence(window.state(), depth == Depth::kMeasured))[0], 0, 1e-4);
  }
}

TEST(FocalEvidence, TellsADistortionFromAFocalLength) {
  const SlidingWindow window = window_of(0, 0.02, Depth::kNone, 0.6);
  const Eigen::Vector2d q = found(focal_evidence(window.state(), false));
  EXPECT_NEAR(q[0], 0, 0.006);
  EXPECT_NEAR(q[1], 0.02, 0.006);
}

TEST(FocalEvidence, SaysLessWhereTheCameraHardlyRotates) {
  const auto information = [](double rotation_rad) {
    const SlidingWindow window = window_of(0, 0, Depth::kNone, rotation_rad);
    return 1 / focal_evidence(window.state(), false).information.inverse()(0, 0);
  };
  EXPECT_LT(information(0.02), 0.1 * information(0.6));
}

TEST(FocalEvidence, AWindowWithoutPointsTellsNothing) {
  SlidingWindow window({}, camera_of(500));
  for (int k = 0; k < 2; ++k)
    window.add_keyframe(KeyframeId(k), SE3(SO3(), Eigen::Vector3d(k, 0, 0)));
  EXPECT_EQ(focal_evidence(window.state(), false).information.norm(), 0);
}

}  // namespace
}  // namespace placegraph
