#include <placegraph/pipeline/line_cue.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

SE3 beside(const SE3& T_odom_cam, const Eigen::Vector3d& eye_cam) {
  return T_odom_cam * SE3(SO3(), eye_cam);
}

}  // namespace

void LineCueOptions::check() const {
  check_ranges(*this);
  tracker.check();
  stereo.check();
  pose.check();
}

void visit(OptionVisitor& field, LineCueOptions& o) {
  field.group("tracker", o.tracker, "lines followed over time");
  field.group("stereo", o.stereo, "lines in the right eye");
  field.group("triangulation", o.triangulation, "when a line's place is known");
  field.group("pose", o.pose, "pose of a frame from lines");
  field("sigma_floor_px", o.sigma_floor_px, "no line is placed better across", {0.01, 10});
  field("outlier_px", o.outlier_px, "a line that is missed by more is dropped", {0.5, 100});
}

LineCue::LineCue(const LineCueOptions& options, const Calibration& calibration,
                 const StereoMatcherOptions& stereo)
    : options_(options), stereo_(stereo), calibration_(calibration), tracker_(options.tracker) {
  options_.check();
}

void LineCue::reset() {
  tracker_.reset();
  sightings_.clear();
  at_keyframe_.clear();
  covariances_.clear();
  drift_px_.clear();
  calibrated_.clear();
}

/// Where the tracks should be seen from `T_odom_cam`: the points at their ends, on the line of the
/// window or at `depth`, moved; the latter go on to drift as they did.
std::vector<LineSegment> LineCue::expected(const SlidingWindow& window, const SE3& T_odom_cam,
                                           double depth) const {
  const Camera& camera = calibration_.camera;
  const SE3 T_cam_last = T_odom_cam.inverse() * T_odom_last_;
  std::vector<LineSegment> result;
  for (const LineTrack& track : tracker_.tracks()) {
    const LineSegment& now = track.edge.segment;
    const auto line = window.line(track.id);
    Eigen::Vector3d ends[2];
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d& px = k == 0 ? now.start : now.end;
      auto z = line ? depth_on_line(camera, T_odom_last_, *line, px) : std::optional(depth);
      if (!z || !(*z > 0)) z = depth;
      const auto ray = camera.unproject(px);
      ends[k] = T_cam_last * Eigen::Vector3d(*z * ray.value_or(Eigen::Vector3d::UnitZ()));
    }
    // The part before the camera.
    constexpr double kNear = 0.05;  // of the median depth
    const double least = kNear * depth;
    for (int k = 0; k < 2; ++k)
      if (ends[k].z() < least && ends[1 - k].z() > least)
        ends[k] = ends[1 - k] + (ends[1 - k].z() - least) / (ends[1 - k].z() - ends[k].z()) *
                                    (ends[k] - ends[1 - k]);
    const auto start = camera.project(ends[0]), end = camera.project(ends[1]);
    LineSegment segment;  // without length: cannot be seen
    if (start && end && ends[0].z() > 0.5 * least && ends[1].z() > 0.5 * least)
      segment = {*start, *end};
    if (const auto drift = drift_px_.find(track.id);
        !line && drift != drift_px_.end() && segment.length() > 1) {
      const Eigen::Vector2d across = drift->second * segment.normal();
      segment.start += across, segment.end += across;
    }
    result.push_back(segment);
  }
  return result;
}

void LineCue::track(const Image& image, const SlidingWindow& window, const SE3& T_odom_cam,
                    double depth) {
  const std::vector<LineSegment> wanted = expected(window, T_odom_cam, depth);
  std::map<std::int64_t, LineSegment> wanted_of;
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted_of[tracker_.tracks()[i].id] = wanted[i];
  tracker_.track(image, wanted);
  std::map<std::int64_t, double> drift_px;
  for (const LineTrack& track : tracker_.tracks()) {
    const LineSegment& w = wanted_of.at(track.id);
    const auto before = drift_px_.find(track.id);
    drift_px[track.id] = (before == drift_px_.end() ? 0 : before->second) +
                         w.offset_of(track.edge.line.foot(w.middle()));
  }
  drift_px_ = std::move(drift_px);
  follow_mergers();
}

/// What was known of a track that turned out to be part of another goes with it.
void LineCue::follow_mergers() {
  for (const auto& [from, to] : tracker_.merged()) {
    if (!sightings_.contains(to) && sightings_.contains(from)) sightings_[to] = sightings_[from];
    sightings_.erase(from);
  }
}

PoseFromLines LineCue::pose(const SlidingWindow& window, const PoseGuess& guess,
                            Random& random) const {
  std::vector<SeenLine> lines;
  for (const LineTrack& track : tracker_.tracks()) {
    const auto line = window.line(track.id);
    if (!line) continue;
    SeenLine seen{*line, track.edge.line.carriers(options_.sigma_floor_px)};
    // What is not known of the line's place counts as if it were the image's.
    Eigen::Matrix<double, 2, 4> J;
    const auto covariance = covariances_.find(track.id);
    if (covariance != covariances_.end() &&
        line_residual_px(calibration_.camera, guess.T_ref_cam, *line, seen.seen.first,
                         seen.seen.second, nullptr, &J))
      seen.seen.sigma_px = std::hypot(
          seen.seen.sigma_px,
          std::sqrt(std::max(0.0, 0.5 * (J * covariance->second * J.transpose()).trace())));
    lines.push_back(seen);
  }
  return estimate_pose_from_lines(calibration_.camera, lines, options_.pose, random, &guess);
}

void LineCue::accept(const SlidingWindow& window, const SE3& T_odom_cam) {
  T_odom_last_ = T_odom_cam;
  std::vector<bool> keep;
  for (const LineTrack& track : tracker_.tracks()) {
    const auto line = window.line(track.id);
    if (!line) {
      keep.push_back(true);
      continue;
    }
    const auto seen = track.edge.line.carriers();
    const auto r =
        line_residual_px(calibration_.camera, T_odom_cam, *line, seen.first, seen.second);
    keep.push_back(r && r->cwiseAbs().maxCoeff() < 2 * options_.pose.threshold_px);
  }
  tracker_.keep(keep);
}

void LineCue::add_to_window(std::int64_t id, const Sighting& sighting,
                            SlidingWindow& window) const {
  window.add_line_observation({sighting.keyframe, id, sighting.seen.first, sighting.seen.second,
                               sighting.seen.sigma_px, sighting.second});
}

void LineCue::observe(std::int64_t keyframe, const Frame& frame,
                      const RectificationError& rectification, SlidingWindow& window) {
  T_odom_last_ = window.pose(keyframe);
  if (tracker_.image().empty()) tracker_.track(frame.image);
  tracker_.detect(frame.mask);
  follow_mergers();
  const auto seconds = second_eyes(frame, rectification);
  const std::int64_t oldest = window.keyframes().front();
  std::map<std::int64_t, std::vector<Sighting>> all;
  std::map<std::int64_t, Eigen::Matrix4d> covariances;
  at_keyframe_.clear();
  for (std::size_t i = 0; i < tracker_.tracks().size(); ++i) {
    const LineTrack& track = tracker_.tracks()[i];
    at_keyframe_[track.id] = track.edge.segment;
    const Sighting now{keyframe, track.edge.line.carriers(options_.sigma_floor_px), seconds[i]};
    std::vector<Sighting> sightings;
    for (const Sighting& s : sightings_[track.id])
      if (s.keyframe >= oldest && s.keyframe < keyframe) sightings.push_back(s);
    sightings.push_back(now);
    std::vector<LineSighting> views;
    for (const Sighting& s : sightings) {
      views.push_back({window.pose(s.keyframe), s.seen});
      if (s.second)
        views.push_back({beside(window.pose(s.keyframe), s.second->eye_cam),
                         {s.second->start_px, s.second->end_px, s.second->sigma_px}});
    }
    const auto place = triangulate_line(calibration_.camera, views, options_.triangulation);
    if (window.line(track.id)) {
      add_to_window(track.id, now, window);
      if (place.outcome)
        covariances[track.id] = place.covariance;
      else if (covariances_.contains(track.id))
        covariances[track.id] = covariances_[track.id];
    } else if (place.outcome) {
      window.add_line(track.id, place.line_ref);
      for (const Sighting& s : sightings) add_to_window(track.id, s, window);
      covariances[track.id] = place.covariance;
    }
    all[track.id] = std::move(sightings);
  }
  sightings_ = std::move(all);
  covariances_ = std::move(covariances);
}

void LineCue::prune(SlidingWindow& window) {
  for (const std::int64_t id : window.lines()) {
    const auto& observations = window.line_observations(id);
    const auto r = observations.empty() ? std::nullopt : window.residual_px(observations.back());
    if (r && r->cwiseAbs().maxCoeff() <= options_.outlier_px) continue;
    window.remove_line(id);
    sightings_.erase(id);
  }
}

std::vector<double> LineCue::depths(const SlidingWindow& window) const {
  std::vector<double> result;
  for (const LineTrack& track : tracker_.tracks()) {
    const auto line = window.line(track.id);
    if (!line) continue;
    const auto z =
        depth_on_line(calibration_.camera, T_odom_last_, *line, track.edge.segment.middle());
    if (z && *z > 0) result.push_back(*z);
  }
  return result;
}

std::vector<double> LineCue::flow_px() const {
  std::vector<double> result;
  for (const LineTrack& track : tracker_.tracks())
    if (const auto at = at_keyframe_.find(track.id); at != at_keyframe_.end())
      result.push_back(std::abs(track.edge.segment.offset_of(at->second.middle())));
  return result;
}

int LineCue::followed(const SlidingWindow& window) const {
  int count = 0;
  for (const LineTrack& track : tracker_.tracks()) count += window.line(track.id).has_value();
  return count;
}

std::vector<FrameView::Line> LineCue::view(const SlidingWindow& window,
                                           const SE3& T_odom_cam) const {
  std::vector<FrameView::Line> lines;
  for (const LineTrack& track : tracker_.tracks()) {
    FrameView::Line seen{track.id, track.edge.segment, track.edge.line.carriers(), std::nullopt};
    if (const auto line = window.line(track.id))
      if (const auto r = line_residual_px(calibration_.camera, T_odom_cam, *line, seen.seen.first,
                                          seen.seen.second))
        seen.off_px = r->cwiseAbs().maxCoeff();
    lines.push_back(seen);
  }
  return lines;
}

}  // namespace placegraph
