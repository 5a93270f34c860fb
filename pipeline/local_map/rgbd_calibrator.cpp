#include <placegraph/backend/evidence/nuisance_equations.h>
#include <placegraph/pipeline/local_map/rgbd_calibrator.h>

#include <Eigen/Dense>
#include <algorithm>

namespace placegraph {
namespace {

using RgbdMatrix = Eigen::Matrix<double, RgbdErrors::kParameters, RgbdErrors::kParameters>;

/// Standard deviations: of the focal length, the principal point and the displacement of depths
/// relative to the focal length, of the readout time and the depth time [s].
RgbdErrors::Vector rgbd_sigmas(double intrinsics, double readout_s, double depth_time_s) {
  RgbdErrors::Vector result;
  result << intrinsics, intrinsics, intrinsics, readout_s, depth_time_s, intrinsics, intrinsics;
  return result;
}

/// Expected errors of a camera that nobody doubts.
RgbdErrors::Vector rgbd_prior() { return rgbd_sigmas(0.01, 0.02, 0.02); }
/// Each window has at least these errors of its own beside those of its noise.
RgbdErrors::Vector rgbd_window_errors() { return rgbd_sigmas(0.003, 0.002, 0.003); }

}  // namespace

Vector6d RgbdCalibrator::twist(KeyframeId keyframe) const {
  const auto known = twists_.find(keyframe);
  return known == twists_.end() ? Vector6d::Zero() : known->second;
}

NuisanceEquations RgbdCalibrator::equations(const WindowState& state) const {
  constexpr std::size_t kViews = 3;  // two views are consistent with nearly any errors
  const auto derivative_of = [this](const WindowObservation& o, const Eigen::Vector3d& p_cam,
                                    NuisanceEquations::Derivative& J) {
    J = RgbdErrors::derivative(camera_, o.px, p_cam, twist(o.keyframe), o.surface_cam);
  };
  NuisanceEquations equations(state, RgbdErrors::kParameters, derivative_of);
  for (const auto& [id, landmark] : state.landmarks) {
    const auto observations = usable_observations(state, landmark);
    if (observations.size() >= kViews) equations.add(observations, landmark.p_map);
  }
  return equations;
}

NuisanceEvidence RgbdCalibrator::evidence(const SlidingWindow& window) const {
  NuisanceEvidence result = equations(window.state()).evidence();
  // The observations are corrected by what is applied.
  result.gradient -= result.information * applied_.values();
  return result;
}

RgbdCalibrator::Estimate RgbdCalibrator::estimate(
    const std::optional<NuisanceEvidence>& newest) const {
  // Windows contradict each other beyond, and their own errors are doubled, up to 16 times. Chosen.
  constexpr double kMostDispersion = 1.5, kLargestOwn = 16;
  Estimate result;
  for (double own = 1; own <= kLargestOwn; own *= 2) {
    std::vector<NuisanceEvidence> windows;
    for (const NuisanceEvidence& window : windows_)
      windows.push_back(with_own_errors(window, own * rgbd_window_errors()));
    if (newest) windows.push_back(with_own_errors(*newest, own * rgbd_window_errors()));
    RgbdErrors::Vector gradient = RgbdErrors::Vector::Zero();
    RgbdMatrix information = rgbd_prior().cwiseAbs2().cwiseInverse().asDiagonal();
    for (const NuisanceEvidence& window : windows) {
      gradient += window.gradient;
      information += window.information;
    }
    result.covariance = information.inverse();
    result.errors = -result.covariance * gradient;
    double sum = 0, freedom = -static_cast<double>(RgbdErrors::kParameters);
    for (const NuisanceEvidence& window : windows)
      sum += squared_difference(window, result.errors, rgbd_prior(), freedom);
    result.dispersion = sum / std::max(1.0, freedom);
    if (result.dispersion < kMostDispersion) break;
  }
  result.covariance *= std::max(1.0, result.dispersion);
  return result;
}

bool RgbdCalibrator::calibrate(SlidingWindow& window) {
  constexpr std::size_t kFewest = 3;  // keyframes of the first window
  const auto keyframes = window.keyframes();
  std::erase_if(twists_, [&](const auto& entry) { return entry.first < keyframes.front(); });
  // The velocity of the first keyframe of a track is unknown.
  if (twists_.size() + 1 < keyframes.size()) return false;
  const bool apart = !newest_ || keyframes.front() > *newest_;
  if (keyframes.size() < kFewest || !apart) return false;
  const NuisanceEvidence now = evidence(window);
  const Estimate found = estimate(now);
  if (keyframes.size() >= full_) {
    windows_.push_back(now);
    newest_ = keyframes.back();
  }
  const RgbdErrors next = plausible(found.errors);
  const RgbdErrors change(next.values() - applied_.values());
  if (!change.any()) return false;
  applied_ = next;
  revise(change, window);
  return true;
}

/// The derivatives change little while the window moves on: they are computed twice for each
/// motion.
void RgbdCalibrator::add_motions(const SlidingWindow& window) {
  const auto keyframes = window.keyframes();
  if (keyframes.size() < 2 || twists_.size() + 1 < keyframes.size()) return;
  for (std::size_t i = 1; i < keyframes.size(); ++i)
    motions_[keyframes[i]].corrected = applied_.values();
  if (2 * ++since_motions_ < full_) return;
  since_motions_ = 0;
  const Eigen::MatrixXd poses = equations(window.state()).poses_by_parameters();
  for (std::size_t i = 1; i < keyframes.size(); ++i) {
    const SE3 T_to_from = window.pose(keyframes[i]).inverse() * window.pose(keyframes[i - 1]);
    const auto row = static_cast<Eigen::Index>(6 * i);
    motions_[keyframes[i]].by_errors =
        poses.middleRows<6>(row) - T_to_from.adjoint() * poses.middleRows<6>(row - 6);
  }
}

std::map<KeyframeId, Vector6d> RgbdCalibrator::corrections() const {
  std::map<KeyframeId, Vector6d> result;
  for (const auto& [to, motion] : motions_) {
    const Vector6d change = motion.by_errors * (applied_.values() - motion.corrected);
    if (!change.isZero(0)) result[to] = change;
  }
  return result;
}

/// An error of the intrinsics or a displacement of the depths beyond what a calibration errs by is
/// left to who calibrates: it may be the effect of something else.
RgbdErrors RgbdCalibrator::plausible(RgbdErrors::Vector errors) const {
  // Deviations of the prior: 95 % of calibrations. Chosen.
  constexpr double kMostSigmas = 2;
  constexpr Eigen::Index kIntrinsics = RgbdErrors::kReadout;
  const RgbdErrors::Vector doubt = errors.cwiseQuotient(rgbd_prior());
  if (doubt.head<kIntrinsics>().cwiseAbs().maxCoeff() > kMostSigmas)
    errors.head<kIntrinsics>().setZero();
  if (doubt.segment<2>(RgbdErrors::kDepthX).cwiseAbs().maxCoeff() > kMostSigmas)
    errors.segment<2>(RgbdErrors::kDepthX).setZero();
  return RgbdErrors(errors);
}

void RgbdCalibrator::revise(const RgbdErrors& change, SlidingWindow& window) const {
  for (const LandmarkId id : window.landmarks()) {
    const Eigen::Vector3d p_map = *window.landmark(id);
    const std::vector<WindowObservation> observations = window.observations(id);
    for (WindowObservation o : observations) {
      const Eigen::Vector3d p_cam = window.pose(o.keyframe).inverse() * p_map;
      if (!(p_cam.z() > 0)) continue;
      const Eigen::Vector3d moved =
          change.effect(camera_, o.px, p_cam, twist(o.keyframe), o.surface_cam);
      o.px -= moved.head<2>();
      if (o.inverse_depth) *o.inverse_depth -= moved.z();
      window.revise(o);
    }
  }
}

}  // namespace placegraph
