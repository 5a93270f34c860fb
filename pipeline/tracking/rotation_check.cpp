#include <placegraph/frontend/relative_pose/epipolar_error.h>
#include <placegraph/frontend/relative_pose/epipolar_refinement.h>
#include <placegraph/frontend/relative_pose/pose_2d2d.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/tracking/rotation_check.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Tracks from the previous image to this one.
struct Step {
  const Camera& camera;
  std::vector<Eigen::Vector2d> px_previous, px;
  std::vector<Eigen::Vector3d> x_previous, x;  // rays with z = 1

  Step(const Camera& of, const std::vector<PointTrack>& tracks) : camera(of) {
    for (const PointTrack& track : tracks) {
      const Eigen::Vector2d before = track.px_previous.cast<double>(),
                            now = track.px.cast<double>();
      const auto ray_before = camera.unproject(before), ray_now = camera.unproject(now);
      if (!ray_before || !ray_now) continue;
      px_previous.push_back(before);
      px.push_back(now);
      x_previous.push_back(*ray_before);
      x.push_back(*ray_now);
    }
  }

  /// Share of the tracks within a pixel of the epipolar lines of a motion.
  double explained(const SE3& T_previous_this) const {
    // A pixel, the deviation of a good track. Chosen.
    constexpr double kNear_px = 1;
    const EpipolarError error(camera, T_previous_this);
    int near = 0;
    for (std::size_t i = 0; i < px.size(); ++i)
      near += std::abs(error(x_previous[i], x[i])) < kNear_px;
    return static_cast<double>(near) / static_cast<double>(px.size());
  }
};

/// Covariance of the rotation of a motion whose length is held.
Eigen::Matrix3d rotation_covariance(const SE3& T, Matrix6d information) {
  const Eigen::Vector3d along = T.rotation().inverse() * T.translation();
  const double trace = information.trace();
  information.topLeftCorner<3, 3>() += trace * along * along.transpose();
  information += 1e-12 * trace * Matrix6d::Identity();
  return information.ldlt().solve(Matrix6d::Identity()).bottomRightCorner<3, 3>();
}

/// Squared difference of two rotations in units of its standard deviation.
double squared_difference(const SE3& T, const SE3& T_images, const Matrix6d& information) {
  // What the covariance leaves out: the errors of the camera model and of a rolling shutter.
  constexpr double kFloorRad = deg_to_rad(0.5);
  const Eigen::Vector3d difference = (T_images.rotation().inverse() * T.rotation()).log();
  const Eigen::Matrix3d covariance = rotation_covariance(T_images, information) +
                                     kFloorRad * kFloorRad * Eigen::Matrix3d::Identity();
  return difference.dot(covariance.ldlt().solve(difference));
}

}  // namespace

bool contradicts_rotation(const Camera& camera, const std::vector<PointTrack>& tracks,
                          const SE3& T_previous_this, const Pose2d2dOptions& options,
                          Random& random) {
  constexpr double kMoreTracks = 0.1;   // share of the tracks
  constexpr double kLeastChi2 = 6.251;  // 3 degrees of freedom, 90 %
  const Step step(camera, tracks);
  if (static_cast<int>(step.px.size()) < options.ransac.min_inliers) return false;
  const double explained = step.explained(T_previous_this);
  if (explained > 1 - kMoreTracks) return false;
  const Pose2d2dResult motion =
      estimate_pose_2d2d(camera, step.px_previous, step.px, options, random);
  if (!motion.outcome) return false;
  const auto contradicts = [&](const SE3& start) {
    Matrix6d information = Matrix6d::Zero();
    const SE3 T_images =
        refine_epipolar(camera, step.x_previous, step.x, motion.inliers, start, {}, &information);
    return step.explained(T_images) > explained + kMoreTracks &&
           squared_difference(T_previous_this, T_images, information) > kLeastChi2;
  };
  return std::ranges::all_of(motion.T_ref_cur, contradicts);
}

}  // namespace placegraph
