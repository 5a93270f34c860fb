#pragma once
#include <placegraph/backend/inertial/error_state_filter.h>
#include <placegraph/frontend/flow/flow_cues.h>
#include <placegraph/frontend/flow/point_tracker.h>
#include <placegraph/frontend/markers/beacon_detector.h>
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/frontend/markers/marker_filter.h>
#include <placegraph/graph/core/stage_times.h>
#include <placegraph/graph/measurements/frame.h>
#include <placegraph/graph/measurements/marker_layout.h>
#include <placegraph/pipeline/flight/marker_map.h>

#include <deque>

namespace placegraph {

/// What a body that begins does not know.
struct HoverStartOptions {
  double velocity_sigma_mps = 1;
  double gyro_bias_sigma = 0.02;  ///< [rad/s]
  double accel_bias_sigma = 0.2;  ///< [m/s^2]
};
void visit(OptionVisitor& field, HoverStartOptions& options);

struct HoverOptions {
  double floor_z_m = 0;         ///< height of the floor that flow is seen of, in the world
  double flow_noise_px = 0.05;  ///< of a followed point, beside what the image's noise makes
  /// What all points of an image pair err alike: the way that flow of rendered floors drifts over
  /// seconds is that of so much an image, several times what their scatter tells.
  double flow_common_px = 0.025;
  int min_flow_points = 12;  ///< fewer say nothing
  bool use_flow = true;
  /// Weak corners too, they weigh as little as they are known; steps alone, no looks are sought.
  PointTrackerOptions tracker{.max_tracks = 120,
                              .window_px = 15,
                              .pyramid_levels = 4,
                              .min_eigenvalue = 1e-4,
                              .max_anchor_shift_px = 0};
  /// A pose by markers comes so much later than its image, as where another computer finds it.
  double marker_delay_s = 0;
  int max_markers = 4;       ///< looked for where several are expected: the largest
  int restart_after = 20;    ///< images in a row whose markers contradict what the filter expects
  int search_interval = 20;  ///< images without a believed marker, until one is searched whole
  MarkerDetectorOptions detector;
  BeaconDetectorOptions beacons;
  MarkerFilterOptions markers;
  HoverStartOptions start;
  PositionFilterOptions filter;
  double map_interval_s = 0.2;  ///< of `map_hover_markers`, between images that are searched whole
  MarkerMapOptions map;         ///< of the same
  void check() const;
};
void visit(OptionVisitor& field, HoverOptions& options);

/// What is seen in one image.
struct HoverSights {
  std::int64_t stamp_ns = 0;
  std::vector<FlowVector> flow;  ///< from the last image on
  std::vector<MarkerSighting> markers;
  std::vector<BeaconSighting> beacons;
};

/// What became of one image.
struct HoverFrame {
  std::int64_t stamp_ns = 0;
  Outcome outcome;  ///< of `state`: see PositionFilter::at
  BodyState state;
  Outcome flow;          ///< whether flow over the floor was seen and believed
  int flow_points = 0;   ///< that agreed on it
  double flow_chi2 = 0;  ///< of them, a degree of freedom: whether they scatter as they should
  Outcome markers;       ///< whether a pose by markers was seen and believed
  /// What was measured, for who wants to make more of it than the filter; believed or not.
  std::optional<FlowSighting> flow_sighting;
  std::optional<PoseSighting> pose_sighting;
  int markers_seen = 0, beacons_seen = 0;  ///< that shaped it
};

/// Where a small flying robot is, image by image: corners of the floor are followed, their flow
/// without the gyro's turn becomes speed over height (flow_cues), markers become poses, and the
/// position filter joins both with the inertial sensor. It begins with the first markers that leave
/// no doubt, and anew where they contradict it persistently; before that, and whenever its inputs
/// stop, it says nothing.
class Hover {
 public:
  /// `camera` is the one whose images come, without distortion. World: z up. Throws ArgumentError.
  Hover(const HoverOptions& options, const Camera& camera, const SE3& T_body_cam,
        const MarkerLayout& layout);

  /// Inertial samples in the order of their stamps, before the images at or after them. Outcomes as
  /// PositionFilter's; samples before the start are kept.
  Outcome add(const ImuSample& sample);
  /// The next image; `markers_visible` false: it is not looked for markers.
  HoverFrame add(const Frame& frame, bool markers_visible = true);
  /// The same for who looks at images himself. Throws ArgumentError if its stamp is not after the
  /// last one's.
  HoverFrame add(const HoverSights& sights);
  /// Begins with a state that something else knows, instead of by markers.
  void start(const BodyState& state);

  /// The state at a time from the last image on, by the last inertial sample.
  PositionFilter::Answer at(std::int64_t stamp_ns) const { return filter_.at(stamp_ns); }
  const PositionFilter& filter() const { return filter_; }
  const StageTimes& times() const { return times_; }

 private:
  KnownRotation turn_between(std::int64_t from_ns, std::int64_t to_ns) const;
  std::vector<Eigen::Vector2f> predicted_tracks(const BodyState& next) const;
  std::vector<FlowVector> follow(const Frame& frame);
  std::vector<ExpectedSquare> largest_expected(const BodyState& state) const;
  void look_for_marks(const Frame& frame, HoverSights& sights);
  void take_marks(const HoverSights& sights, HoverFrame& result);
  Outcome deliver(std::int64_t now_ns);
  void begin(const PoseSighting& sighting);
  bool beacons_in_view(const BodyState& state) const;
  Eigen::Vector3d mean_force() const;
  void take_flow(const HoverSights& sights, HoverFrame& result);

  HoverOptions options_;
  Camera camera_;
  SE3 T_body_cam_;
  PointTracker tracker_;
  std::optional<MarkerDetector> detector_;  // nothing: there are no markers
  std::optional<MarkerFilter> markers_;     // nothing: neither markers nor beacons
  std::vector<Eigen::Vector3d> beacons_world_;
  std::deque<PoseSighting> on_the_way_;  // not delivered yet
  std::size_t detected_ = 0;             // tracks when corners were last looked for
  int since_detection_ = 1 << 20;        // images since
  int contradicted_ = 0;                 // images in a row by their markers
  int since_search_ = 0;  // images since a believed marker, or since one was searched whole
  PositionFilter filter_;
  std::deque<ImuSample> samples_;      // since the last image, and one before it
  std::optional<BodyState> previous_;  // at the last image, if it was known
  std::int64_t previous_ns_ = 0;       // of the last image
  StageTimes times_;
};

}  // namespace placegraph
