#pragma once
#include <placegraph/graph/map_changes.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/pipeline/places/keyframe_motion.h>
#include <placegraph/pipeline/places/place_optimizer.h>

#include <limits>
#include <map>
#include <set>

namespace placegraph {

struct PlaceOptions {
  double max_distance =
      0.3;  ///< of a keyframe from its place's anchor, as a share of the median depth
  double max_angle_deg = 20;  ///< between a keyframe and its place's anchor
  RobustKernel loop_kernel{RobustKernel::Kind::kCauchy, 3};
  RobustKernel motion_kernel{RobustKernel::Kind::kCauchy, 2};  ///< of other sensors' motion
  bool merge = true;         ///< places that a loop shows to be one become one
  double merge_sigma = 0.1;  ///< how well they must be known to each other, share of the reach
  void check() const;
};
void visit(OptionVisitor& field, PlaceOptions& options);

/// Gathers keyframes into topological places, keeps what is known between them, and moves the
/// places when a loop says so. Keyframes come in odometry coordinates, which stay untouched; the
/// map frame follows from the places.
///
/// A stretch of keyframes within reach of its first one, the anchor, is a part; a place is one
/// part, or several that loops have shown to be one place. Runs of tracking whose unit of length
/// nothing measures make the graph one over Sim(3): every place then has a unit of its own.
class PlaceMapper {
 public:
  explicit PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer = {});
  /// One that goes on from where another stood. Throws ArgumentError if the two contradict each
  /// other.
  PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer,
              const std::vector<Place>& places, const PlaceHistory& history);

  using Link = KeyframeLink;
  /// A new keyframe; without a link it begins a component of its own at `T_map_guess`. A keyframe
  /// without an odometry link begins a run of tracking, whose unit of length is measured or not.
  void add_keyframe(std::int64_t id, const std::optional<Link>& link, const SE3& T_map_guess,
                    double median_depth_m, bool scale_known = true);
  /// A newer estimate of the motion from its link's keyframe to keyframe `id` (the window went on).
  void update_link(std::int64_t id, const SE3& T_from_this);
  /// What is known of that motion: its information in its right tangent, and how far the unit of
  /// length may have changed.
  void inform_link(std::int64_t id, const Matrix6d& information, double sigma_log_scale = 0);
  /// The anchor before `anchor` in its run of tracking; nothing if `anchor` is none or the first.
  std::optional<std::int64_t> previous_anchor(std::int64_t anchor) const;
  /// Information of the motion from the previous anchor to this one, all between them marginalized:
  /// it takes the place of the links' chained covariances.
  void inform_anchor(std::int64_t anchor, const Matrix6d& information);
  /// The motion from the previous anchor (of any run) to this one by other sensors: a robust
  /// constraint. Throws ArgumentError unless both are anchors.
  void add_motion(std::int64_t previous, std::int64_t anchor, const SE3& T_previous_anchor,
                  const Matrix6d& covariance);
  /// A revisit.
  void add_loop(const Loop& loop);
  /// All lengths of the run of tracking that began with keyframe `first` grow by `factor`: its unit
  /// has been measured. A map of its own grows about its first keyframe; one that hangs on others
  /// stays where it is.
  void rescale(std::int64_t first, double factor);

  /// Brings the places to the optimum of their graph as it has become since the last call; joins
  /// components that loops connect, and merges places whose keyframes are all older than
  /// `first_open`.
  IncrementalStep optimize(std::int64_t first_open = 0);
  /// The same, iterated to the end.
  IncrementalStep finish();

  SE3 T_map_keyframe(std::int64_t id) const;
  /// Takes points and camera positions in the keyframe's frame and unit into the map.
  Sim3 S_map_keyframe(std::int64_t id) const;
  std::int64_t place_of(std::int64_t keyframe) const;
  /// Whether a part begins with the keyframe.
  bool is_anchor(std::int64_t keyframe) const { return parts_.count(keyframe) != 0; }
  int component_of(std::int64_t keyframe) const;
  /// Whether the two keyframes' lengths are of one unit that is measured.
  bool units_differ(std::int64_t a, std::int64_t b) const;
  /// Whether the first component's unit is measured.
  bool metric() const;
  /// Motion between two keyframes of one component by the links alone; nothing otherwise.
  std::optional<TrackedMotion> odometry(std::int64_t from, std::int64_t to) const;
  /// What the map knew at the last optimization of how the places of two keyframes lie to each
  /// other; nothing if they are not joined or one of the places is newer.
  std::optional<PredictedMotion> predicted(std::int64_t from, std::int64_t to) const;
  /// The graph as it stands; appearances are empty.
  PlaceGraph place_graph() const;
  std::vector<Place> places() const;  ///< of the graph
  /// Constraints of the graph that have become others since the last call.
  std::vector<MapChanges::ConstraintChange> take_constraint_changes();
  /// All that another mapper needs to go on; its median depth is the caller's.
  PlaceHistory history() const;

 private:
  struct Node {
    std::int64_t part;
    std::optional<Link> link;
    Matrix7d covariance;  // of the link, in its right tangent
    SE3 T_run_keyframe;   // along the links of its run of tracking
    int run;              // consecutive keyframes joined by odometry links
    double way = 0;       // from the beginning of the run
  };
  struct Part {  // numbered by its anchor
    std::int64_t place;
    Sim3 S_place_part;                               // identity if it founded the place
    Matrix7d covariance = Matrix7d::Zero();          // of that, in its right tangent
    std::optional<Matrix6d> motion_covariance = {};  // of the motion from the previous anchor
  };
  struct PlaceState {  // numbered as they were founded; of merged ones the oldest stays
    std::int64_t anchor_keyframe;
    Sim3 S_map_place;
    int component;
    double reach;  // in the place's unit
    std::int64_t last_keyframe;
  };
  struct Edge {
    PlaceConstraint::Key key;
    std::int64_t from_part, to_part;
    Sim3 S_from_to;
    Matrix7d covariance;  // in the right tangent
    ConstraintSource source;
    RobustKernel kernel = {};
  };

  const PlaceState& place_at(std::int64_t keyframe) const;
  PlaceState& place_at(std::int64_t keyframe);
  SE3 T_part_keyframe(const Node& node) const;
  Sim3 S_place_keyframe(const Node& node) const;
  void follow_links(std::int64_t first);
  void changed(std::int64_t keyframe) {
    changed_since_ = std::min(changed_since_, keyframe);
    untold_since_ = std::min(untold_since_, keyframe);
  }
  bool free_units() const;
  static Matrix7d covariance_of(const Link& link);
  std::vector<Edge> edges(std::int64_t since) const;
  std::vector<Edge> link_edges(std::int64_t since) const;
  Edge odometry_edge(std::int64_t anchor, std::int64_t previous, const Matrix7d& chained) const;
  Edge loop_edge(std::size_t number) const;
  RelativePoseConstraint constraint_of(const Edge& edge) const;
  std::vector<PlaceConstraint> constraints(std::int64_t since) const;
  void bring_together();
  void settle_units();
  IncrementalStep follow();
  void take_poses();
  double shortest_way(std::int64_t from, std::int64_t to) const;
  struct Merger {
    std::int64_t older, younger;
    Matrix7d covariance;  // of S_older_younger in its right tangent
  };
  bool agrees(const Loop& loop) const;
  using Merged = PlaceHistory::Merged;
  std::optional<std::int64_t> known_ground(const Sim3& S_map_here, std::int64_t keyframe,
                                           double reach) const;
  bool same_known_ground(const Node& node, const Sim3& S_place_this) const;
  std::optional<Merger> merger_of(std::int64_t a, std::int64_t b, std::int64_t first_open) const;
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs_that_loops_show(bool all) const;
  std::vector<std::pair<std::int64_t, std::int64_t>> pairs_on_known_ground(bool all) const;
  bool merge_all(std::int64_t first_open);
  void merge(const Merger& merger);
  std::vector<bool> strained() const;
  bool part_strained();
  bool have_parted(std::int64_t one, std::int64_t other) const;
  void separate(const Merged& merged);

  PlaceOptions options_;
  std::map<std::int64_t, Node> nodes_;
  std::map<std::int64_t, Part> parts_;
  std::map<std::int64_t, PlaceState> places_;
  std::vector<Loop> loops_;
  std::vector<Edge> motions_;
  std::vector<bool> scale_known_;  // of every run
  std::vector<Merged> merged_;
  std::set<std::pair<std::int64_t, std::int64_t>> parted_;  // anchors that are not one place
  std::int64_t founded_ = 0;  // places so far: numbers of those that are gone are not given again
  std::size_t judged_loops_ = 0;  // how many the merged places have been judged with
  PlaceOptimizer optimizer_;
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  static constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
  std::int64_t changed_since_ = kNever;  // edges of earlier keyframes are as the optimizer has them
  std::int64_t untold_since_ = kFirst;   // the same for take_constraint_changes
  bool told_free_units_ = false;
  bool begin_anew_ = false;  // lengths are of another unit than the optimizer's
};

}  // namespace placegraph
