#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_state.h>

#include "tests/support/scenes/window_world.h"

namespace placegraph::test {

/// A measurement that no part of the library knows: by how much farther from a plane the second of
/// two keyframes stands than the first, r = (n^T (t_b - t_a) - step) / sigma.
class StepAcrossPlaneFactor final : public SizedFactor<1, SE3, SE3, Plane3> {
 public:
  StepAcrossPlaneFactor(double step_m, double sigma_m) : step_(step_m), sigma_(sigma_m) {}

  bool compute(const SE3& T_map_a, const SE3& T_map_b, const Plane3& plane, Residual& r,
               Jacobians* J) const override {
    Eigen::Matrix3d J_normal;
    const Eigen::RowVector3d n = plane.normal(&J_normal).transpose();
    const Eigen::Vector3d t_a_b = T_map_b.translation() - T_map_a.translation();
    r[0] = (n * t_a_b - step_) / sigma_;
    if (!J) return true;
    std::get<0>(*J) << -n * T_map_a.rotation().matrix() / sigma_, 0, 0, 0;
    std::get<1>(*J) << n * T_map_b.rotation().matrix() / sigma_, 0, 0, 0;
    std::get<2>(*J) = t_a_b.transpose() * J_normal / sigma_;
    return true;
  }
  std::shared_ptr<const Factor> transformed(const Sim3& S_new_old) const override {
    return std::make_shared<StepAcrossPlaneFactor>(S_new_old.scale() * step_,
                                                   S_new_old.scale() * sigma_);
  }

 private:
  double step_, sigma_;
};

/// Four keyframes on a curve, a plane and a rectangular world.
struct FactorScene {
  static constexpr PlaneId kPlane{10};
  static constexpr ManhattanFrameId kManhattanFrame{20};
  std::vector<SE3> T_map_cam;
  Plane3 plane{{0.3, 1, 0.2}, 1.5};
  SO3 R_map_manhattan = SO3::exp({0.2, -0.3, 0.1});

  FactorScene() {
    for (int k = 0; k < 4; ++k)
      T_map_cam.emplace_back(SO3::exp({0.02 * k, 0.1 * k, -0.03}),
                             Eigen::Vector3d(0.2 * k * k, 0.1 * k, k));
  }

  SE3 motion(std::size_t from, std::size_t to) const {
    return T_map_cam[from].inverse() * T_map_cam[to];
  }

  /// The variables where they are; `disturbance` moves all keyframes but the first.
  SlidingWindow window(const SlidingWindowOptions& options, double disturbance = 0) const {
    SlidingWindow result(options, window_camera());
    Random random(5);
    for (std::size_t k = 0; k < T_map_cam.size(); ++k) {
      const double share = k == 0 ? 0 : disturbance;
      result.add_keyframe(KeyframeId(k),
                          T_map_cam[k] * random_motion(random, 0.1 * share, 0.01 * share));
    }
    result.add_plane(kPlane, plane);
    result.add_manhattan_frame(kManhattanFrame, R_map_manhattan);
    return result;
  }
};

inline Matrix6d motion_information() {
  Vector6d sigmas;
  sigmas << 0.02, 0.03, 0.05, 0.01, 0.02, 0.03;
  return sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
}

/// A measurement of every kind, off by about a standard deviation; the last is the made-up one. All
/// of them are of keyframe 1, two of keyframe 2 too.
inline std::vector<std::pair<std::string, WindowFactor>> factors_of_every_kind(
    const FactorScene& scene) {
  const SE3& T = scene.T_map_cam[1];
  const Eigen::Matrix3d information = 1e4 * Eigen::Vector3d(1, 2, 3).asDiagonal();
  const Vector6d off = (Vector6d() << 0.02, -0.03, 0.04, 0.01, -0.02, 0.02).finished();
  const Plane3 plane_cam = transform_to(T, scene.plane).plus({0.01, -0.008, 0.006});
  const double height_m = std::abs(scene.plane.distance_to(T.translation()));
  const double step_m =
      scene.plane.normal().dot(scene.T_map_cam[2].translation() - T.translation());
  const std::vector<WindowVariable> between{keyframe_variable(KeyframeId(1)),
                                            keyframe_variable(KeyframeId(2)),
                                            plane_variable(FactorScene::kPlane)};
  return {
      {"distance",
       window_factor(DistanceObservation{KeyframeId(1), KeyframeId(2),
                                         distance_m(T, scene.T_map_cam[2]) + 0.02, 0.02})},
      {"height",
       window_factor(HeightObservation{KeyframeId(1), FactorScene::kPlane, height_m - 0.03, 0.03})},
      {"plane",
       window_factor(PlaneObservation{KeyframeId(1), FactorScene::kPlane, plane_cam, information})},
      {"pose prior", window_factor(PosePrior{KeyframeId(1), T.plus(off), motion_information()})},
      {"world", window_factor(ManhattanObservation{
                    KeyframeId(1), FactorScene::kManhattanFrame,
                    T.rotation().inverse() * scene.R_map_manhattan * SO3::exp({0.01, 0.005, -0.01}),
                    information})},
      {"motion",
       window_factor(MotionObservation{KeyframeId(1), KeyframeId(2), scene.motion(1, 2).plus(off),
                                       motion_information()})},
      {"step across a plane",
       {std::make_shared<StepAcrossPlaneFactor>(step_m + 0.02, 0.02), between, true,
        WindowFactor::Length::kMeasured}},
  };
}

}  // namespace placegraph::test
