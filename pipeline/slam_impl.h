#pragma once
#include <placegraph/pipeline/slam.h>

namespace placegraph {

/// What Slam keeps; its steps stand in slam.cpp, what it does where tracking breaks off in
/// slam_recovery.cpp.
struct Slam::Impl {
  Impl(const SlamOptions& o, const Calibration& c, LogSink l)
      : options(o),
        calibration(c),
        log_sink(std::move(l)),
        odometry(o.odometry, c, o.seed, log_sink, times),
        closer(o.loops, c, o.seed),
        mapper(o.places, o.pose_graph),
        surroundings(o.context.filter) {}

  FrameResult add_frame(const Frame& frame);
  void check_frame(const Frame& frame) const;
  void recover(const Frame& frame, std::optional<Loop> located, OdometryUpdate& update);
  std::optional<Loop> carried(const Frame& frame) const;
  std::optional<Loop> turned(const OdometryUpdate& update) const;
  void add_motion(std::int64_t keyframe);
  void record_pose(std::int64_t keyframe, const SE3& T_keyframe_cam, FrameResult& result);
  SE3 T_map_located(const Loop& located) const;
  void add_keyframes(const OdometryUpdate& update, FrameResult& result);
  void add_keyframe(const NewKeyframe& keyframe, FrameResult& result);
  void refresh_links();
  void look_around(const NewKeyframe& keyframe);
  void label_environments(std::vector<Place>& places) const;
  void close_loops(FrameResult& result);
  void report(const IncrementalStep& step) const;
  void apply(const Rescale& rescale);
  FrameRecord* record_of(std::int64_t frame);
  void keep_view(std::int64_t keyframe, const Frame& frame);
  void go_on_from(const Map& map, const PlaceHistory& history, const Frame& last);
  Keyframe keyframe_of(const LoopCloser::View& view) const;
  std::vector<PointLandmark> landmarks(std::size_t first) const;
  MapChanges take_changes();
  Map snapshot() const;

  SlamOptions options;
  Calibration calibration;
  LogSink log_sink;
  StageTimes times;
  Odometry odometry;
  LoopCloser closer;
  PlaceMapper mapper;

  std::vector<FrameRecord> records;
  Trajectory online;
  std::map<std::int64_t, std::int64_t> frame_of_keyframe, stamp_of_keyframe;
  std::int64_t last_keyframe = -1;
  std::optional<Loop> bridge;  // how the next run of tracking hangs on the last one
  SE3 T_map_last;
  int lost_in_a_row = 0;
  std::shared_ptr<const MeasuredMotion> motion;  // of the camera, by other sensors
  std::vector<std::size_t> origins;  // first views of a single eye, until the second comes
  bool posed_once = false, finished = false;

  bool sees_surfaces = false;
  EnvironmentFilter surroundings;
  std::vector<EnvironmentSight> environments;    // of keyframes, ascending
  std::map<std::int64_t, PlaceView> views;       // of keyframes, until take_changes tells them
  std::optional<bool> views_in_colour;           // as the first
  std::vector<PointLandmark> earlier_landmarks;  // of a run that was taken up
  std::int64_t first_landmark_id = 0;            // after theirs
  bool taken_up = false;  // while the frame of its last keyframe is seen again
  struct {                // from here on, take_changes has not told
    std::size_t record = 0, view = 0, landmark = 0, training = 0;
  } untold;
  std::set<std::int64_t> described_places;  // whose appearance take_changes has told
};

}  // namespace placegraph
