#pragma once
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/loop_closer.h>
#include <placegraph/pipeline/odometry.h>
#include <placegraph/pipeline/place_mapper.h>

namespace placegraph {

struct SlamOptions {
  std::uint64_t seed = 0;  ///< of every random stream
  OdometryOptions odometry;
  LoopOptions loops;
  PlaceOptions places;
  IncrementalOptions pose_graph;
  int max_lost_frames = 10;  ///< then a new component of the map begins
  void check() const;
};
void visit(OptionVisitor& field, SlamOptions& options);

/// What became of one frame.
struct FrameResult {
  std::int64_t frame = 0;
  TrackingState state =
      TrackingState::kWaiting;   ///< waiting for the second view, tracking, or lost
  std::optional<SE3> T_map_cam;  ///< in the frame of `component`; nothing while unknown
  bool keyframe = false;
  int inliers = 0;
  int component = 0;
  int loops_accepted = 0;  ///< with this frame
};

/// The whole system: frames in, place graph and trajectory out.
///
///     Slam slam(options, calibration);
///     for (frame : frames) slam.add_frame(frame);
///     Map map = slam.finish();
///
/// Stereo if the calibration has a baseline, RGB-D if it has a depth camera, mono otherwise; mono
/// is metric if it has a camera height. Objects share nothing: any number may live in one process.
/// Same frames, options and libraries: same bits. Throws ArgumentError for options, calibration or
/// frames that break their contract (image of another size or type, stamps that do not increase).
class Slam {
 public:
  Slam(const SlamOptions& options, const Calibration& calibration, LogSink log = {});
  ~Slam();
  Slam(Slam&&) noexcept;
  Slam& operator=(Slam&&) noexcept;

  /// The camera's motion as other sensors measured it (wheels, a laser, inertial ones), stamps
  /// those of the frames; to be given before the first frame. It gives a single eye its unit, bears
  /// on the place graph as robust constraints, and carries on where nothing is seen.
  void set_motion(const MeasuredMotion& motion_cam);
  FrameResult add_frame(const Frame& frame);
  /// Map and trajectories as they stand; may be called between frames.
  Map snapshot() const;
  /// Optimizes once more and returns the map; neither it nor add_frame may be called afterwards.
  Map finish();
  /// The radial distortion that the images of one eye (or of a depth camera's) still show, though
  /// they should not; run_sequence begins again without it.
  const LensEstimator& lens() const;
  /// What the frontend sees in the last frame.
  FrameView view() const;
  /// CPU time that each stage has taken so far.
  const std::vector<StageTimes::Stage>& stages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace placegraph
