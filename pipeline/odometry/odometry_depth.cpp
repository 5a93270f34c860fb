#include <placegraph/frontend/features/depth_lookup.h>
#include <placegraph/pipeline/odometry/odometry.h>

#include <cmath>

namespace placegraph {

std::vector<std::optional<Odometry::DepthMeasurement>> Odometry::measure_depth(
    const Frame& frame, const SE3& T_odom_cam) const {
  const auto span = times_.measure("depth of points");
  std::vector<Eigen::Vector2f> px;
  for (const PointTrack& track : tracker_.tracks()) px.push_back(track.px);
  std::vector<std::optional<DepthMeasurement>> result(px.size());
  if (calibration_.baseline_m > 0 && !frame.right.empty()) {
    const double per_px = 1 / (calibration_.camera.fx * calibration_.baseline_m);
    const RectificationError error =
        rectification_ ? rectification_->error() : RectificationError();
    const auto disparities = match_stereo(frame.image, frame.right, px, options_.stereo,
                                          expected_disparities(T_odom_cam, error));
    for (std::size_t i = 0; i < px.size(); ++i) {
      const auto ray = calibration_.camera.unproject(px[i].cast<double>());
      if (!disparities[i] || !ray) continue;
      // Of points far away the noise may leave less than nothing; that is information like any
      // other.
      result[i] = {(*disparities[i] - error.at(ray->head<2>())) * per_px,
                   options_.stereo.sigma_disparity_px * per_px};
    }
  } else if (calibration_.depth && !frame.depth.empty()) {
    const auto depths = lookup_depth(frame.depth, calibration_.camera, *calibration_.depth, px);
    for (std::size_t i = 0; i < px.size(); ++i)
      if (depths[i]) result[i] = {1 / *depths[i], calibration_.depth->sigma_at_1m};
  }
  return result;
}

/// Of the tracks, where their landmarks are at that pose.
std::vector<std::optional<double>> Odometry::expected_disparities(
    const SE3& T_odom_cam, const RectificationError& error) const {
  const SE3 T_cam_odom = T_odom_cam.inverse();
  std::vector<std::optional<double>> expected;
  for (const PointTrack& track : tracker_.tracks()) {
    expected.emplace_back();
    const auto point = window_.landmark(track.id);
    if (!point) continue;
    const Eigen::Vector3d p_cam = T_cam_odom * *point;
    if (p_cam.z() > 0)
      expected.back() = calibration_.camera.fx * calibration_.baseline_m / p_cam.z() +
                        error.at(p_cam.head<2>() / p_cam.z());
  }
  return expected;
}

/// What the left eye's motion says of the newest disparity of a landmark: its inverse depth along
/// that ray by least squares over the other keyframes' pixels. Nothing where that is not sure to
/// twice the disparity's own noise.
std::optional<DisparitySample> Odometry::disparity_sample(std::int64_t landmark) const {
  const Camera& camera = calibration_.camera;
  const auto& observations = window_.observations(landmark);
  const WindowObservation& newest = observations.back();
  const auto ray = camera.unproject(newest.px);
  if (!newest.inverse_depth || !ray) return std::nullopt;
  const SE3 T_map_newest = window_.pose(newest.keyframe);
  // Of X = ray + w t, each pixel m of another view says X.x - m.x X.z = 0 and X.y - m.y X.z = 0.
  double cc = 0, cd = 0;
  for (const WindowObservation& other : observations) {
    const auto seen = camera.unproject(other.px);
    if (other.keyframe == newest.keyframe || !seen) continue;
    const SE3 T_other_newest = window_.pose(other.keyframe).inverse() * T_map_newest;
    const Eigen::Vector3d a = T_other_newest.rotation() * *ray, &t = T_other_newest.translation();
    // Divided by the depth, these are errors on the image plane.
    const double depth = a.z() + *newest.inverse_depth * t.z();
    if (!(depth > 0.1)) continue;
    const Eigen::Vector2d c = (t.head<2>() - seen->head<2>() * t.z()) / depth;
    const Eigen::Vector2d d = (seen->head<2>() * a.z() - a.head<2>()) / depth;
    cc += c.squaredNorm();
    cd += c.dot(d);
  }
  if (!(cc > 0)) return std::nullopt;
  const double px_per_inverse_depth = camera.fx * calibration_.baseline_m;
  const double sigma_motion =
      options_.tracker.sigma_px / camera.fx / std::sqrt(cc) * px_per_inverse_depth;
  const double sigma = options_.stereo.sigma_disparity_px;
  if (!(sigma_motion < 2 * sigma) || !(cd > 0)) return std::nullopt;
  const Eigen::Vector2d x = ray->head<2>();
  const double measured =
      *newest.inverse_depth * px_per_inverse_depth + rectification_->error().at(x);
  return DisparitySample{x, measured, cd / cc * px_per_inverse_depth,
                         std::hypot(sigma, sigma_motion)};
}

/// Landmarks that have been followed for a few keyframes tell, once each, what the eyes'
/// rectification is off by; all disparities in the window follow.
void Odometry::calibrate_eyes() {
  constexpr std::size_t kViews = 4;
  std::vector<DisparitySample> samples;
  std::set<std::int64_t> heard;
  std::vector<std::int64_t> fresh;
  for (const std::int64_t id : window_.landmarks()) {
    if (calibrated_.count(id)) {
      heard.insert(id);
    } else if (window_.observations(id).size() >= kViews) {
      if (const auto sample = disparity_sample(id)) {
        samples.push_back(*sample);
        fresh.push_back(id);
      }
    }
  }
  calibrated_ = std::move(heard);
  const RectificationError before = rectification_->error();
  if (lines_)
    for (const DisparitySample& sample : lines_->disparity_samples(window_, before))
      samples.push_back(sample);
  rectification_->add(samples);
  calibrated_.insert(fresh.begin(), fresh.end());
  revise_disparities(before);
  const RectificationError now = rectification_->error();
  log(log_, LogLevel::kDebug, "rectification off by {:f} + {:f} x + {:f} y px", now.offset_px,
      now.by_x_px, now.by_y_px);
}

void Odometry::revise_disparities(const RectificationError& before) {
  const RectificationError now = rectification_->error();
  const double per_px = 1 / (calibration_.camera.fx * calibration_.baseline_m);
  for (const std::int64_t id : window_.landmarks())
    for (const WindowObservation& o : window_.observations(id)) {
      const auto ray = calibration_.camera.unproject(o.px);
      if (!o.inverse_depth || !ray) continue;
      const Eigen::Vector2d x = ray->head<2>();
      const double revised = *o.inverse_depth + (before.at(x) - now.at(x)) * per_px;
      window_.revise_inverse_depth(o.keyframe, id, revised);
    }
  if (lines_) lines_->revise_eyes(window_, before, now);
}

}  // namespace placegraph
