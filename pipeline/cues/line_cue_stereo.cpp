#include <placegraph/frontend/lines/line_depth.h>
#include <placegraph/pipeline/cues/line_cue.h>

#include <cmath>

namespace placegraph {
namespace {

using SecondEye = LineObservation::SecondEye;

/// Where the line through two pixels crosses a row; it must not run along the rows.
double column_at(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double row) {
  return a.x() + (row - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

/// The seen right line moved by `error`, each of its points by that of its left partner.
SecondEye shifted(SecondEye second, const Camera& camera, const Eigen::Vector2d& left_a,
                  const Eigen::Vector2d& left_b, const RectificationError& error) {
  for (Eigen::Vector2d* px : {&second.start_px, &second.end_px}) {
    const Eigen::Vector2d left((column_at(left_a, left_b, px->y()) - camera.cx) / camera.fx,
                               (px->y() - camera.cy) / camera.fy);
    px->x() += error.at(left);
  }
  return second;
}

/// Of the depth of the line at a pixel, from the covariance of its place.
double depth_sigma(const Camera& camera, const SE3& T_ref_cam, const TriangulatedLine& line,
                   const Eigen::Vector2d& px, double depth) {
  constexpr double kStep = 1e-6;
  Eigen::Vector4d J;
  for (int k = 0; k < 4; ++k) {
    const auto moved =
        depth_on_line(camera, T_ref_cam, line.line_ref.plus(kStep * Eigen::Vector4d::Unit(k)), px);
    J[k] = moved ? (*moved - depth) / kStep : 0;
  }
  return std::sqrt(std::max(0.0, J.dot(line.covariance * J)));
}

}  // namespace

std::vector<std::optional<SecondEye>> LineCue::second_eyes(
    const Frame& frame, const RectificationError& rectification) const {
  std::vector<LineSegment> segments;
  for (const LineTrack& track : tracker_.tracks()) segments.push_back(track.edge.segment);
  std::vector<std::optional<SecondEye>> result(segments.size());
  if (calibration_.baseline_m > 0 && !frame.right.empty()) {
    const auto right = match_stereo_segments(frame.image, frame.right, segments, stereo_,
                                             options_.tracker.detector.refinement, options_.stereo);
    for (std::size_t i = 0; i < right.size(); ++i) {
      if (!right[i]) continue;
      const auto seen = right[i]->line.carriers(options_.sigma_floor_px);
      result[i] = shifted(
          {Eigen::Vector3d(calibration_.baseline_m, 0, 0), seen.first, seen.second, seen.sigma_px},
          calibration_.camera, segments[i].start, segments[i].end, rectification);
    }
  } else if (calibration_.depth && !frame.depth.empty()) {
    const auto depths =
        lookup_depth_along(frame.depth, calibration_.camera, *calibration_.depth, segments);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (!depths[i]) continue;
      const MadeUpEye eye = eye_from_depth(calibration_.camera, segments[i], *depths[i]);
      result[i] = {eye.eye_cam, eye.seen.first, eye.seen.second,
                   std::hypot(eye.seen.sigma_px, options_.sigma_floor_px)};
    }
  }
  return result;
}

/// What the left eye's motion says of the newest disparity of a line, in the middle of its
/// carriers.
std::optional<DisparitySample> LineCue::disparity_sample(
    const SlidingWindow& window, std::int64_t line, const RectificationError& rectification) const {
  const Camera& camera = calibration_.camera;
  const auto& observations = window.line_observations(line);
  const LineObservation& newest = observations.back();
  if (!newest.second) return std::nullopt;
  std::vector<LineSighting> views;
  for (const LineObservation& o : observations)
    views.push_back({window.pose(o.keyframe), {o.start_px, o.end_px, o.sigma_px}});
  const auto place = triangulate_line(camera, views, options_.triangulation);
  const Eigen::Vector2d px = 0.5 * (newest.start_px + newest.end_px);
  const SE3 T_odom_cam = window.pose(newest.keyframe);
  const auto z = place.outcome ? depth_on_line(camera, T_odom_cam, place.line_ref, px)
                               : std::optional<double>();
  if (!z || !(*z > 0)) return std::nullopt;
  const double fb = camera.fx * calibration_.baseline_m;
  const double sigma_motion = fb / (*z * *z) * depth_sigma(camera, T_odom_cam, place, px, *z);
  const Eigen::Vector2d along = (newest.end_px - newest.start_px).normalized();
  const double sigma = std::hypot(newest.sigma_px, newest.second->sigma_px) / std::abs(along.y());
  if (!(sigma_motion < 2 * sigma)) return std::nullopt;
  const Eigen::Vector2d ray((px.x() - camera.cx) / camera.fx, (px.y() - camera.cy) / camera.fy);
  const double disparity =
      px.x() - column_at(newest.second->start_px, newest.second->end_px, px.y());
  return DisparitySample{ray, disparity + rectification.at(ray), fb / *z,
                         std::hypot(sigma, sigma_motion)};
}

std::vector<DisparitySample> LineCue::disparity_samples(const SlidingWindow& window,
                                                        const RectificationError& rectification) {
  constexpr std::size_t kViews = 4;
  std::vector<DisparitySample> samples;
  std::set<std::int64_t> heard;
  for (const std::int64_t id : window.lines()) {
    if (calibrated_.contains(id)) {
      heard.insert(id);
    } else if (window.line_observations(id).size() >= kViews) {
      if (const auto sample = disparity_sample(window, id, rectification)) {
        samples.push_back(*sample);
        heard.insert(id);
      }
    }
  }
  calibrated_ = std::move(heard);
  return samples;
}

void LineCue::revise_eyes(SlidingWindow& window, const RectificationError& before,
                          const RectificationError& now) {
  const RectificationError more{now.offset_px - before.offset_px, now.by_x_px - before.by_x_px,
                                now.by_y_px - before.by_y_px};
  const auto revised = [&](const SecondEye& second, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
    return shifted(second, calibration_.camera, a, b, more);
  };
  for (auto& [id, sightings] : sightings_)
    for (Sighting& s : sightings)
      if (s.second) s.second = revised(*s.second, s.seen.first, s.seen.second);
  for (const std::int64_t id : window.lines()) {
    const std::vector<LineObservation> observations = window.line_observations(id);
    for (const LineObservation& o : observations)
      if (o.second)
        window.revise_second_eye(o.keyframe, id, revised(*o.second, o.start_px, o.end_px));
  }
}

}  // namespace placegraph
