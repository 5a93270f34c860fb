#include <placegraph/pipeline/cues/line_cue.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

SE3 beside(const SE3& T_odom_cam, const Eigen::Vector3d& eye_cam) {
  return T_odom_cam * SE3(SO3(), eye_cam);
}

constexpr double kNear = 0.05;  // of the median depth

/// Where a camera that has moved sees a segment whose ends are that deep: the part beyond
/// `least`; without length if none is.
LineSegment moved_segment(const Camera& camera, const LineSegment& seen, const double (&depths)[2],
                          const SE3& T_new_old, double least) {
  Eigen::Vector3d ends[2];
  for (int k = 0; k < 2; ++k) {
    const auto ray = camera.unproject(k == 0 ? seen.start : seen.end);
    ends[k] = T_new_old * Eigen::Vector3d(depths[k] * ray.value_or(Eigen::Vector3d::UnitZ()));
  }
  for (int k = 0; k < 2; ++k)
    if (ends[k].z() < least && ends[1 - k].z() > least)
      ends[k] = ends[1 - k] + (ends[1 - k].z() - least) / (ends[1 - k].z() - ends[k].z()) *
                                  (ends[k] - ends[1 - k]);
  const auto start = camera.project(ends[0]), end = camera.project(ends[1]);
  if (!start || !end || ends[0].z() <= 0.5 * least || ends[1].z() <= 0.5 * least) return {};
  return {*start, *end};
}

}  // namespace

void LineCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, LineCueOptions& o) {
  field.group("tracker", o.tracker, "lines followed over time");
  field.group("stereo", o.stereo, "lines in the right eye");
  field.group("triangulation", o.triangulation, "when a line's place is known");
  field.group("pose", o.pose, "pose of a frame from lines");
  field.group("start", o.start, "first views of a single eye without points");
  field.group("floor", o.floor, "metric scale from lines on the floor, without points");
  field("sigma_floor_px", o.sigma_floor_px, "no line is placed better across", {0.01, 10});
  field("alike_sightings", o.alike_sightings,
        "sightings of one edge in the window that are worth one independent one", {1, 1000});
  field("min_turn_steered_deg", o.min_turn_steered_deg,
        "triangulation.min_turn_deg where directions show the rotation", {0.01, 45});
  field("stay_frames", o.stay_frames,
        "an edge that the motion takes out of the image before is begun last", {0, 100});
  field("outlier_px", o.outlier_px, "a line that is missed by more is dropped", {0.5, 100});
}

LineCue::LineCue(const LineCueOptions& options, const Calibration& calibration,
                 const StereoMatcherOptions& stereo)
    : options_(options), stereo_(stereo), calibration_(calibration), tracker_(options.tracker) {
  options_.check();
}

void LineCue::reset() {
  tracker_.reset();
  drift_px_.clear();
  sightings_.clear();
  at_keyframe_.clear();
  covariances_.clear();
  calibrated_.clear();
  if (compass_) use_compass();
}

/// With what is not known of its place, a line that hardly turned is of use where few are better.
LineTriangulationOptions LineCue::triangulation(const SlidingWindow& window) const {
  constexpr int kFew = 15;
  constexpr std::size_t kFewestSteered = 7;  // keyframes: not to begin with
  LineTriangulationOptions options = options_.triangulation;
  if (compass_ && window.keyframes().size() > kFewestSteered && followed(window) < kFew)
    options.min_turn_deg = std::min(options.min_turn_deg, options_.min_turn_steered_deg);
  return options;
}

void LineCue::use_compass() { compass_.emplace(options_.start.directions); }

/// What directions say of a keyframe's rotation goes into the window.
void LineCue::steer(std::int64_t keyframe, const LineView& seen, SlidingWindow& window) {
  if (!compass_) return;
  constexpr double kSigmaRad = 0.02;
  const SE3 T_odom_cam = window.pose(keyframe);
  SO3 R_odom_cam = T_odom_cam.rotation();
  const auto heading = compass_->read(calibration_.camera, seen, R_odom_cam, kSigmaRad);
  if (heading.outcome) {
    R_odom_cam = heading.R_ref_cam;
    PosePrior prior{keyframe, SE3(R_odom_cam, T_odom_cam.translation()), Matrix6d::Zero()};
    prior.information.bottomRightCorner<3, 3>() = heading.information;
    add_pose_prior(window, prior);
  }
  Random random(0, static_cast<std::uint64_t>(keyframe));
  compass_->learn(calibration_.camera, seen, R_odom_cam, random);
}

/// What the lines of the window tell of depths in the newest image.
std::vector<KnownDepth> LineCue::known_depths(const SlidingWindow& window) const {
  std::vector<KnownDepth> known;
  for (const LineTrack& track : tracker_.tracks()) {
    const auto line = window.line(track.id);
    if (!line) continue;
    const LineSegment& s = track.edge.segment;
    for (const Eigen::Vector2d& px : {s.start, s.middle(), s.end}) {
      const auto z = depth_on_line(calibration_.camera, T_odom_last_, *line, px);
      if (z && *z > 0) known.push_back({px.cast<float>(), *z});
    }
  }
  return known;
}

/// Where the tracks should be seen from `T_odom_cam`: the points at their ends, on the line of the
/// window or as deep as those beside them (or at `depth`), moved; the latter go on to drift as they
/// did.
std::vector<LineSegment> LineCue::expected(const SlidingWindow& window, const SE3& T_odom_cam,
                                           double depth) const {
  const Camera& camera = calibration_.camera;
  const SE3 T_cam_last = T_odom_cam.inverse() * T_odom_last_;
  const std::vector<KnownDepth> known = known_depths(window);
  std::vector<LineSegment> result;
  for (const LineTrack& track : tracker_.tracks()) {
    const LineSegment& now = track.edge.segment;
    const auto line = window.line(track.id);
    const double beside = line ? depth : depth_nearby(known, now.middle().cast<float>(), depth);
    double depths[2];
    for (int k = 0; k < 2; ++k) {
      const auto z = line ? depth_on_line(camera, T_odom_last_, *line, k == 0 ? now.start : now.end)
                          : std::optional(beside);
      depths[k] = z && *z > 0 ? *z : depth;
    }
    LineSegment segment = moved_segment(camera, now, depths, T_cam_last, kNear * depth);
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
  T_odom_before_ = T_odom_last_;
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

/// The guess and what directions say of the rotation, weighted; nothing where they leave it open.
std::optional<PoseGuess> LineCue::with_heading(const PoseGuess& guess) const {
  const Eigen::Matrix3d known = guess.information.bottomRightCorner<3, 3>();
  const double weakest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(known).eigenvalues()[0];
  const double sigma_rad = weakest > 0 ? std::min(0.1, 1 / std::sqrt(weakest)) : 0.1;
  const auto heading =
      compass_->read(calibration_.camera, seen(), guess.T_ref_cam.rotation(), sigma_rad);
  constexpr double kKnownRad = 0.01;
  if (!heading.outcome ||
      !(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(heading.information).eigenvalues()[0] >
        1 / (kKnownRad * kKnownRad)))
    return std::nullopt;
  const Eigen::Matrix3d both = known + heading.information;
  const Eigen::Vector3d turn = both.ldlt().solve(
      heading.information * (guess.T_ref_cam.rotation().inverse() * heading.R_ref_cam).log());
  PoseGuess result{SE3(guess.T_ref_cam.rotation().plus(turn), guess.T_ref_cam.translation()),
                   guess.information};
  result.information.bottomRightCorner<3, 3>() = both;
  return result;
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
  const auto steered = compass_ ? with_heading(guess) : std::nullopt;
  PoseFromLinesOptions pose = options_.pose;
  // With the rotation known, three lines are as much as six without.
  if (steered) pose.ransac.min_inliers = std::min(pose.ransac.min_inliers, 3);
  return estimate_pose_from_lines(calibration_.camera, lines, pose, random,
                                  steered ? &*steered : &guess);
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
  const double alike = std::sqrt(options_.alike_sightings);
  LineObservation observation{sighting.keyframe,
                              id,
                              sighting.seen.first,
                              sighting.seen.second,
                              alike * sighting.seen.sigma_px,
                              sighting.second};
  if (observation.second) observation.second->sigma_px *= alike;
  window.add_line_observation(observation);
}

void LineCue::observe(std::int64_t keyframe, const Frame& frame,
                      const RectificationError& rectification, double depth,
                      SlidingWindow& window) {
  T_odom_last_ = window.pose(keyframe);
  if (tracker_.image().empty()) {
    tracker_.track(frame.image);
    T_odom_before_ = T_odom_last_;
  }
  // The longer an edge will be seen, the more it tells.
  SE3 T_later_now;
  for (int k = 0; k < options_.stay_frames; ++k)
    T_later_now = T_odom_last_.inverse() * T_odom_before_ * T_later_now;
  const std::vector<KnownDepth> known = known_depths(window);
  tracker_.detect(frame.mask, [&](const LineSegment& seen) {
    const double beside = depth_nearby(known, seen.middle().cast<float>(), depth);
    return moved_segment(calibration_.camera, seen, {beside, beside}, T_later_now, kNear * depth);
  });
  follow_mergers();
  const auto seconds = second_eyes(frame, rectification);
  std::map<std::int64_t, Sighting> now;
  for (std::size_t i = 0; i < tracker_.tracks().size(); ++i) {
    const LineTrack& track = tracker_.tracks()[i];
    now[track.id] = {keyframe, track.edge.line.carriers(options_.sigma_floor_px), seconds[i]};
  }
  steer(keyframe, this->seen(), window);
  add_sightings(keyframe, now, window);
  at_keyframe_.clear();
  for (const LineTrack& track : tracker_.tracks()) at_keyframe_[track.id] = track.edge.segment;
}

/// The newest sighting of each track, and of those that are known well enough a place.
void LineCue::add_sightings(std::int64_t keyframe, const std::map<std::int64_t, Sighting>& all_now,
                            SlidingWindow& window) {
  const std::int64_t oldest = window.keyframes().front();
  const LineTriangulationOptions options = triangulation(window);
  std::map<std::int64_t, std::vector<Sighting>> all;
  std::map<std::int64_t, Eigen::Matrix4d> covariances;
  for (const auto& [id, now] : all_now) {
    std::vector<Sighting> sightings;
    for (const Sighting& s : sightings_[id])
      if (s.keyframe >= oldest && s.keyframe < keyframe) sightings.push_back(s);
    sightings.push_back(now);
    std::vector<LineSighting> views;
    for (const Sighting& s : sightings) {
      views.push_back({window.pose(s.keyframe), s.seen});
      if (s.second)
        views.push_back({beside(window.pose(s.keyframe), s.second->eye_cam),
                         {s.second->start_px, s.second->end_px, s.second->sigma_px}});
    }
    const auto place = triangulate_line(calibration_.camera, views, options);
    if (window.line(id)) {
      add_to_window(id, now, window);
      if (place.outcome)
        covariances[id] = place.covariance;
      else if (covariances_.contains(id))
        covariances[id] = covariances_[id];
    } else if (place.outcome) {
      window.add_line(id, place.line_ref);
      for (const Sighting& s : sightings) add_to_window(id, s, window);
      covariances[id] = place.covariance;
    }
    all[id] = std::move(sightings);
  }
  sightings_ = std::move(all);
  covariances_ = std::move(covariances);
}

void LineCue::observe_earlier(std::int64_t keyframe, const LineView& seen, SlidingWindow& window) {
  std::map<std::int64_t, Sighting> now;
  for (const auto& [id, line] : seen) now[id] = {keyframe, line.seen, std::nullopt};
  steer(keyframe, seen, window);
  add_sightings(keyframe, now, window);
}

void LineCue::wait(const Frame& frame, const SE3& T_odom_start) {
  T_odom_last_ = T_odom_start;
  constexpr double kAnyDepth = 1;
  track(frame.image, SlidingWindow({}, calibration_.camera), T_odom_start, kAnyDepth);
  tracker_.detect(frame.mask);
}

void LineCue::prune(SlidingWindow& window) {
  for (const std::int64_t id : window.lines()) {
    const auto& observations = window.line_observations(id);
    const auto r = observations.empty() ? std::nullopt : residual_px(window, observations.back());
    if (r && r->cwiseAbs().maxCoeff() <= options_.outlier_px) continue;
    window.remove_line(id);
    sightings_.erase(id);
  }
}

}  // namespace placegraph
