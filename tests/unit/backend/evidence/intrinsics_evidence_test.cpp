#include <gtest/gtest.h>
#include <placegraph/backend/evidence/intrinsics_evidence.h>
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/graph/core/random.h>

#include <Eigen/LU>
#include <utility>
#include <vector>

namespace placegraph {
namespace intrinsics_evidence_test {

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

/// The camera with errors of its intrinsics.
Camera with_errors(Camera camera, const IntrinsicsEvidence::Vector& q) {
  using Evidence = IntrinsicsEvidence;
  camera.cx += camera.fx * q[Evidence::kPrincipalX];
  camera.cy += camera.fy * q[Evidence::kPrincipalY];
  camera.fx *= 1 + q[Evidence::kFocal] + q[Evidence::kAspect] / 2;
  camera.fy *= 1 + q[Evidence::kFocal] - q[Evidence::kAspect] / 2;
  if (q[Evidence::kRadial] != 0) {
    camera.distortion = Distortion::kRadialTangential;
    camera.coefficients = {q[Evidence::kRadial]};
  }
  return camera;
}

/// A window over a room in which a camera moved and turned by `rotation_rad` in all. Its intrinsics
/// have the errors q; those without an error are assumed.
SlidingWindow window_of(const IntrinsicsEvidence::Vector& q, Depth depth, double rotation_rad) {
  const Camera assumed = camera_of(500), lens = with_errors(assumed, q);
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
        o.inverse_depth = 1 / (p_cam.z() + q[IntrinsicsEvidence::kDepthOffset]);
        o.sigma_inverse_depth = 0.005;
      } else if (depth == Depth::kDisparity) {
        o.inverse_depth =
            lens.fx / assumed.fx / p_cam.z();  // disparity / (assumed focal length * baseline)
        o.sigma_inverse_depth = 0.5 / (assumed.fx * kBaseline_m);
      }
      window.add_observation(o);
    }
  }
  EXPECT_TRUE(window.optimize().outcome);
  return window;
}

using Vector = IntrinsicsEvidence::Vector;

Vector error(IntrinsicsEvidence::Parameter parameter, double value) {
  return value * Vector::Unit(parameter);
}

/// With what is known of intrinsics beforehand.
Vector found(const IntrinsicsEvidence& evidence) {
  Vector prior;
  prior << 0.2, 0.03, 0.05, 0.05, 0.1, 1;
  IntrinsicsEvidence::Matrix information = evidence.information;
  information.diagonal() += prior.cwiseAbs2().cwiseInverse();
  return -information.inverse() * evidence.gradient;
}

constexpr Depth kAllDepths[] = {Depth::kNone, Depth::kMeasured, Depth::kDisparity};

TEST(IntrinsicsEvidence, TellsTheFocalLengthWhereTheCameraRotates) {
  for (const Depth depth : kAllDepths)
    for (const double s : {0.03, -0.03}) {
      const SlidingWindow window = window_of(error(IntrinsicsEvidence::kFocal, s), depth, 0.6);
      const auto evidence = intrinsics_evidence(window.state(), depth == Depth::kMeasured);
      EXPECT_NEAR(found(evidence)[0], s, 0.2 * std::abs(s)) << static_cast<int>(depth);
      EXPECT_GT(evidence.information(0, 0), 1 / (0.01 * 0.01)) << static_cast<int>(depth);
    }
}

TEST(IntrinsicsEvidence, TellsTheOtherParametersApart) {
  for (const Depth depth : kAllDepths)
    for (const auto& [parameter, value] :
         std::vector<std::pair<IntrinsicsEvidence::Parameter, double>>{
             {IntrinsicsEvidence::kAspect, 0.02},
             {IntrinsicsEvidence::kPrincipalX, 0.02},
             {IntrinsicsEvidence::kPrincipalY, -0.02},
             {IntrinsicsEvidence::kRadial, 0.02}}) {
      const SlidingWindow window = window_of(error(parameter, value), depth, 0.6);
      const Vector q = found(intrinsics_evidence(window.state(), depth == Depth::kMeasured));
      for (Eigen::Index i = 0; i < q.size(); ++i)
        EXPECT_NEAR(q[i], i == parameter ? value : 0,
                    i == IntrinsicsEvidence::kDepthOffset ? 0.03 : 0.007)
            << "parameter " << parameter << ", found " << i << ", " << static_cast<int>(depth);
    }
}

TEST(IntrinsicsEvidence, TellsTheOffsetOfADepthCamera) {
  const Vector q = error(IntrinsicsEvidence::kDepthOffset, 0.1);
  const SlidingWindow window = window_of(q, Depth::kMeasured, 0.6);
  EXPECT_NEAR(found(intrinsics_evidence(window.state(), true))[IntrinsicsEvidence::kDepthOffset],
              0.1, 0.02);
}

TEST(IntrinsicsEvidence, FindsNoErrorWhereThereIsNone) {
  for (const Depth depth : kAllDepths) {
    const SlidingWindow window = window_of(Vector::Zero(), depth, 0.6);
    EXPECT_LT(found(intrinsics_evidence(window.state(), depth == Depth::kMeasured)).norm(), 2e-4);
  }
}

TEST(IntrinsicsEvidence, SaysLessWhereTheCameraHardlyRotates) {
  const auto information = [](double rotation_rad) {
    const SlidingWindow window = window_of(Vector::Zero(), Depth::kNone, rotation_rad);
    IntrinsicsEvidence::Matrix I = intrinsics_evidence(window.state(), false).information;
    I.diagonal().tail<5>().array() += 1e4;
    return 1 / I.inverse()(0, 0);
  };
  EXPECT_LT(information(0.02), 0.1 * information(0.6));
}

TEST(IntrinsicsEvidence, AWindowWithoutPointsTellsNothing) {
  SlidingWindow window({}, camera_of(500));
  for (int k = 0; k < 2; ++k)
    window.add_keyframe(KeyframeId(k), SE3(SO3(), Eigen::Vector3d(k, 0, 0)));
  EXPECT_EQ(intrinsics_evidence(window.state(), false).information.norm(), 0);
}

}  // namespace intrinsics_evidence_test
}  // namespace placegraph
