#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map_changes.h>
#include <placegraph/pipeline/internal/places/keyframe_chain.h>
#include <placegraph/pipeline/internal/places/place_optimizer.h>
#include <placegraph/pipeline/internal/places/place_partition.h>
#include <placegraph/pipeline/places/place_options.h>

namespace placegraph {

/// Gathers keyframes into topological places, keeps what is known between them, and moves the
/// places when a loop says so. Keyframes come in odometry coordinates, which stay untouched; the
/// map frame follows from the places.
///
/// Runs of tracking whose scale nothing measures make the graph one over Sim(3): every place then
/// has a scale of its own.
class PlaceMapper {
 public:
  explicit PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer = {});
  /// One that goes on from where another stood. Throws ArgumentError if the two contradict each
  /// other.
  PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer,
              const std::vector<Place>& places, const PlaceHistory& history);

  using Link = KeyframeLink;
  /// A new keyframe; without a link it begins a component of its own at `T_map_guess`. A keyframe
  /// without an odometry link begins a run of tracking, whose scale is known or not.
  void add_keyframe(KeyframeId id, const std::optional<Link>& link, const SE3& T_map_guess,
                    double median_depth_m, bool scale_known = true);
  /// A newer estimate of the motion from its link's keyframe to keyframe `id` (the window went on).
  void update_link(KeyframeId id, const SE3& T_from_this);
  /// What is known of that motion: its information in its right tangent, and how far the scale may
  /// have changed.
  void inform_link(KeyframeId id, const Matrix6d& information, double sigma_log_scale = 0);
  /// The anchor before `anchor` in its run of tracking; nothing if `anchor` is none or the first.
  std::optional<KeyframeId> previous_anchor(KeyframeId anchor) const;
  /// Information of the motion from the previous anchor to this one, all between them marginalized:
  /// it takes the place of the links' chained covariances.
  void inform_anchor(KeyframeId anchor, const Matrix6d& information);
  /// The motion from the previous anchor (of any run) to this one by other sensors: a robust
  /// constraint. Throws ArgumentError unless both are anchors.
  void add_motion(KeyframeId previous, KeyframeId anchor, const SE3& T_previous_anchor,
                  const Matrix6d& covariance);
  void add_loop(const Loop& loop);  ///< a revisit
  /// All lengths of the run of tracking that began with keyframe `first` grow by `factor`: its
  /// scale has been measured. A map of its own grows about its first keyframe; one that hangs on
  /// others stays where it is.
  void rescale(KeyframeId first, double factor);

  /// Brings the places to the optimum of their graph as it has become since the last call; joins
  /// components that loops connect, and merges places whose keyframes are all older than
  /// `first_open`.
  IncrementalStep optimize(KeyframeId first_open = kBeforeAll);
  IncrementalStep finish();  ///< the same, iterated to the end

  /// Takes points and camera positions in the keyframe's frame and scale into the map.
  Sim3 S_map_keyframe(KeyframeId id) const { return partition_.S_map_keyframe(chain_, id); }
  SE3 T_map_keyframe(KeyframeId id) const { return rigid_part(S_map_keyframe(id)); }
  PlaceId place_of(KeyframeId keyframe) const { return partition_.place_of(keyframe); }
  /// Whether a part of a place begins with the keyframe.
  bool is_anchor(KeyframeId keyframe) const { return partition_.is_anchor(keyframe); }
  int component_of(KeyframeId keyframe) const { return partition_.state_of(keyframe).component; }
  /// Whether the scale of one of the two keyframes is not known.
  bool scale_unknown(KeyframeId a, KeyframeId b) const;
  bool metric() const;  ///< whether the first component's scale is known
  /// Motion between two keyframes of one run by the links alone; nothing otherwise.
  std::optional<TrackedMotion> odometry(KeyframeId from, KeyframeId to) const;
  /// What the map knew at the last optimization of how the places of two keyframes lie to each
  /// other; nothing if they are not joined or one of the places is newer.
  std::optional<PredictedMotion> predicted(KeyframeId from, KeyframeId to) const;
  PlaceGraph place_graph() const;     ///< as it stands; appearances are empty
  std::vector<Place> places() const;  ///< of the graph
  /// Constraints of the graph that have become others since the last call.
  std::vector<MapChanges::ConstraintChange> take_constraint_changes();
  /// All that another mapper needs to go on; its median depth is the caller's.
  PlaceHistory history() const;

 private:
  void changed(KeyframeId keyframe);
  std::vector<PlaceConstraint> constraints(KeyframeId since) const;
  IncrementalStep update_optimizer();
  void take_poses();
  bool merge(KeyframeId first_open);
  bool separate_contradicted();

  PlaceOptions options_;
  KeyframeChain chain_;
  PlacePartition partition_;
  std::vector<Loop> loops_;
  std::vector<PlaceHistory::Motion> motions_;
  PlaceOptimizer optimizer_;
  std::size_t judged_loops_ = 0;  // how many there were when mergers were last judged
  // Constraints that hang on earlier keyframes are as the optimizer, or the last caller of
  // take_constraint_changes(), has them.
  KeyframeId unoptimized_from_ = kBeforeAll, unpublished_from_ = kBeforeAll;
};

}  // namespace placegraph
