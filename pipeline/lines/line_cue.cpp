#include <placegraph/frontend/lines/floor_from_lines.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/lines/line_cue.h>
#include <placegraph/pipeline/lines/line_prediction.h>
#include <placegraph/pipeline/lines/line_second_camera.h>
#include <placegraph/pipeline/lines/line_translation.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

SE3 beside(const SE3& T_odom_cam, const Eigen::Vector3d& second_in_cam) {
  return T_odom_cam * SE3(SO3(), second_in_cam);
}

}  // namespace

LineCue::LineCue(const LineCueOptions& options, const Calibration& calibration,
                 const StereoMatcherOptions& stereo)
    : options_(options), stereo_(stereo), calibration_(calibration), tracker_(options.tracker) {
  options_.check();
}

void LineCue::reset() {
  tracker_.reset();
  drift_px_.clear();
  observations_.clear();
  at_keyframe_.clear();
  covariances_.clear();
  calibrated_.clear();
  if (vanishing_tracker_) use_vanishing_directions();
}

/// With its uncertainty taken into account, a line whose plane hardly rotated is useful if few
/// better ones exist.
LineTriangulationOptions LineCue::triangulation(const SlidingWindow& window) const {
  // Lines that are followed. Chosen.
  constexpr int kFew = 15;
  // Minimum rotation of a line's plane if vanishing directions provide the camera's rotation: a
  // line then becomes useful much sooner. Chosen.
  constexpr double kMinRotationSteered_deg = 0.4;
  constexpr std::size_t kFewestSteered = 7;  // number of keyframes; not used during initialization
  LineTriangulationOptions options = options_.triangulation;
  if (vanishing_tracker_ && window.keyframes().size() > kFewestSteered && followed(window) < kFew)
    options.min_rotation_deg = std::min(options.min_rotation_deg, kMinRotationSteered_deg);
  return options;
}

void LineCue::use_vanishing_directions() {
  vanishing_tracker_.emplace(options_.initializer.directions);
}

/// Adds the rotation of a keyframe according to shared directions to the window.
void LineCue::steer(KeyframeId keyframe, const LineView& seen, SlidingWindow& window) {
  if (!vanishing_tracker_) return;
  // Uncertainty of the predicted rotation. Chosen.
  constexpr double kSigmaRad = 0.02;
  const SE3 T_odom_cam = window.pose(keyframe);
  SO3 R_odom_cam = T_odom_cam.rotation();
  const auto measured = vanishing_tracker_->read(calibration_.camera, seen, R_odom_cam, kSigmaRad);
  if (measured.outcome) {
    R_odom_cam = measured.R_ref_cam;
    PosePrior prior{keyframe, SE3(R_odom_cam, T_odom_cam.translation()), Matrix6d::Zero()};
    prior.information.bottomRightCorner<3, 3>() = measured.information;
    add_pose_prior(window, prior);
  }
  Random random(0, "vanishing directions", {keyframe.value()});
  vanishing_tracker_->learn(calibration_.camera, seen, R_odom_cam, random);
}

void LineCue::track(const Image& image, const SlidingWindow& window, const SE3& T_odom_cam,
                    double depth) {
  const std::vector<LineSegment> wanted = predict_segments(
      calibration_.camera, tracker_.tracks(), window, {T_odom_last_, T_odom_cam, depth}, drift_px_);
  T_odom_before_ = T_odom_last_;
  std::map<LineId, LineSegment> wanted_of;
  for (std::size_t i = 0; i < wanted.size(); ++i) wanted_of[tracker_.tracks()[i].id] = wanted[i];
  tracker_.track(image, wanted);
  std::map<LineId, double> drift_px;
  for (const LineTrack& track : tracker_.tracks()) {
    const LineSegment& w = wanted_of.at(track.id);
    const auto before = drift_px_.find(track.id);
    drift_px[track.id] = (before == drift_px_.end() ? 0 : before->second) +
                         w.offset_of(track.edge.line.foot(w.middle()));
  }
  drift_px_ = std::move(drift_px);
  follow_mergers();
}

/// Transfers the observations of a track that was merged into another.
void LineCue::follow_mergers() {
  for (const auto& [from, to] : tracker_.merged()) {
    if (!observations_.contains(to) && observations_.contains(from))
      observations_[to] = observations_[from];
    observations_.erase(from);
  }
}

/// The guess combined with the rotation from shared directions; nothing if they leave it
/// underdetermined.
std::optional<PoseGuess> LineCue::with_line_rotation(const PoseGuess& guess) const {
  const Eigen::Matrix3d known = guess.information.bottomRightCorner<3, 3>();
  const double weakest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(known).eigenvalues()[0];
  const double sigma_rad = weakest > 0 ? std::min(0.1, 1 / std::sqrt(weakest)) : 0.1;
  const auto measured =
      vanishing_tracker_->read(calibration_.camera, seen(), guess.T_ref_cam.rotation(), sigma_rad);
  // Standard deviation about the axis known worst with which directions are used. Chosen.
  constexpr double kKnownRad = 0.01;
  if (!measured.outcome ||
      !(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(measured.information).eigenvalues()[0] >
        1 / (kKnownRad * kKnownRad)))
    return std::nullopt;
  const Eigen::Matrix3d both = known + measured.information;
  const Eigen::Vector3d correction = both.ldlt().solve(
      measured.information * (guess.T_ref_cam.rotation().inverse() * measured.R_ref_cam).log());
  PoseGuess result{SE3(guess.T_ref_cam.rotation().plus(correction), guess.T_ref_cam.translation()),
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
    SeenLine seen{*line, track.edge.line.carriers(kSigmaFloor_px)};
    // The uncertainty of the line's position is added to that of the image.
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
  const auto steered = vanishing_tracker_ ? with_line_rotation(guess) : std::nullopt;
  PoseFromLinesOptions pose = options_.pose;
  // With a known rotation, three lines constrain the pose as well as six without.
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

void LineCue::add_to_window(LineId id, const LineInKeyframe& line_in_keyframe,
                            SlidingWindow& window) const {
  const double similar = std::sqrt(options_.similar_observations);
  LineObservation observation{line_in_keyframe.keyframe,
                              id,
                              line_in_keyframe.seen.first,
                              line_in_keyframe.seen.second,
                              similar * line_in_keyframe.seen.sigma_px,
                              line_in_keyframe.second};
  if (observation.second) observation.second->sigma_px *= similar;
  window.add_line_observation(observation);
}

void LineCue::observe(KeyframeId keyframe, const Frame& frame,
                      const RectificationError& rectification, double depth,
                      SlidingWindow& window) {
  T_odom_last_ = window.pose(keyframe);
  if (tracker_.image().empty()) {
    tracker_.track(frame.image);
    T_odom_before_ = T_odom_last_;
  }
  // Prefer edges that will remain visible for longer, because they provide more information.
  // The prediction is for this number of frames. Chosen.
  constexpr int kStayFrames = 10;
  SE3 T_later_now;
  for (int k = 0; k < kStayFrames; ++k)
    T_later_now = T_odom_last_.inverse() * T_odom_before_ * T_later_now;
  const std::vector<KnownDepth> known =
      known_depths(calibration_.camera, tracker_.tracks(), window, T_odom_last_);
  tracker_.detect(frame.mask, [&](const LineSegment& seen) {
    const double beside = depth_nearby(known, seen.middle().cast<float>(), depth);
    return moved_segment(calibration_.camera, seen, {beside, beside}, T_later_now, depth);
  });
  follow_mergers();
  std::vector<LineSegment> segments;
  for (const LineTrack& track : tracker_.tracks()) segments.push_back(track.edge.segment);
  const auto seconds =
      second_cameras(frame, segments, calibration_, rectification, stereo_, options_);
  std::map<LineId, LineInKeyframe> now;
  for (std::size_t i = 0; i < tracker_.tracks().size(); ++i) {
    const LineTrack& track = tracker_.tracks()[i];
    now[track.id] = {keyframe, track.edge.line.carriers(kSigmaFloor_px), seconds[i]};
  }
  steer(keyframe, this->seen(), window);
  add_observations(keyframe, now, window);
  at_keyframe_.clear();
  for (const LineTrack& track : tracker_.tracks()) at_keyframe_[track.id] = track.edge.segment;
}

/// Adds the newest observation of each track, and triangulates tracks of sufficient accuracy.
void LineCue::add_observations(KeyframeId keyframe, const std::map<LineId, LineInKeyframe>& all_now,
                               SlidingWindow& window) {
  const KeyframeId oldest = window.keyframes().front();
  const LineTriangulationOptions options = triangulation(window);
  LineObservations all;
  std::map<LineId, Eigen::Matrix4d> covariances;
  for (const auto& [id, now] : all_now) {
    std::vector<LineInKeyframe> views_of_line;
    for (const LineInKeyframe& s : observations_[id])
      if (s.keyframe >= oldest && s.keyframe < keyframe) views_of_line.push_back(s);
    views_of_line.push_back(now);
    std::vector<LineMeasurement> views;
    for (const LineInKeyframe& s : views_of_line) {
      views.push_back({window.pose(s.keyframe), s.seen});
      if (s.second)
        views.push_back({beside(window.pose(s.keyframe), s.second->second_in_cam),
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
      for (const LineInKeyframe& s : views_of_line) add_to_window(id, s, window);
      covariances[id] = place.covariance;
    }
    all[id] = std::move(views_of_line);
  }
  observations_ = std::move(all);
  covariances_ = std::move(covariances);
}

void LineCue::observe_earlier(KeyframeId keyframe, const LineView& seen, SlidingWindow& window) {
  std::map<LineId, LineInKeyframe> now;
  for (const auto& [id, line] : seen) now[id] = {keyframe, line.seen, std::nullopt};
  steer(keyframe, seen, window);
  add_observations(keyframe, now, window);
}

void LineCue::track_uninitialized(const Frame& frame, const SE3& T_odom_start) {
  T_odom_last_ = T_odom_start;
  constexpr double kAnyDepth = 1;
  track(frame.image, SlidingWindow({}, calibration_.camera), T_odom_start, kAnyDepth);
  tracker_.detect(frame.mask);
}

std::vector<SharedDirection> LineCue::shared_directions() const {
  std::vector<SharedDirection> shared;
  if (!vanishing_tracker_) return shared;
  for (const auto& cluster : vanishing_tracker_->clusters())
    shared.push_back({cluster.d_ref, cluster.sigma_rad});
  return shared;
}

void LineCue::constrain_translation(KeyframeId keyframe, double depth,
                                    SlidingWindow& window) const {
  if (!vanishing_tracker_) return;
  for (const MotionObservation& motion : translation_along_lines(
           window, calibration_.camera, vanishing_tracker_->clusters(), observations_, keyframe,
           depth, deg_to_rad(options_.triangulation.min_rotation_deg)))
    add_motion(window, motion);
}

std::vector<PlacedLine> LineCue::placed(const SlidingWindow& window) const {
  std::vector<PlacedLine> placed;
  for (const LineTrack& track : tracker_.tracks()) {
    const auto line = window.line(track.id);
    const auto covariance = covariances_.find(track.id);
    if (line && covariance != covariances_.end())
      placed.push_back({track.id, *line, covariance->second, track.edge.segment});
  }
  return placed;
}

std::vector<double> LineCue::flow_px() const {
  std::vector<double> result;
  for (const LineTrack& track : tracker_.tracks())
    if (const auto at = at_keyframe_.find(track.id); at != at_keyframe_.end())
      result.push_back(std::abs(track.edge.segment.offset_of(at->second.middle())));
  return result;
}

void LineCue::prune(SlidingWindow& window) {
  for (const LineId id : window.lines()) {
    const auto& observations = window.line_observations(id);
    const auto r = observations.empty() ? std::nullopt : residual_px(window, observations.back());
    if (r && r->cwiseAbs().maxCoeff() <= options_.outlier_px) continue;
    window.remove_line(id);
    observations_.erase(id);
  }
}

std::vector<DisparitySample> LineCue::disparity_samples(const SlidingWindow& window,
                                                        const RectificationError& rectification) {
  // Views of a line with a known depth. Chosen, as for points.
  constexpr std::size_t kViews = 4;
  std::vector<DisparitySample> samples;
  std::set<LineId> used;
  for (const LineId id : window.lines()) {
    if (calibrated_.contains(id)) {
      used.insert(id);
    } else if (window.line_observations(id).size() >= kViews) {
      if (const auto sample =
              disparity_of_line(window, id, calibration_, rectification, options_.triangulation)) {
        samples.push_back(*sample);
        used.insert(id);
      }
    }
  }
  calibrated_ = std::move(used);
  return samples;
}

void LineCue::revise_second_cameras(SlidingWindow& window, const RectificationError& before,
                                    const RectificationError& now) {
  const RectificationError more{now.offset_px - before.offset_px, now.by_x_px - before.by_x_px,
                                now.by_y_px - before.by_y_px};
  const auto revised = [&](const LineObservation::SecondCamera& second, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b) {
    return corrected(second, calibration_.camera, a, b, more);
  };
  for (auto& [id, views_of_line] : observations_)
    for (LineInKeyframe& s : views_of_line)
      if (s.second) s.second = revised(*s.second, s.seen.first, s.seen.second);
  for (const LineId id : window.lines()) {
    const std::vector<LineObservation> observations = window.line_observations(id);
    for (const LineObservation& o : observations)
      if (o.second)
        window.revise_second_camera(o.keyframe, id, revised(*o.second, o.start_px, o.end_px));
  }
}

}  // namespace placegraph
