#include <placegraph/frontend/features/triangulation.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/odometry/odometry.h>

#include <cmath>

// Points of the window: what tracks say of them, and which of them agree with it.

namespace placegraph {

/// `keep` tells which tracks do not contradict the pose: others slid off their point, or it moves.
Pose3d2dResult Odometry::pose_from_points(const SE3& prior, Random& random,
                                          std::vector<bool>& keep) const {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> px;
  std::vector<int> track_of;
  const auto& tracks = tracker_.tracks();
  for (int i = 0; i < static_cast<int>(tracks.size()); ++i)
    if (const auto point = window_.landmark(tracks[i].id)) {
      points.push_back(*point);
      px.push_back(tracks[i].px.cast<double>());
      track_of.push_back(i);
    }
  Pose3d2dResult pose =
      estimate_pose_3d2d(calibration_.camera, points, px, options_.pose, random, &prior);
  keep.assign(tracks.size(), true);
  if (!pose.outcome) return pose;
  const SE3 T_cam_odom = pose.T_ref_cam.inverse();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto projected = calibration_.camera.project(T_cam_odom * points[k]);
    keep[track_of[k]] = projected && (*projected - px[k]).norm() < 2 * options_.pose.threshold_px;
  }
  return pose;
}

void Odometry::add_observation(const Sighting2d& sighting, std::int64_t landmark,
                               const std::optional<DepthMeasurement>& depth) {
  WindowObservation observation;
  observation.keyframe = sighting.keyframe;
  observation.landmark = landmark;
  observation.px = sighting.px;
  observation.covariance_px = sighting.covariance;
  if (depth) {
    observation.inverse_depth = depth->inverse_depth;
    observation.sigma_inverse_depth = depth->sigma;
  }
  window_.add_observation(observation);
}

/// Where a point that the window does not hold yet lies [m], in the odometry frame: by its depth,
/// or where the rays of its sightings meet. Nothing where neither is sure enough.
std::optional<Eigen::Vector3d> Odometry::place_point(
    const Sighting2d& now, const std::vector<Sighting2d>& before,
    const std::optional<DepthMeasurement>& depth) const {
  const SE3 T_odom_cam = window_.pose(now.keyframe);
  // A depth is believed at once where it is known to a fifth.
  if (depth && depth->sigma < 0.2 * depth->inverse_depth) {
    const auto ray = calibration_.camera.unproject(now.px);
    if (!ray) return std::nullopt;
    return T_odom_cam * Eigen::Vector3d(*ray / depth->inverse_depth);
  }
  if (before.empty()) return std::nullopt;
  std::vector<Sighting> rays{{T_odom_cam, now.px}};
  for (const Sighting2d& s : before) rays.push_back({window_.pose(s.keyframe), s.px});
  const auto point = triangulate(calibration_.camera, rays, deg_to_rad(options_.min_parallax_deg),
                                 options_.outlier_px);
  if (!point.outcome) return std::nullopt;
  return point.point_ref;
}

void Odometry::observe_tracks(std::int64_t keyframe, const Frame& frame) {
  const auto span = times_.measure("triangulation");
  const auto depths = measure_depth(frame, window_.pose(keyframe));
  const std::int64_t oldest = window_.keyframes().front();
  std::map<std::int64_t, std::vector<Sighting2d>> seen;
  const auto& tracks = tracker_.tracks();
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const std::int64_t id = tracks[i].id;
    std::vector<Sighting2d> sightings;
    if (const auto old = sightings_.find(id); old != sightings_.end())
      for (const Sighting2d& s : old->second)
        if (s.keyframe >= oldest) sightings.push_back(s);
    // What a look errs by as it is warped and occluded changes slowly: later sightings err with
    // those before them, and so many independent ones there are not.
    const double alike = 1 + static_cast<double>(sightings.size());
    const Sighting2d now{keyframe, tracks[i].px.cast<double>(),
                         alike * tracks[i].covariance.cast<double>()};
    if (!window_.landmark(id))
      if (const auto point_odom = place_point(now, sightings, depths[i])) {
        window_.add_landmark(id, *point_odom);
        for (const Sighting2d& s : sightings) add_observation(s, id, std::nullopt);
      }
    if (window_.landmark(id)) add_observation(now, id, depths[i]);
    sightings.push_back(now);
    seen[id] = std::move(sightings);
  }
  sightings_ = std::move(seen);
}

/// Whether a landmark is no point of the scene: what is seen where one contour covers another moves
/// along with both, ever a little off.
bool Odometry::contradicts_itself(std::int64_t landmark) const {
  double sum_px = 0, sum_sigmas = 0;
  int views = 0;
  for (const WindowObservation& o : window_.observations(landmark)) {
    const auto px = window_.residual_px(o), sigmas = window_.residual_sigmas(o);
    if (!px || !sigmas) continue;
    sum_px += px->squaredNorm() / 2;
    sum_sigmas += sigmas->squaredNorm() / 2;
    ++views;
  }
  const double most_px = options_.misfit_px, most_sigmas = options_.misfit_sigmas;
  return views > 2 && sum_px > most_px * most_px * views &&
         sum_sigmas > most_sigmas * most_sigmas * views;
}

/// Removes the landmarks that do not fit; returns the depths of the others that are followed.
std::vector<double> Odometry::keep_fitting_landmarks() {
  std::map<std::int64_t, std::size_t> track_of;
  const auto& tracks = tracker_.tracks();
  for (std::size_t i = 0; i < tracks.size(); ++i) track_of[tracks[i].id] = i;
  std::vector<bool> keep(tracks.size(), true);
  std::vector<double> depths;
  const SE3 T_cam_odom = window_.pose(last_keyframe_).inverse();
  for (const std::int64_t id : window_.landmarks()) {
    const auto& observations = window_.observations(id);
    const auto track = track_of.find(id);
    const auto residual =
        observations.empty() ? std::nullopt : window_.residual_px(observations.back());
    const bool misfit = residual && contradicts_itself(id);
    if (!residual || residual->norm() > options_.outlier_px || misfit) {
      if (misfit && track != track_of.end()) keep[track->second] = false;
      window_.remove_landmark(id);
      sightings_.erase(id);
    } else if (track != track_of.end()) {
      depths.push_back((T_cam_odom * *window_.landmark(id)).z());
    }
  }
  tracker_.keep(keep);
  return depths;
}

}  // namespace placegraph
