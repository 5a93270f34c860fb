#include <placegraph/graph/text/log_message.h>
#include <placegraph/pipeline/odometry/local_mapping.h>
#include <placegraph/pipeline/tracking/cue_list.h>

namespace placegraph {
namespace {

MetricScale make_scale(const OdometryOptions& options, const Calibration& calibration,
                       const LogSink& log) {
  const Cues cues = parse_cues(options.cues);
  MetricScale scale(log);
  if (metric_from_start(cues, calibration) || !calibration.camera_height_m) return scale;
  const double height_m = *calibration.camera_height_m;
  if (options.ground.enabled && cues.plane)
    scale.use_ground_plane(options.ground, calibration.camera, height_m);
  else if (cues.lines && !cues.points)
    scale.use_floor_lines(options.lines.floor, calibration.camera, height_m);
  return scale;
}

}  // namespace

LocalMapping::LocalMapping(const OdometryOptions& options, const Calibration& calibration,
                           LogSink log, StageTimes& times)
    : log_(std::move(log)),
      times_(times),
      masks_(times),
      scale_(make_scale(options, calibration, log_)) {
  const bool stereo = calibration.baseline_m > 0;
  if (stereo && options.rectification.enabled)
    rectifier_.emplace(options.rectification, calibration, options.points.tracker.sigma_px,
                       options.stereo.sigma_disparity_px);
  if (!stereo && calibration.depth && parse_cues(options.cues).points)
    rgbd_.emplace(calibration.camera, static_cast<std::size_t>(options.window.max_keyframes));
  // Stereo pairs would show distortion as an error of their rectification.
  if (calibration.baseline_m == 0 && parse_cues(options.cues).points)
    lens_window_ = static_cast<std::size_t>(options.window.max_keyframes) + 1;
}

RectificationError LocalMapping::rectification() const {
  return rectifier_ ? rectifier_->error() : RectificationError();
}

std::map<KeyframeId, Vector6d> LocalMapping::corrections() const {
  return rgbd_ ? rgbd_->corrections() : std::map<KeyframeId, Vector6d>();
}

void LocalMapping::assume(const std::optional<Assumptions>& assumptions) {
  masks_.trust(!assumptions || assumptions->street_surfaces);
  scale_.trust_height(!assumptions || assumptions->ground_height);
}

std::optional<LocalMapping::Added> LocalMapping::add(const Frame& frame, const SE3& T_odom_cam,
                                                     FrameTracker& tracker, LocalMap& map) {
  const KeyframeImages images = masks_.apply(frame);
  const auto T_odom_keyframe = tracker.prepare_keyframe(images, T_odom_cam, map);
  if (!T_odom_keyframe) return std::nullopt;
  const KeyframeId id = map.add_keyframe(*T_odom_keyframe, frame.stamp_ns);
  const std::optional<Vector6d> velocity = tracker.velocity();
  if (rgbd_ && velocity) rgbd_->add_keyframe(id, *velocity);
  tracker.observe(images, rectification(), map);
  NewKeyframe keyframe{id, images.frame, images.labels, FrameErrors()};
  Added added{std::move(keyframe), {}, measure_scale(images, tracker, map)};
  refine(tracker, map);
  if (rgbd_)
    added.keyframe.errors = {rgbd_->errors(), velocity.value_or(Vector6d(Vector6d::Zero()))};
  added.posed_again = tracker.finish_keyframe(added.rescale ? added.rescale->factor : 1, map);
  return added;
}

std::optional<Rescale> LocalMapping::measure_scale(const KeyframeImages& images,
                                                   FrameTracker& tracker, LocalMap& map) {
  if (!scale_.available()) return std::nullopt;
  const auto span = times_.measure("scale");
  return scale_.measure(images, {tracker.lines(), tracker.manhattan()}, map);
}

void LocalMapping::refine(FrameTracker& tracker, LocalMap& map) {
  const auto span = times_.measure("window");
  const Outcome optimized = map.optimize();
  if (!optimized) log(log_, LogLevel::kWarning, "window not optimized: {}", optimized.reason);
  if (rgbd_ && rgbd_->calibrate(map.window())) use_errors(*rgbd_, tracker, map);
  if (rgbd_) rgbd_->add_motions(map.window());
  map.update_poses(tracker.prune(map), tracker.corrects_rotations());
  calibrate(tracker, map);
  const auto leaving = times_.measure("marginalization");
  map.marginalize();
  tracker.settle(map);
}

/// The window was optimized with observations that have been corrected since.
void LocalMapping::use_errors(const RgbdCalibrator& rgbd, FrameTracker& tracker, LocalMap& map) {
  tracker.correct(rgbd.errors());
  const Outcome again = map.optimize();
  if (!again) log(log_, LogLevel::kWarning, "window not optimized: {}", again.reason);
  const RgbdErrors::Vector& q = rgbd.errors().values();
  log(log_, LogLevel::kDebug,
      "RGB-D camera: focal length off by {:.4f}, principal point by {:.4f}, {:.4f} focal lengths; "
      "readout {:.4f} s, depth time {:.4f} s, depths displaced by {:.4f}, {:.4f} focal lengths",
      q[RgbdErrors::kFocal], q[RgbdErrors::kPrincipalX], q[RgbdErrors::kPrincipalY],
      q[RgbdErrors::kReadout], q[RgbdErrors::kDepthTime], q[RgbdErrors::kDepthX],
      q[RgbdErrors::kDepthY]);
}

/// A single keyframe provides no information on the cameras.
void LocalMapping::calibrate(FrameTracker& tracker, LocalMap& map) {
  SlidingWindow& window = map.window();
  const std::size_t keyframes = window.keyframes().size();
  if (rectifier_ && keyframes > 1) {
    rectifier_->calibrate(window, tracker.lines());
    const RectificationError error = rectifier_->error();
    log(log_, LogLevel::kDebug, "rectification off by {:f} + {:f} x + {:f} y px", error.offset_px,
        error.by_x_px, error.by_y_px);
  }
  if (lens_window_ && keyframes > 1 && keyframes >= *lens_window_ && lens_.observe(window)) {
    const LensDistortion lens = lens_.estimate();
    log(log_, LogLevel::kDebug, "lens k1 = {:.4f} +- {:.4f}, effect {:.3f}, {:.2f} stretches",
        lens.k1, lens.sigma_k1, lens.effect, lens.stretches);
  }
}

}  // namespace placegraph
