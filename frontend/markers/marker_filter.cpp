#include <placegraph/frontend/markers/marker_explanation.h>
#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace placegraph {
namespace {

using Code = Outcome::Code;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector6d difference(const SE3& from, const SE3& to) { return (from.inverse() * to).log(); }

/// Whether two poses agree within their covariances. If a filter weighs the estimate it may cover
/// both; without a filter the two must be almost equal.
bool indistinct(const MarkerHypothesis& a, const MarkerHypothesis& b, bool filtered) {
  const Vector6d d = difference(a.T_world_body, b.T_world_body);
  const Matrix6d S = a.covariance + b.covariance;
  constexpr double kSame_rad = kRadPerDeg;
  return d.dot(S.ldlt().solve(d)) < chi_squared_quantile(0.99, 6) &&
         (filtered || d.tail<3>().norm() < kSame_rad);
}

/// Merges two minima that agree within their covariances: mean and covariance of the mixture.
MarkerHypothesis mixture(const MarkerHypothesis& a, const MarkerHypothesis& b) {
  const double share =
      1 / (1 + std::exp(a.log_likelihood_sum - b.log_likelihood_sum));  // weight of b
  const Vector6d d = difference(a.T_world_body, b.T_world_body);
  MarkerHypothesis both = a.log_likelihood_sum >= b.log_likelihood_sum ? a : b;
  both.T_world_body = a.T_world_body.plus(share * d);
  both.covariance =
      (1 - share) * a.covariance + share * b.covariance + share * (1 - share) * d * d.transpose();
  return both;
}

}  // namespace

MarkerFilter::MarkerFilter(const MarkerFilterOptions& options, MarkerLayout layout,
                           const Camera& camera, const SE3& T_body_cam)
    : options_(options), layout_(std::move(layout)), camera_(camera), T_body_cam_(T_body_cam) {
  options_.check();
  camera_.check();
  require(!layout_.markers.empty() || !layout_.beacons_world.empty(),
          "MarkerFilter: the layout has neither markers nor beacons");
  for (const PlacedMarker& marker : layout_.markers)
    require(marker.side_m > 0,
            "MarkerFilter: marker " + std::to_string(marker.id) + " has no positive side");
}

/// Markers of the layout that are detected once: two with the same id are ambiguous.
std::vector<SeenSquare> MarkerFilter::known_squares(const MarkerView& view) const {
  std::vector<SeenSquare> squares;
  for (const MarkerObservation& observation : view.markers) {
    const auto same_id = [&](const auto& other) { return other.id == observation.id; };
    const auto placed = std::find_if(layout_.markers.begin(), layout_.markers.end(), same_id);
    if (placed == layout_.markers.end()) continue;
    if (std::count_if(view.markers.begin(), view.markers.end(), same_id) != 1) continue;
    SeenSquare square;
    square.corners_px = observation.corners_px;
    const auto corners = placed->corners_marker();
    for (int k = 0; k < 4; ++k) square.corners_ref[k] = placed->T_world_marker * corners[k];
    Eigen::Matrix<double, 8, 8> covariance = observation.covariance;
    covariance.diagonal().array() += options_.extra_sigma_px * options_.extra_sigma_px;
    const Eigen::LLT<Eigen::Matrix<double, 8, 8>> inverse(covariance);
    if (!covariance.allFinite() || inverse.info() != Eigen::Success) continue;
    square.information = inverse.solve(Eigen::Matrix<double, 8, 8>::Identity());
    squares.push_back(square);
  }
  return squares;
}

std::vector<MarkerHypothesis> MarkerFilter::explain(const MarkerView& view,
                                                    MarkerPoseEstimate& estimate,
                                                    const BodyExpectation* expected) const {
  const SE3 T_cam_body = T_body_cam_.inverse();
  std::optional<KnownCamera> known;
  if (expected && expected->state) {
    // Maps errors of the state's position and attitude to the right tangent of the camera's pose.
    const BodyState& state = *expected->state;
    Eigen::Matrix<double, 6, 15> J = Eigen::Matrix<double, 6, 15>::Zero();
    J.block<3, 3>(0, 0) = state.T_world_body.rotation().matrix().transpose();
    J.block<3, 3>(3, 6).setIdentity();
    J = T_cam_body.adjoint() * J;
    known = KnownCamera{state.T_world_body * T_body_cam_, J * state.covariance * J.transpose()};
  }
  const MarkerExplanations explanations =
      explain_markers(camera_, known_squares(view), view.beacons, layout_.beacons_world,
                      chi_squared_quantile(options_.gate, 8), options_.beacons, known);
  estimate.outcome = explanations.outcome;
  std::vector<MarkerHypothesis> hypotheses;
  for (const MarkerExplanation& explanation : explanations.found) {
    MarkerHypothesis hypothesis;
    hypothesis.T_world_body = explanation.pose.T_ref_cam * T_cam_body;
    hypothesis.covariance =
        T_body_cam_.adjoint() * explanation.pose.covariance * T_body_cam_.adjoint().transpose();
    hypothesis.chi2 = explanation.pose.chi2;
    hypothesis.followed = explanation.log_likelihood_sum;
    hypotheses.push_back(hypothesis);
    estimate.markers = std::max(estimate.markers, static_cast<int>(explanation.squares.size()));
    estimate.beacons = std::max(estimate.beacons, static_cast<int>(explanation.beacons.size()));
  }
  return hypotheses;
}

/// Adds the log-likelihoods of the previous views, the rotation, the vertical and the filter.
void MarkerFilter::weigh(const MarkerView& view, const BodyExpectation* expected,
                         std::vector<MarkerHypothesis>& hypotheses) const {
  // Errors of corners are correlated between views: earlier log-likelihoods lose weight with each.
  constexpr double kKept = 0.8;
  const double dt = 1e-9 * static_cast<double>(view.stamp_ns - last_ns_);
  for (MarkerHypothesis& hypothesis : hypotheses) {
    double before = hypotheses_.empty() ? 0 : -std::numeric_limits<double>::infinity();
    for (const MarkerHypothesis& parent : hypotheses_) {
      const SO3 R_parent = parent.T_world_body.rotation();
      const SO3 R_expected = view.rotation_body ? R_parent * *view.rotation_body : R_parent;
      const Vector3d rotation = (R_expected.inverse() * hypothesis.T_world_body.rotation()).log();
      const Vector3d translation =
          hypothesis.T_world_body.translation() - parent.T_world_body.translation();
      const double rotation_sigma = view.rotation_body ? options_.rotation_sigma_deg * kRadPerDeg
                                                       : options_.max_rotation_rad_s * dt;
      const double translation_sigma = options_.max_speed_m_s * dt;
      const Eigen::Matrix3d R = hypothesis.T_world_body.rotation().matrix();
      const Eigen::Matrix3d S_rotation =
          rotation_sigma * rotation_sigma * Eigen::Matrix3d::Identity() +
          parent.covariance.bottomRightCorner<3, 3>() +
          hypothesis.covariance.bottomRightCorner<3, 3>();
      const Eigen::Matrix3d S_translation =
          translation_sigma * translation_sigma * Eigen::Matrix3d::Identity() +
          R *
              Eigen::Matrix3d(hypothesis.covariance.topLeftCorner<3, 3>() +
                              parent.covariance.topLeftCorner<3, 3>()) *
              R.transpose();
      const double step =
          log_likelihood(rotation.dot(S_rotation.ldlt().solve(rotation)), 3) +
          log_likelihood(translation.dot(S_translation.ldlt().solve(translation)), 3);
      before = std::max(before, kKept * parent.followed + step);
    }
    hypothesis.followed += before;
    hypothesis.log_likelihood_sum = hypothesis.followed;
    if (view.force_body && view.force_body->norm() > 0) {
      const Vector3d up = hypothesis.T_world_body.rotation() * *view.force_body;
      const double angle = std::atan2(up.head<2>().norm(), up.z());
      hypothesis.log_likelihood_sum +=
          log_likelihood(std::pow(angle / (options_.gravity_sigma_deg * kRadPerDeg), 2), 2);
    }
  }
  if (!expected || !expected->deviation2) return;
  // If the filter's prediction contradicts all hypotheses the filter is lost and not used.
  std::vector<double> deviation2(hypotheses.size());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    const auto d2 =
        expected->deviation2({view.stamp_ns, hypotheses[i].T_world_body, hypotheses[i].covariance});
    if (!d2) return;
    deviation2[i] = *d2;
    least = std::min(least, *d2);
  }
  if (least > chi_squared_quantile(options_.gate, 6)) return;
  for (std::size_t i = 0; i < hypotheses.size(); ++i)
    hypotheses[i].log_likelihood_sum += log_likelihood(deviation2[i], 6);
}

MarkerPoseEstimate MarkerFilter::observe(const MarkerView& view, const BodyExpectation* expected) {
  MarkerPoseEstimate estimate;
  if (view.stamp_ns <= last_ns_ ||
      1e-9 * static_cast<double>(view.stamp_ns - last_ns_) > options_.memory_s)
    hypotheses_.clear();
  std::vector<MarkerHypothesis> hypotheses = explain(view, estimate, expected);
  if (hypotheses.empty()) return estimate;
  weigh(view, expected, hypotheses);
  const auto by_log_likelihood = [](const MarkerHypothesis& a, const MarkerHypothesis& b) {
    return a.log_likelihood_sum > b.log_likelihood_sum;
  };
  std::sort(hypotheses.begin(), hypotheses.end(), by_log_likelihood);
  const double best = hypotheses.front().log_likelihood_sum,
               best_followed = hypotheses.front().followed;
  std::erase_if(hypotheses, [&](const MarkerHypothesis& hypothesis) {
    return hypothesis.log_likelihood_sum < best - options_.decided_log_ratio;
  });
  for (MarkerHypothesis& hypothesis : hypotheses) {
    hypothesis.log_likelihood_sum -= best;
    hypothesis.followed -= best_followed;
  }
  hypotheses_ = estimate.hypotheses = hypotheses;
  last_ns_ = view.stamp_ns;

  MarkerHypothesis joined = hypotheses.front();
  for (std::size_t i = 1; i < hypotheses.size(); ++i) {
    if (!indistinct(hypotheses.front(), hypotheses[i], expected != nullptr)) {
      estimate.outcome =
          Outcome::failure(Code::kInconsistent,
                           std::to_string(hypotheses.size()) + " poses explain the observations");
      return estimate;
    }
    joined = mixture(joined, hypotheses[i]);
  }
  estimate.outcome = Outcome::ok();
  estimate.observation = {view.stamp_ns, joined.T_world_body, joined.covariance};
  return estimate;
}

std::vector<ExpectedSquare> MarkerFilter::expected_squares(const SE3& T_world_body,
                                                           const Matrix6d& covariance) const {
  // A marker is rarely farther off than this, if the layout is accurate to a few pixels.
  constexpr double kSigmas = 4, kLayout_px = 3;
  const SE3 T_body_world = T_world_body.inverse(), T_cam_body = T_body_cam_.inverse();
  std::vector<ExpectedSquare> squares;
  for (const PlacedMarker& marker : layout_.markers) {
    ExpectedSquare square;
    double variance_px2 = 0;
    int seen = 0;
    for (const Vector3d& corner : marker.corners_marker()) {
      const Vector3d p_body = T_body_world * (marker.T_world_marker * corner);
      Eigen::Matrix<double, 2, 3> J_px_cam;
      const auto px = camera_.project(T_cam_body * p_body, &J_px_cam);
      if (!px) break;
      Eigen::Matrix<double, 3, 6> J_body;
      J_body << -Eigen::Matrix3d::Identity(), hat(p_body);
      const Eigen::Matrix<double, 2, 6> J = J_px_cam * T_cam_body.rotation().matrix() * J_body;
      variance_px2 = std::max(variance_px2, (J * covariance * J.transpose()).trace());
      square.corners_px[seen++] = *px;
    }
    if (seen < 4) continue;
    square.within_px = kLayout_px + kSigmas * std::sqrt(variance_px2);
    // A marker that crosses the side of the image is not detected.
    const bool whole =
        std::all_of(square.corners_px.begin(), square.corners_px.end(),
                    [&](const Vector2d& px) { return camera_.contains(px, -*square.within_px); });
    if (whole) squares.push_back(square);
  }
  return squares;
}

}  // namespace placegraph
