#include <placegraph/backend/inertial/state_layout.h>
#include <placegraph/pipeline/flight/marker_sensor.h>

#include <algorithm>

namespace placegraph {
namespace {

using Eigen::Vector3d;

constexpr int kEnoughMarkers = 3;  // with so many, beacons are not searched for

/// Covariance of the state's pose, right tangent.
Matrix6d pose_covariance(const BodyState& state) {
  constexpr int kPart[] = {kPosition, kAttitude};
  Matrix6d covariance;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      covariance.block<3, 3>(3 * i, 3 * j) = state.covariance.block<3, 3>(kPart[i], kPart[j]);
  // The state's position error is in the axes of the world, the tangent in those of the body.
  Matrix6d J = Matrix6d::Identity();
  J.topLeftCorner<3, 3>() = state.T_world_body.rotation().matrix().transpose();
  return J * covariance * J.transpose();
}

}  // namespace

MarkerSensor::MarkerSensor(const MarkerSensorOptions& options, const Camera& camera,
                           const SE3& T_body_cam, const MarkerLayout& layout)
    : options_(options),
      camera_(camera),
      T_body_cam_(T_body_cam),
      beacons_world_(layout.beacons_world),
      filter_(options.markers, layout, camera, T_body_cam) {
  check_ranges(options_);
  if (!layout.markers.empty()) detector_.emplace(options_.detector, layout.dictionary);
}

/// The largest of the layout's markers that must be in view.
std::vector<ExpectedSquare> MarkerSensor::expected_squares(const BodyState& expected) const {
  std::vector<ExpectedSquare> squares =
      filter_.expected_squares(expected.T_world_body, pose_covariance(expected));
  const auto diagonal2 = [](const ExpectedSquare& square) {
    const SquareCorners& px = square.corners_px;
    return (px[2] - px[0]).squaredNorm() + (px[3] - px[1]).squaredNorm();
  };
  std::stable_sort(squares.begin(), squares.end(),
                   [&](const ExpectedSquare& a, const ExpectedSquare& b) {
                     return diagonal2(a) > diagonal2(b);
                   });
  if (static_cast<int>(squares.size()) > options_.max_markers)
    squares.resize(static_cast<std::size_t>(options_.max_markers));
  // A state that markers contradict is less certain than its covariance states.
  if (contradictions_ > 0)
    for (ExpectedSquare& square : squares) square.within_px.reset();
  return squares;
}

/// Whether any beacon may be in the image or just beyond its edge.
bool MarkerSensor::beacons_in_view(const BodyState& expected) const {
  // Margin for the error of the expected pose. Chosen.
  constexpr double kEdge_px = 40;
  const SE3 T_cam_world = (expected.T_world_body * T_body_cam_).inverse();
  return std::any_of(beacons_world_.begin(), beacons_world_.end(), [&](const Vector3d& beacon) {
    const auto px = camera_.project(T_cam_world * beacon);
    return px && camera_.contains(*px, -kEdge_px);
  });
}

MarkerDetections MarkerSensor::detect(const Image& image, const std::optional<BodyState>& expected,
                                      StageTimes& times) {
  const bool whole_image = !expected || ++images_since_found_ >= options_.search_interval;
  if (whole_image) images_since_found_ = 0;
  MarkerDetections found;
  if (detector_) {
    const auto span = times.measure("detect markers");
    found.markers = whole_image ? detector_->detect(image)
                                : detector_->detect_near(image, expected_squares(*expected));
  }
  if (!beacons_world_.empty() && static_cast<int>(found.markers.size()) < kEnoughMarkers &&
      (whole_image || beacons_in_view(*expected))) {
    const auto span = times.measure("detect beacons");
    found.beacons = detect_beacons(image, options_.beacons);
  }
  return found;
}

MarkerPoseEstimate MarkerSensor::estimate(const MarkerView& view,
                                          const BodyExpectation& expectation) {
  return filter_.observe(view, relies_on(expectation) ? &expectation : nullptr);
}

void MarkerSensor::report(const Outcome& accepted, bool markers_in_view) {
  if (accepted)
    contradictions_ = images_since_found_ = 0;
  else if (markers_in_view && accepted.code == Outcome::Code::kInconsistent)
    ++contradictions_;
}

}  // namespace placegraph
