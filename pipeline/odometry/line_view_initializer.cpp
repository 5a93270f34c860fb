#include <fmt/format.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/odometry/line_view_initializer.h>

#include <algorithm>

namespace placegraph {
namespace {

/// At most `most` of `n` views, evenly spaced, including the first and the last.
std::vector<std::size_t> spread(std::size_t n, std::size_t most) {
  const std::size_t count = std::min(n, most);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(i * (n - 1) / (count - 1));
  return chosen;
}

/// Id of the n-th keyframe of a segment; its first keyframe has number 0.
KeyframeId nth_keyframe(const LocalMap& map, std::size_t n) {
  return KeyframeId(map.first().value() + static_cast<std::int64_t>(n));
}

}  // namespace

LineViewInitializer::LineViewInitializer(const OdometryOptions& options,
                                         const Calibration& calibration, std::uint64_t seed,
                                         FeatureTracker& tracker, LogSink log)
    : options_(options.lines.initializer),
      camera_(calibration.camera),
      seed_(seed),
      tracker_(tracker),
      log_(std::move(log)) {}

void LineViewInitializer::restart(const SE3& T_odom_cam) {
  T_odom_restart_ = T_odom_start_ = T_odom_cam;
  views_.clear();
}

/// Takes the frame as the first view.
Initialization LineViewInitializer::begin(const Frame& frame) {
  LineCue& lines = *tracker_.lines();
  lines.track_uninitialized(frame, T_odom_start_);
  LineView seen = lines.seen();
  if (static_cast<int>(seen.size()) < options_.min_lines) {
    lines.reset();  // a dark or empty frame cannot be the first view
    return Initialization::pending(Outcome::failure(
        Outcome::Code::kTooFewData,
        fmt::format("{} lines to follow, {} needed to begin", seen.size(), options_.min_lines)));
  }
  views_ = {{frame, std::move(seen)}};
  Initialization result;
  result.is_reference = true;
  result.T_odom_reference = T_odom_start_;
  return result;
}

Initialization LineViewInitializer::add(const Frame& frame, const std::optional<SE3>& T_known,
                                        LocalMap& map, LocalMapping& mapping) {
  // Keyframes of the first map, and views among which they are searched. Chosen.
  constexpr std::size_t kKeyframes = 6, kLeastViews = 8, kMostViews = 60;
  if (!started()) return begin(frame);
  LineCue& lines = *tracker_.lines();
  const LineCue before = lines;
  lines.track_uninitialized(frame, T_odom_start_);
  views_.push_back({frame, lines.seen()});
  if (!enough_in_common()) {
    Initialization result = replace_reference(frame, T_known, map);
    if (result.state == TrackingState::kLost) lines = before;
    return result;
  }
  // While the camera stands still, additional views provide no information.
  if (views_.size() > kMostViews) views_.erase(views_.begin() + 1);
  const Initialization pending = Initialization::pending(
      Outcome::failure(Outcome::Code::kTooFewData, "more views of the lines are needed"));
  if (views_.size() < kLeastViews) return pending;
  const LineInitialization start = motion_of_views();
  const std::vector<double> depths = depths_of(start);
  if (!start.outcome || depths.empty()) {
    log(log_, LogLevel::kDebug, "initialization pending: {}", start.outcome.reason);
    return start.outcome ? pending : Initialization::pending(start.outcome);
  }
  const auto scale = scale_of(median_of(depths), T_known, map, mapping);
  if (!scale) {
    const Outcome no_scale = no_scale_of_map();
    log(log_, LogLevel::kDebug, "initialization pending: {}", no_scale.reason);
    return Initialization::pending(no_scale);
  }
  const std::vector<std::size_t> chosen = spread(views_.size(), kKeyframes);
  if (!(*scale > 0) ||
      !add_keyframes(chosen, start, *scale, *scale * median_of(depths), map, mapping))
    return pending;
  return accept(chosen, start, map, mapping);
}

bool LineViewInitializer::enough_in_common() const {
  int common = 0;
  for (const auto& [id, line] : views_.back().lines) common += views_.front().lines.contains(id);
  return common >= options_.min_lines;
}

LineInitialization LineViewInitializer::motion_of_views() const {
  std::vector<LineView> lines;
  for (const View& view : views_) lines.push_back(view.lines);
  Random random(seed_, "line views", {views_.back().frame.id.value()});
  return initialize_from_lines(camera_, lines, options_, random);
}

/// Depths of the triangulated lines in the first view.
std::vector<double> LineViewInitializer::depths_of(const LineInitialization& start) const {
  std::vector<double> depths;
  const LineView& first = views_.front().lines;
  for (const auto& [id, line] : start.lines)
    if (const auto seen = first.find(id); seen != first.end())
      if (const auto z = depth_on_line(camera_, SE3(), line, seen->second.segment.middle());
          z && *z > 0)
        depths.push_back(*z);
  return depths;
}

/// Length in the map of the unit translation from the first to the last view; arbitrary until the
/// floor provides the scale. Nothing if the scale of the map requires a recognized view.
std::optional<double> LineViewInitializer::scale_of(double median_depth,
                                                    const std::optional<SE3>& T_known,
                                                    const LocalMap& map,
                                                    const LocalMapping& mapping) const {
  if (map.scale() == Scale::kFromMap) {
    if (T_known) return (T_known->translation() - T_odom_start_.translation()).norm();
    if (!mapping.scale().uses_floor_lines() && !mapping.scale().uses_ground_plane())
      return std::nullopt;
  }
  return LocalMap::kUnknownDepth / median_depth;
}

/// Adds the chosen views as keyframes with their lines; adds none and returns false if the bundle
/// adjustment does not determine their relative poses.
bool LineViewInitializer::add_keyframes(const std::vector<std::size_t>& chosen,
                                        const LineInitialization& start, double scale,
                                        double median_depth, LocalMap& map, LocalMapping& mapping) {
  constexpr int kRounds = 2;  // outliers are not used in the second round
  LineCue& lines = *tracker_.lines();
  const LineCue before = lines;
  const double depth_before = map.median_depth();
  for (const std::size_t v : chosen) {
    const KeyframeId id = map.add_keyframe(T_odom_start_ * start.T_ref_view[v].scaled(scale));
    lines.observe_earlier(id, views_[v].lines, map.window());
    lines.constrain_translation(id, median_depth, map.window());
  }
  const auto enough = [&] {
    return static_cast<int>(map.window().lines().size()) >= options_.ransac.min_inliers;
  };
  for (int round = 0; round < kRounds && enough(); ++round) mapping.refine(tracker_, map);
  if (enough() && motion_is_known(chosen, start, map)) return true;
  map.discard(depth_before);
  lines = before;  // lines that contradict a wrong initialization may still be valid
  return false;
}

bool LineViewInitializer::motion_is_known(const std::vector<std::size_t>& chosen,
                                          const LineInitialization& start,
                                          const LocalMap& map) const {
  // Rotation by the bundle adjustment against the directions, half a degree. Chosen.
  constexpr double kMostRotatedRad = 0.01;
  // Maximum standard deviation of the ratio of two lengths (logarithm).
  constexpr double kLeastKnown = 0.02;
  const SlidingWindow& window = map.window();
  const KeyframeId middle = nth_keyframe(map, chosen.size() / 2);
  // Similar effects of rotations and translations are distinguished by the directions, which the
  // bundle adjustment must not contradict.
  const SO3 R_odom_last = T_odom_start_.rotation() * start.T_ref_view[chosen.back()].rotation();
  const double rotated_rad =
      (R_odom_last.inverse() * window.pose(map.newest()).rotation()).log().norm();
  return rotated_rad < kMostRotatedRad &&
         sigma_log_length_ratio(window, map.first(), middle, map.newest()) < kLeastKnown;
}

Initialization LineViewInitializer::accept(const std::vector<std::size_t>& chosen,
                                           const LineInitialization& start, LocalMap& map,
                                           LocalMapping& mapping) {
  if (mapping.scale().available()) {
    for (std::size_t i = 0; i + 1 < chosen.size(); ++i)
      mapping.scale().remember(nth_keyframe(map, i), views_[chosen[i]].frame);
    const Frame& newest = views_.back().frame;
    mapping.measure_scale({newest, newest.mask, nullptr}, tracker_, map);  // not reported yet
    mapping.refine(tracker_, map);
  }
  Initialization begun;
  begun.state = TrackingState::kTracking;
  for (std::size_t i = 0; i < chosen.size(); ++i)
    begun.keyframes.push_back({nth_keyframe(map, i), views_[chosen[i]].frame});
  begun.posed = views_between(chosen, start, map);
  const SE3 T_before_last =
      map.window().pose(*map.before_newest()).inverse() * map.window().pose(map.newest());
  const double steps = static_cast<double>(chosen.back() - chosen[chosen.size() - 2]);
  begun.T_last_cur = SE3::exp(T_before_last.log() / steps);
  begun.inliers = tracker_.lines()->followed(map.window());
  tracker_.start_selection(begun.inliers);
  views_.clear();
  return begun;
}

/// Views between keyframes keep their pose relative to the previous keyframe.
std::vector<PosedFrame> LineViewInitializer::views_between(const std::vector<std::size_t>& chosen,
                                                           const LineInitialization& start,
                                                           const LocalMap& map) const {
  const double scale =
      (map.window().pose(map.newest()).translation() - T_odom_start_.translation()).norm();
  std::vector<PosedFrame> posed;
  for (std::size_t i = 0; i + 1 < chosen.size(); ++i) {
    const SE3& T_ref_before = start.T_ref_view[chosen[i]];
    const SE3 T_odom_before = map.window().pose(nth_keyframe(map, i));
    for (std::size_t v = chosen[i] + 1; v < chosen[i + 1]; ++v) {
      const SE3 T = T_ref_before.inverse() * start.T_ref_view[v];
      posed.emplace_back(views_[v].frame.id, T_odom_before * T.scaled(scale));
    }
  }
  return posed;
}

/// Replaces the first view by this frame when too few lines of the first view remain.
Initialization LineViewInitializer::replace_reference(const Frame& frame,
                                                      const std::optional<SE3>& T_known,
                                                      const LocalMap& map) {
  const Outcome outcome =
      Outcome::failure(Outcome::Code::kTooFewData,
                       "too few lines of the first view are left to estimate the motion");
  tracker_.lines()->reset();
  views_.clear();
  if (map.scale() == Scale::kFromMap && !T_known) {
    Initialization lost = Initialization::pending(outcome);
    lost.state = TrackingState::kLost;
    return lost;
  }
  T_odom_start_ = T_known.value_or(T_odom_restart_);
  Initialization result = begin(frame);
  if (result.outcome.reason.empty()) result.outcome = outcome;
  if (!result.is_reference) T_odom_start_ = T_odom_restart_;
  return result;
}

}  // namespace placegraph
