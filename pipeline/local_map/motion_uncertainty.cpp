#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/pipeline/local_map/motion_uncertainty.h>

#include <Eigen/Cholesky>
#include <algorithm>

namespace placegraph {
namespace {

/// Standard deviation of a stated length on which the scale rests (baseline, depth unit, height of
/// the camera), as a share of it. Nothing in a recording shows its error.
constexpr double kSigmaLength = 0.004;
/// No direction of a motion is more accurate than the stated noise by more than this share of the
/// variance: residuals of few landmarks scatter little by chance.
constexpr double kLeastShare = 0.25;

/// In the order of the parameters.
ImagingErrors::Vector imaging_sigmas(double focal, double aspect, double principal, double radial,
                                     double inverse_depth_1pm, double readout_s) {
  ImagingErrors::Vector result;
  result << focal, aspect, principal, principal, radial, inverse_depth_1pm, readout_s;
  return result;
}

/// Expected errors of a calibration that nobody doubts, and of a camera with a rolling shutter. The
/// error of the principal point is common to all edges of a run: it is stated rather too large.
ImagingErrors::Vector imaging_prior() {
  return imaging_sigmas(0.005, 0.001, 0.006, 0.005, 0.0005, 0.02);
}
/// Common error of the estimates of all windows, by rendered drives without and with errors: what
/// the model leaves out biases all of them in the same way.
ImagingErrors::Vector imaging_bias() {
  return imaging_sigmas(0.0025, 0.0005, 0.0025, 0.0025, 0.0001, 0.002);
}

}  // namespace

AssessedMotion AssessedMotion::scaled(double factor) const {
  AssessedMotion result = *this;
  for (Matrix6d* covariance : {&result.stated, &result.by_observations, &result.by_stamps}) {
    covariance->topRows<3>() *= factor;
    covariance->leftCols<3>() *= factor;
  }
  result.by_length.head<3>() *= factor;
  result.by_imaging_errors.topRows<3>() *= factor;
  return result;
}

AssessedMotion assess_motion(const SlidingWindow& window, KeyframeId from, KeyframeId to,
                             const Matrix6d& stated, bool metric) {
  const MotionErrors errors = motion_errors(window, from, to);
  const SE3 T_from_to = window.pose(from).inverse() * window.pose(to);
  const Eigen::Vector3d t_to = T_from_to.rotation().inverse() * T_from_to.translation();
  AssessedMotion motion;
  motion.stated = stated;
  motion.by_observations = rescaled_by_scatter(stated, errors, kLeastShare);
  motion.by_imaging_errors = errors.by_imaging_errors;
  if (metric) {
    motion.by_length.head<3>() = kSigmaLength * t_to;
  } else if (t_to.squaredNorm() > 0) {
    auto of_position = motion.by_imaging_errors.topRows<3>();
    of_position -= (t_to * (t_to.transpose() * of_position) / t_to.squaredNorm()).eval();
  }
  // A stamp that is late by dt moves its keyframe by its velocity times dt.
  const auto at_from = velocity_of(window.state(), from), at_to = velocity_of(window.state(), to);
  if (at_from && at_to) {
    const Vector6d by_from = T_from_to.inverse().adjoint() * *at_from;
    motion.by_stamps = by_from * by_from.transpose() + *at_to * at_to->transpose();
  }
  return motion;
}

ImagingErrors::Matrix MotionUncertainty::prior() {
  return imaging_prior().cwiseAbs2().asDiagonal();
}

void MotionUncertainty::add_window(const SlidingWindow& window) {
  const NuisanceEvidence evidence = imaging_evidence(window);
  if (!(evidence.information.trace() > 0) || !evidence.information.allFinite()) return;
  windows_.push_back(evidence);
  NuisanceEvidence sum{ImagingErrors::Vector::Zero(), ImagingErrors::Matrix::Zero()};
  for (const NuisanceEvidence& each : windows_) {
    sum.gradient += each.gradient;
    sum.information += each.information;
  }
  const auto covariance_with = [](const ImagingErrors::Matrix& information) {
    const ImagingErrors::Matrix prior = imaging_prior().cwiseAbs2().cwiseInverse().asDiagonal();
    return ImagingErrors::Matrix(
        (prior + information).llt().solve(ImagingErrors::Matrix::Identity()));
  };
  const ImagingErrors::Vector common = -covariance_with(sum.information) * sum.gradient;
  double squares = 0, freedom = -static_cast<double>(ImagingErrors::kParameters);
  for (const NuisanceEvidence& each : windows_)
    squares += squared_difference(each, common, imaging_prior(), freedom);
  dispersion_ = freedom > 0 ? std::max(1.0, squares / freedom) : 1;
  const NuisanceEvidence certain =
      with_own_errors({sum.gradient / dispersion_, sum.information / dispersion_}, imaging_bias());
  const ImagingErrors::Matrix covariance = covariance_with(certain.information);
  const ImagingErrors::Vector mean = -covariance * certain.gradient;
  second_moment_ = covariance + mean * mean.transpose();
}

void MotionUncertainty::add_frame(std::int64_t stamp_ns, const SE3& T_odom_cam) {
  jitter_.add(stamp_ns, T_odom_cam);
}

Matrix6d MotionUncertainty::covariance(const AssessedMotion& motion) const {
  const SharedErrors shared = by_shared_errors(motion);
  return independent_covariance(motion) + shared * shared.transpose();
}

Matrix6d MotionUncertainty::independent_covariance(const AssessedMotion& motion) const {
  const double sigma_s = jitter_.sigma_s();
  return dispersion_ * motion.by_observations + sigma_s * sigma_s * motion.by_stamps;
}

SharedErrors MotionUncertainty::by_shared_errors(const AssessedMotion& motion) const {
  SharedErrors result;
  result << motion.by_imaging_errors * ImagingErrors::Matrix(second_moment_.llt().matrixL()),
      motion.by_length;
  return result;
}

}  // namespace placegraph
