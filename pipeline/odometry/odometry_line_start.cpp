#include <fmt/format.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/odometry/odometry.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Some of `n` views, the first and the last among them, evenly spaced.
std::vector<std::size_t> spread(std::size_t n, std::size_t most) {
  const std::size_t count = std::min(n, most);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(i * (n - 1) / (count - 1));
  return chosen;
}

/// Of the lines placed in the first view's frame, as it sees them.
std::vector<double> depths_of(const Camera& camera, const LineInitialization& start,
                              const LineView& first) {
  std::vector<double> depths;
  for (const auto& [id, line] : start.lines)
    if (const auto seen = first.find(id); seen != first.end())
      if (const auto z = depth_on_line(camera, SE3(), line, seen->second.segment.middle());
          z && *z > 0)
        depths.push_back(*z);
  return depths;
}

}  // namespace

/// A single eye without points waits for views of lines that tell how it moved: three at least.
OdometryUpdate Odometry::begin_with_lines(const Frame& frame) {
  OdometryUpdate update;
  lines_->wait(frame, T_odom_start_);
  LineView seen = lines_->seen();
  if (static_cast<int>(seen.size()) < options_.lines.start.min_lines) {
    update.reason = fmt::format("{} lines to follow, {} needed to begin", seen.size(),
                                options_.lines.start.min_lines);
    started_ = false;  // a dark or empty frame is nothing to begin with
    lines_->reset();
    return update;
  }
  update.reference = true;
  line_views_ = {{frame, std::move(seen)}};
  return update;
}

/// The chosen views as keyframes of the window, and their lines. False if the bundle adjustment
/// does not know how they lie to each other.
bool Odometry::place_line_views(const std::vector<std::size_t>& chosen,
                                const LineInitialization& start, double scale, double depth) {
  constexpr double kMostTurnedRad = 0.01;
  constexpr double kLeastKnown = 0.02;  // of the ratio of two lengths (logarithm)
  const std::int64_t first = next_keyframe_;
  const LineCue before = *lines_;
  for (const std::size_t v : chosen) {
    const SE3& T = start.T_ref_view[v];
    window_.add_keyframe(next_keyframe_, T_odom_start_ * T.scaled(scale));
    lines_->observe_earlier(next_keyframe_, line_views_[v].lines, window_);
    lines_->hold_course(next_keyframe_++, depth, window_);
  }
  last_keyframe_ = next_keyframe_ - 1;
  const auto known = [&] {
    return static_cast<int>(window_.lines().size()) >= options_.lines.start.ransac.min_inliers;
  };
  // Turns and ways that look alike are told apart by the directions.
  const auto turned_rad = [&](std::int64_t id, std::size_t v) {
    return ((T_odom_start_.rotation() * start.T_ref_view[v].rotation()).inverse() *
            window_.pose(id).rotation())
        .log()
        .norm();
  };
  constexpr int kRounds = 2;  // what is missed by lines is left out of the second
  for (int round = 0; round < kRounds && known(); ++round) refine_window();
  const std::int64_t middle = first + static_cast<std::int64_t>(chosen.size() / 2);
  if (known() && turned_rad(last_keyframe_, chosen.back()) < kMostTurnedRad &&
      window_.sigma_log_length_ratio(first, middle, last_keyframe_) < kLeastKnown)
    return true;
  window_ = empty_window();
  *lines_ = before;  // what contradicts a wrong start is no less worth following
  for (std::int64_t id = first; id < next_keyframe_; ++id) keyframe_poses_.erase(id);
  next_keyframe_ = first;
  last_keyframe_ = -1;
  return false;
}

OdometryUpdate Odometry::try_lines(const Frame& frame, const std::optional<SE3>& T_known) {
  constexpr std::size_t kKeyframes = 6, kLeastViews = 8, kMostViews = 60;
  OdometryUpdate update;
  lines_->wait(frame, T_odom_start_);
  line_views_.push_back({frame, lines_->seen()});
  int common = 0;
  for (const auto& [id, line] : line_views_.back().lines)
    common += line_views_.front().lines.contains(id);
  if (common < options_.lines.start.min_lines) {
    lines_->reset();
    line_views_.clear();
    return replace_reference(frame, T_known);
  }
  // While the camera stands still, a view more tells nothing more.
  if (line_views_.size() > kMostViews) line_views_.erase(line_views_.begin() + 1);
  update.reason = "waits for more views of the lines";
  if (line_views_.size() < kLeastViews) return update;
  std::vector<LineView> views;
  for (const LinesWaiting& view : line_views_) views.push_back(view.lines);
  Random random(seed_, frame.id);
  const LineInitialization start =
      initialize_from_lines(calibration_.camera, views, options_.lines.start, random);
  const std::vector<double> depths = depths_of(calibration_.camera, start, views.front());
  if (!start.outcome || depths.empty()) {
    log(log_, LogLevel::kDebug, "initialization waits: {}", start.outcome.reason);
    if (!start.outcome) update.reason = start.outcome.reason;
    return update;
  }
  // The unit is arbitrary until the floor shows it.
  double scale = kUnknownDepth / median_of(depths);
  if (in_known_map_ && T_known) {
    scale = (T_known->translation() - T_odom_start_.translation()).norm();
  } else if (in_known_map_ && !floor_ && !ground_) {
    update.reason = "nothing gives the map's unit";
    log(log_, LogLevel::kDebug, "initialization waits: {}", update.reason);
    return update;
  }
  const std::vector<std::size_t> chosen = spread(views.size(), kKeyframes);
  if (!(scale > 0) || !place_line_views(chosen, start, scale, scale * median_of(depths)))
    return update;
  const std::int64_t first = last_keyframe_ + 1 - static_cast<std::int64_t>(chosen.size());
  if (ground_ || floor_ || motion_) {
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      const Frame& of = line_views_[chosen[i]].frame;
      const std::int64_t id = first + static_cast<std::int64_t>(i);
      stamps_[id] = of.stamp_ns;
      if (ground_ && id < last_keyframe_) keyframe_frames_[id] = of;
    }
    measure_scale(frame, update);
    update.rescale.reset();  // nobody has heard of these keyframes yet
    refine_window();
  }
  for (std::size_t i = 0; i < chosen.size(); ++i)
    update.new_keyframes.push_back(
        {first + static_cast<std::int64_t>(i), line_views_[chosen[i]].frame});
  // Frames in between lie as they did to the keyframe before them.
  const double unit =
      (window_.pose(last_keyframe_).translation() - T_odom_start_.translation()).norm();
  for (std::size_t i = 0; i + 1 < chosen.size(); ++i) {
    const SE3& T_ref_before = start.T_ref_view[chosen[i]];
    const SE3 T_odom_before = window_.pose(first + static_cast<std::int64_t>(i));
    for (std::size_t v = chosen[i] + 1; v < chosen[i + 1]; ++v) {
      const SE3 T = T_ref_before.inverse() * start.T_ref_view[v];
      update.filled.emplace_back(line_views_[v].frame.id, T_odom_before * T.scaled(unit));
    }
  }
  const SE3 T_before_last =
      window_.pose(last_keyframe_ - 1).inverse() * window_.pose(last_keyframe_);
  const double steps = static_cast<double>(chosen.back() - chosen[chosen.size() - 2]);
  line_views_.clear();
  T_odom_last_ = window_.pose(last_keyframe_);
  T_last_cur_ = SE3::exp(T_before_last.log() / steps);
  velocity_known_ = true;
  landmarks_at_keyframe_ = lines_->followed(window_);
  frames_since_keyframe_ = 0;
  state_ = update.state = TrackingState::kTracking;
  update.T_odom_cam = T_odom_last_;
  update.keyframe = last_keyframe_;
  update.inliers = landmarks_at_keyframe_;
  return update;
}

/// Lines on the floor give the unit, and hold it.
void Odometry::measure_floor(OdometryUpdate& update) {
  const auto measured = floor_->measure(window_.pose(last_keyframe_), lines_->placed(window_),
                                        lines_->shared_directions(), scale_known_);
  constexpr std::int64_t kLong = 30;  // keyframes
  if (!measured && !scale_known_ && last_keyframe_ - first_keyframe_ == kLong)
    log(log_, LogLevel::kWarning,
        "no floor has given the unit in {} keyframes: camera_height_m is of no use so far, poses "
        "wait for it",
        kLong);
  if (!measured) return;
  const auto ids = window_.keyframes();
  const bool first = !scale_known_;
  if (first) set_scale(measured->factor, update);
  std::int64_t old = -1;  // the newest keyframe far enough away; the first, to begin with
  const Eigen::Vector3d here = window_.pose(last_keyframe_).translation();
  for (const std::int64_t id : ids) {
    const double length = (window_.pose(id).translation() - here).norm();
    if (length >= floor_->min_baseline_m() || (first && old < 0 && length > 0)) old = id;
  }
  if (old < 0) return;
  const double distance_m =
      (first ? 1 : measured->factor) * (window_.pose(old).translation() - here).norm();
  window_.add_distance({old, last_keyframe_, distance_m, measured->sigma_relative * distance_m});
  log(log_, LogLevel::kDebug, "floor: factor {:f} +- {:f}", measured->factor,
      measured->sigma_relative);
}

}  // namespace placegraph
