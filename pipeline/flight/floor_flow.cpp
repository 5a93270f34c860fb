#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/flight/floor_flow.h>

#include <string>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kEnoughTracks = 0.7;  // share of the tracks; with fewer, corners are detected
/// Images between two detections, while tracks are being lost, and where the last detection found
/// few: a floor with few corners is unlikely to have more in the next image.
constexpr int kDetectionInterval = 2, kVainDetectionInterval = 5;

}  // namespace

FloorFlow::FloorFlow(const FloorFlowOptions& options, const Camera& camera, const SE3& T_body_cam,
                     double floor_z_m)
    : options_(options),
      camera_(camera),
      T_body_cam_(T_body_cam),
      floor_z_m_(floor_z_m),
      tracker_(options.tracker) {
  check_ranges(options_);
  camera_.check();
}

/// Predicted pixels of the tracked points on the floor in the next image; points that leave it keep
/// their position.
std::vector<Eigen::Vector2f> FloorFlow::predicted_px(const BodyState& previous,
                                                     const BodyState& expected) const {
  const SE3 T_world_1 = previous.T_world_body * T_body_cam_;
  const SE3 T_2_world = (expected.T_world_body * T_body_cam_).inverse();
  std::vector<Eigen::Vector2f> predicted;
  for (const PointTrack& track : tracker_.tracks()) {
    predicted.push_back(track.px);
    const auto ray_cam = camera_.unproject(track.px.cast<double>());
    if (!ray_cam) continue;
    const Vector3d ray = T_world_1.rotation() * *ray_cam;
    const double depth = (floor_z_m_ - T_world_1.translation().z()) / ray.z();
    if (!(depth > 0)) continue;
    const auto px = camera_.project(T_2_world * Vector3d(T_world_1.translation() + depth * ray));
    if (px && camera_.contains(*px)) predicted.back() = px->cast<float>();
  }
  return predicted;
}

std::vector<FlowVector> FloorFlow::flow_of_tracks(const Image& image) const {
  const double noise_grey = image_noise(image);
  const double least = options_.noise_px * options_.noise_px;
  std::vector<FlowVector> vectors;
  for (const PointTrack& track : tracker_.tracks()) {
    FlowVector vector;
    vector.kind = FlowVector::Kind::kFull;
    vector.px = track.px_previous.cast<double>();
    vector.flow = (track.px - track.px_previous).cast<double>();
    vector.covariance =
        track_covariance(image, track.px.cast<double>(), options_.tracker.window_px, noise_grey) +
        least * Eigen::Matrix2d::Identity();
    vectors.push_back(vector);
  }
  return vectors;
}

bool FloorFlow::detection_due() const {
  const auto left = static_cast<double>(tracker_.tracks().size());
  if (left >= kEnoughTracks * options_.tracker.max_tracks) return false;
  if (!last_detection_) return true;
  const bool lost = left < kEnoughTracks * static_cast<double>(last_detection_->tracks);
  return last_detection_->images_since >= (lost ? kDetectionInterval : kVainDetectionInterval);
}

std::vector<FlowVector> FloorFlow::track(const Image& image,
                                         const std::optional<BodyState>& previous,
                                         const std::optional<BodyState>& expected,
                                         StageTimes& times) {
  require(image.cols == camera_.width && image.rows == camera_.height,
          "FloorFlow: the image does not have the camera's size");
  std::vector<FlowVector> flow;
  {
    const auto span = times.measure("track");
    if (previous && expected && !tracker_.tracks().empty())
      tracker_.track(image, predicted_px(*previous, *expected), PointTracker::Search::kNear);
    else
      tracker_.track(image, {}, PointTracker::Search::kWide);
    flow = flow_of_tracks(image);
  }
  if (last_detection_) ++last_detection_->images_since;
  if (detection_due()) {
    const auto span = times.measure("detect corners");
    tracker_.detect();
    last_detection_ = Detection{tracker_.tracks().size(), 0};
  }
  return flow;
}

FloorFlowMeasurement FloorFlow::measure(const std::vector<FlowVector>& flow,
                                        const std::optional<BodyState>& previous,
                                        std::int64_t to_ns, const KnownRotation& rotation) const {
  using Code = Outcome::Code;
  FloorFlowMeasurement result;
  if (!previous) {
    result.outcome = Outcome::failure(Code::kNotAttempted, "the last image has no state");
    return result;
  }
  const SO3 R_cam_world = (previous->T_world_body * T_body_cam_).rotation().inverse();
  const VentralMotion motion =
      ventral_motion(derotate(camera_, flow, rotation), R_cam_world * -Vector3d::UnitZ());
  result.outcome = motion.outcome;
  result.inliers = motion.inliers;
  result.chi2_per_dof = motion.chi2_per_dof;
  if (motion.outcome && motion.inliers < options_.min_points)
    result.outcome = Outcome::failure(Code::kTooFewData,
                                      std::to_string(motion.inliers) + " points of the floor");
  if (!result.outcome || !options_.enabled) return result;
  const double common = options_.common_px / camera_.fx;
  result.observation = FlowMeasurement{
      previous->stamp_ns,   to_ns,
      motion.over_distance, motion.covariance + common * common * Matrix3d::Identity(),
      motion.J_rotation,    rotation.R_1_2,
      previous->gyro_bias};
  return result;
}

}  // namespace placegraph
