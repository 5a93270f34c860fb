#include <placegraph/frontend/features/triangulation.h>
#include <placegraph/frontend/flow/matched_displacements.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/cues/determined_rotation.h>
#include <placegraph/pipeline/cues/nearest_depth.h>
#include <placegraph/pipeline/cues/point_cue.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

/// RMS errors that remove a landmark and its track if both are exceeded. Chosen.
constexpr double kMisfit_px = 0.4, kMisfitSigmas = 1.5;

void add_observation(KeyframeId keyframe, LandmarkId landmark, const Eigen::Vector2d& px,
                     const Eigen::Matrix2d& covariance_px,
                     const std::optional<MeasuredInverseDepth>& depth, SlidingWindow& window) {
  WindowObservation observation;
  observation.keyframe = keyframe;
  observation.landmark = landmark;
  observation.px = px;
  observation.covariance_px = covariance_px;
  if (depth) {
    observation.inverse_depth = depth->value;
    observation.sigma_inverse_depth = depth->sigma;
    observation.surface_cam = depth->surface_cam;
  }
  window.add_observation(observation);
}

}  // namespace

PointCue::PointCue(const PointCueOptions& options, const Calibration& calibration,
                   const StereoMatcherOptions& stereo, StageTimes& times)
    : options_(options),
      camera_(calibration.camera),
      depth_camera_(calibration.baseline_m > 0 ? std::nullopt : calibration.depth),
      depth_(calibration, stereo),
      times_(times),
      tracker_(options.tracker) {}

void PointCue::track(const Image& image) { tracker_.track(image); }

void PointCue::reset() {
  tracker_.reset();
  observations_.clear();
}

/// Predicted pixels of the tracks from `T_odom_cam`: landmarks at their positions, other points at
/// the depth of neighbouring landmarks.
std::vector<Eigen::Vector2f> PointCue::predict(const SlidingWindow& window, const SE3& T_odom_last,
                                               const SE3& T_odom_cam, double median_depth) const {
  const SE3 T_cam_odom = T_odom_cam.inverse(), T_last_odom = T_odom_last.inverse();
  std::vector<std::optional<Eigen::Vector3d>> points;
  std::vector<KnownDepth> known;
  for (const PointTrack& track : tracks()) {
    points.push_back(window.landmark(track.id));
    if (!points.back()) continue;
    const double depth = (T_last_odom * *points.back()).z();
    if (depth > 0) known.push_back({track.px, depth});
  }
  std::vector<Eigen::Vector2f> predicted;
  for (std::size_t i = 0; i < tracks().size(); ++i) {
    const Eigen::Vector2f& px_last = tracks()[i].px;
    predicted.push_back(px_last);
    if (!points[i]) {
      const auto ray = camera_.unproject(px_last.cast<double>());
      if (!ray) continue;
      const double depth = depth_nearby(known, px_last, median_depth);
      points[i] = T_odom_last * Eigen::Vector3d(depth * *ray);
    }
    const Eigen::Vector3d p_cam = T_cam_odom * *points[i];
    auto px = camera_.project(p_cam);
    if (px && errors_.any()) *px += errors_.displacement_px(camera_, *px, p_cam, twist_);
    if (px && camera_.contains(*px, 2)) predicted.back() = px->cast<float>();
  }
  return predicted;
}

/// Where a pixel would be without the errors of a camera that moves by `twist`. `p_cam`: its point;
/// nothing: far off.
Eigen::Vector2d PointCue::corrected_px(const Eigen::Vector2d& px, const Vector6d& twist,
                                       const std::optional<Eigen::Vector3d>& p_cam) const {
  if (!errors_.any()) return px;
  // Depth of a track without a point: its displacement by translation vanishes. Chosen.
  constexpr double kFar_m = 1e3;
  const auto ray = camera_.unproject(px);
  if (p_cam && p_cam->z() > 0) return px - errors_.displacement_px(camera_, px, *p_cam, twist);
  return ray ? px - errors_.displacement_px(camera_, px, kFar_m * *ray, twist) : px;
}

/// The same of all tracks, one entry per track.
std::vector<Eigen::Vector2d> PointCue::corrected_px(const SlidingWindow& window,
                                                    const SE3& T_odom_cam) const {
  const SE3 T_cam_odom = T_odom_cam.inverse();
  std::vector<Eigen::Vector2d> px;
  for (const PointTrack& track : tracks()) {
    auto point = window.landmark(track.id);
    if (point) *point = T_cam_odom * *point;
    px.push_back(corrected_px(track.px.cast<double>(), twist_, point));
  }
  return px;
}

/// If the prediction of the last frame was accurate, the points of this one are searched nearby; if
/// half of the landmarks are not found in this manner, the camera has jerked, and they are searched
/// in a larger area. If that gives no pose, or one whose rotation is open, they are searched near
/// features that match.
PointCue::TrackedPose PointCue::follow(const Image& image, const SlidingWindow& window,
                                       const SE3& T_odom_last, const SE3& T_odom_expected,
                                       bool velocity_known, double median_depth, Random& random) {
  // Share of the landmarks that are inliers, and median error of the prediction, with which a
  // search near the predictions suffices. Chosen.
  constexpr double kEnough = 0.5, kNear_px = 4;
  const PointTracker before = tracker_;
  const auto predicted = predict(window, T_odom_last, T_odom_expected, median_depth);
  std::map<LandmarkId, Eigen::Vector2f> expected;
  for (std::size_t i = 0; i < predicted.size(); ++i) expected[tracks()[i].id] = predicted[i];
  const auto found = [&](Random& draws) {
    std::vector<double> errors_px;
    for (const PointTrack& track : tracks())
      errors_px.push_back((track.px - expected.at(track.id)).norm());
    prediction_error_px_ = errors_px.empty() ? kNear_px : median_of(errors_px);
    return pose(window, T_odom_expected, draws);
  };
  const auto search = [&](PointTracker::Search range) {
    const auto span = times_.measure("point tracking");
    tracker_.track(image, predicted, range);
    return found(random);
  };
  if (velocity_known && prediction_error_px_ < kNear_px) {
    const double landmarks = tracked_landmarks(window);
    TrackedPose near = search(PointTracker::Search::kNear);
    if (near.pose.outcome && static_cast<double>(near.pose.inliers.size()) > kEnough * landmarks)
      return near;
    tracker_ = before;
  }
  // Recordings in which every pose is right reach 0.3 degrees.
  constexpr double kMostSigmaDeg = 0.5;
  TrackedPose wide = search(PointTracker::Search::kWide);
  if (wide.pose.outcome && determines_rotation(wide.pose.information, kMostSigmaDeg)) return wide;
  const auto span = times_.measure("point tracking");
  const PointTracker wide_tracks = std::exchange(tracker_, before);
  const double wide_error_px = prediction_error_px_;
  if (Random draws = random; track_near_matches(tracker_, image))
    if (TrackedPose matched = found(draws);
        matched.pose.outcome &&
        (!wide.pose.outcome || matched.pose.inliers.size() > wide.pose.inliers.size()))
      return matched;
  tracker_ = wide_tracks;
  prediction_error_px_ = wide_error_px;
  return wide;
}

PointCue::TrackedPose PointCue::pose(const SlidingWindow& window, const SE3& T_odom_prior,
                                     Random& random) const {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> px;
  std::vector<int> track_of;
  const std::vector<Eigen::Vector2d> corrected = corrected_px(window, T_odom_prior);
  for (int i = 0; i < static_cast<int>(tracks().size()); ++i)
    if (const auto point = window.landmark(tracks()[i].id)) {
      points.push_back(*point);
      px.push_back(corrected[static_cast<std::size_t>(i)]);
      track_of.push_back(i);
    }
  TrackedPose result;
  result.landmarks = static_cast<int>(points.size());
  result.pose = estimate_pose_3d2d(camera_, points, px, options_.pose, random, &T_odom_prior);
  // Tracks that contradict the pose slid off their point, or the point moves.
  result.keep.assign(tracks().size(), true);
  if (!result.pose.outcome) return result;
  const SE3 T_cam_odom = result.pose.T_ref_cam.inverse();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto projected = camera_.project(T_cam_odom * points[k]);
    result.keep[track_of[k]] =
        projected && (*projected - px[k]).norm() < 2 * options_.pose.threshold_px;
  }
  return result;
}

std::map<LandmarkId, Eigen::Vector2d> PointCue::anchor() {
  std::map<LandmarkId, Eigen::Vector2d> before, drift_px;
  for (const PointTrack& track : tracks()) before[track.id] = track.px.cast<double>();
  tracker_.anchor();
  for (const PointTrack& track : tracks())
    drift_px[track.id] = track.px.cast<double>() - before.at(track.id);
  return drift_px;
}

void PointCue::drop_tracks_on_movable_objects(const Image& still) {
  if (still.empty()) return;
  const std::vector<bool> keep = used_by(still);
  if (std::ranges::count(keep, true) >= options_.min_unmasked_tracks) tracker_.keep(keep);
}

void PointCue::drop_masked(const Image& mask, SlidingWindow& window) {
  const std::vector<bool> keep = used_by(mask);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const LandmarkId id = tracks()[i].id;
    if (keep[i]) continue;
    if (window.landmark(id)) window.remove_landmark(id);
    observations_.erase(id);
  }
  tracker_.keep(keep);
}

/// One flag per track: whether its pixel is not 0 in the mask.
std::vector<bool> PointCue::used_by(const Image& mask) const {
  std::vector<bool> used;
  for (const PointTrack& track : tracks()) {
    const int u = std::clamp(static_cast<int>(std::lround(track.px.x())), 0, mask.cols - 1);
    const int v = std::clamp(static_cast<int>(std::lround(track.px.y())), 0, mask.rows - 1);
    used.push_back(mask.at<std::uint8_t>(v, u) != 0);
  }
  return used;
}

void PointCue::detect(const Image& mask, bool labelled, const Image& given_mask) {
  tracker_.detect(mask);
  if (labelled && static_cast<int>(tracks().size()) < options_.min_unmasked_tracks)
    tracker_.detect(given_mask);
}

std::vector<std::optional<MeasuredInverseDepth>> PointCue::measure_depth(
    const Frame& frame, const std::vector<Eigen::Vector2d>& at_px,
    const RectificationError& rectification, const SE3& T_odom_cam,
    const SlidingWindow& window) const {
  const auto span = times_.measure("depth of points");
  const SE3 T_cam_odom = T_odom_cam.inverse();
  std::vector<Eigen::Vector2f> px;
  std::vector<std::optional<double>> expected_px;
  for (std::size_t i = 0; i < tracks().size(); ++i) {
    const PointTrack& track = tracks()[i];
    px.push_back(at_px[i].cast<float>());
    expected_px.emplace_back();
    if (frame.right.empty()) continue;
    if (const auto point = window.landmark(track.id))
      expected_px.back() = depth_.disparity_px(T_cam_odom * *point, rectification);
  }
  if (depth_camera_)
    return depth_.measure_surfaces(frame, errors_.corrected(*depth_camera_, twist_), px);
  return depth_.measure(frame, rectification, px, expected_px);
}

/// Position [m] in the odometry frame of a point that is not yet in the window: from its depth, or
/// from the intersection of the rays of its observations. Nothing if neither is certain enough.
std::optional<Eigen::Vector3d> PointCue::place_point(
    KeyframeId keyframe, const Eigen::Vector2d& px, const std::vector<Observation>& before,
    const std::optional<MeasuredInverseDepth>& depth, const SlidingWindow& window) const {
  const SE3 T_odom_cam = window.pose(keyframe);
  // Maximum relative standard deviation of an inverse depth that alone determines a point.
  constexpr double kCertain = 0.2;
  if (depth && depth->sigma < kCertain * depth->value) {
    const auto ray = camera_.unproject(px);
    if (!ray) return std::nullopt;
    return T_odom_cam * Eigen::Vector3d(*ray / depth->value);
  }
  if (before.empty()) return std::nullopt;
  std::vector<PointMeasurement> rays{{T_odom_cam, px}};
  for (const Observation& o : before)
    rays.push_back({window.pose(o.keyframe), corrected_px(o.px, o.twist, std::nullopt)});
  const auto point =
      triangulate(camera_, rays, deg_to_rad(options_.min_parallax_deg), options_.outlier_px);
  if (!point.outcome) return std::nullopt;
  return point.point_ref;
}

void PointCue::observe(KeyframeId keyframe, const Frame& frame,
                       const RectificationError& rectification, SlidingWindow& window) {
  const auto span = times_.measure("triangulation");
  const std::vector<Eigen::Vector2d> px = corrected_px(window, window.pose(keyframe));
  const auto depths = measure_depth(frame, px, rectification, window.pose(keyframe), window);
  const KeyframeId oldest = window.keyframes().front();
  std::map<LandmarkId, std::vector<Observation>> all;
  for (std::size_t i = 0; i < tracks().size(); ++i) {
    const LandmarkId id = tracks()[i].id;
    std::vector<Observation> observations;
    if (const auto old = observations_.find(id); old != observations_.end())
      for (const Observation& o : old->second)
        if (o.keyframe >= oldest) observations.push_back(o);
    // The error of a patch that is warped or half occluded changes slowly: the observations of a
    // track are not independent, and their weight decreases with their number.
    const double correlated = 1 + static_cast<double>(observations.size());
    const Observation now{keyframe, tracks()[i].px.cast<double>(),
                          correlated * tracks()[i].covariance.cast<double>(), twist_};
    if (!window.landmark(id))
      if (const auto point_odom = place_point(keyframe, px[i], observations, depths[i], window)) {
        window.add_landmark(id, *point_odom);
        for (const Observation& o : observations)
          add_observation(
              o.keyframe, id,
              corrected_px(o.px, o.twist, window.pose(o.keyframe).inverse() * *point_odom),
              o.covariance_px, std::nullopt, window);
      }
    if (window.landmark(id))
      add_observation(keyframe, id, px[i], now.covariance_px, depths[i], window);
    observations.push_back(now);
    all[id] = std::move(observations);
  }
  observations_ = std::move(all);
}

void PointCue::observe_two_views(KeyframeId ref, KeyframeId cur,
                                 const std::vector<TwoViewPoint>& points, SlidingWindow& window) {
  for (const TwoViewPoint& p : points) {
    observations_[p.track] = {{ref, p.px_ref, p.covariance_px}, {cur, p.px_cur, p.covariance_px}};
    if (!p.point_odom) continue;
    window.add_landmark(p.track, *p.point_odom);
    for (const Observation& o : observations_[p.track])
      add_observation(o.keyframe, p.track, o.px, o.covariance_px, std::nullopt, window);
  }
}

void PointCue::observe_new_tracks(KeyframeId keyframe) {
  for (const PointTrack& track : tracks()) {
    auto& observations = observations_[track.id];
    if (observations.empty())
      observations.push_back({keyframe, track.px.cast<double>(), track.covariance.cast<double>()});
  }
}

/// Whether a landmark is no point of the scene: where one contour occludes another, their crossing
/// moves along with both, and every projection has a small error.
bool PointCue::contradicts_itself(LandmarkId landmark, const SlidingWindow& window) const {
  double sum_px = 0, sum_sigmas = 0;
  int views = 0;
  for (const WindowObservation& o : window.observations(landmark)) {
    const auto px = residual_px(window, o), sigmas = residual_sigmas(window, o);
    if (!px || !sigmas) continue;
    sum_px += px->squaredNorm() / 2;
    sum_sigmas += sigmas->squaredNorm() / 2;
    ++views;
  }
  return views > 2 && sum_px > kMisfit_px * kMisfit_px * views &&
         sum_sigmas > kMisfitSigmas * kMisfitSigmas * views;
}

std::vector<double> PointCue::prune(SlidingWindow& window, KeyframeId newest) {
  std::map<LandmarkId, std::size_t> track_of;
  for (std::size_t i = 0; i < tracks().size(); ++i) track_of[tracks()[i].id] = i;
  std::vector<bool> keep(tracks().size(), true);
  std::vector<double> depths;
  const SE3 T_cam_odom = window.pose(newest).inverse();
  for (const LandmarkId id : window.landmarks()) {
    const auto& observations = window.observations(id);
    const auto track = track_of.find(id);
    const auto residual =
        observations.empty() ? std::nullopt : residual_px(window, observations.back());
    const bool misfit = residual && contradicts_itself(id, window);
    if (!residual || residual->norm() > options_.outlier_px || misfit) {
      if (misfit && track != track_of.end()) keep[track->second] = false;
      window.remove_landmark(id);
      observations_.erase(id);
    } else if (track != track_of.end()) {
      depths.push_back((T_cam_odom * *window.landmark(id)).z());
    }
  }
  tracker_.keep(keep);
  return depths;
}

std::vector<std::pair<LandmarkId, Eigen::Vector2d>> PointCue::landmark_pixels(
    const SlidingWindow& window, const SE3& T_odom_cam) const {
  const std::vector<Eigen::Vector2d> corrected = corrected_px(window, T_odom_cam);
  std::vector<std::pair<LandmarkId, Eigen::Vector2d>> px;
  for (std::size_t i = 0; i < tracks().size(); ++i)
    if (window.landmark(tracks()[i].id)) px.emplace_back(tracks()[i].id, corrected[i]);
  return px;
}

std::vector<KnownPixel> PointCue::landmark_depths(const SlidingWindow& window,
                                                  KeyframeId keyframe) const {
  // Relative standard deviation of a landmark's depth. Chosen.
  constexpr double kSigmaShare = 0.03;
  const SE3 T_cam_odom = window.pose(keyframe).inverse();
  std::vector<KnownPixel> known;
  for (const PointTrack& track : tracks()) {
    const auto point = window.landmark(track.id);
    if (!point) continue;
    const Eigen::Vector3d p_cam = T_cam_odom * *point;
    if (!(p_cam.z() > 0)) continue;
    known.push_back({track.px, {p_cam / p_cam.z(), 1 / p_cam.z(), kSigmaShare / p_cam.z()}});
  }
  return known;
}

int PointCue::tracked_landmarks(const SlidingWindow& window) const {
  return static_cast<int>(std::count_if(
      tracks().begin(), tracks().end(),
      [&](const PointTrack& track) { return window.landmark(track.id).has_value(); }));
}

}  // namespace placegraph
