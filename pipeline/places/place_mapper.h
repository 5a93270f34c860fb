#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/map_changes.h>
#include <placegraph/pipeline/places/keyframe_chain.h>
#include <placegraph/pipeline/places/place_optimizer.h>
#include <placegraph/pipeline/places/place_options.h>
#include <placegraph/pipeline/places/place_partition.h>

namespace placegraph {

/// Groups keyframes into topological places, stores the measurements between them, and optimizes
/// the poses of the places. Keyframes are given in odometry coordinates, which are not modified;
/// the map frame follows from the places.
///
/// Track segments whose scale is not measured require a graph over Sim(3): every place then has a
/// scale of its own.
class PlaceMapper {
 public:
  explicit PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer = {});
  /// Continues from the state of another mapper. Throws ArgumentError if places and history are
  /// inconsistent.
  PlaceMapper(const PlaceOptions& options, const IncrementalOptions& optimizer,
              const std::vector<Place>& places, const PlaceHistory& history);

  using Link = KeyframeLink;
  /// Adds a keyframe; without a link it begins a component of its own at `T_map_guess`. A keyframe
  /// without an odometry link begins a track segment, whose scale is known or unknown.
  void add_keyframe(KeyframeId id, const std::optional<Link>& link, const SE3& T_map_guess,
                    double median_depth_m, bool scale_known = true);
  /// Replaces the motion from its link's keyframe to keyframe `id` by a newer estimate.
  void update_link(KeyframeId id, const SE3& T_from_this);
  /// Corrects motions, each in its right tangent, of the links of these keyframes.
  void correct_links(const std::map<KeyframeId, Vector6d>& corrections);
  /// Sets the uncertainty of that motion: its information in its right tangent, and the standard
  /// deviation of the change of scale.
  void inform_link(KeyframeId id, const Matrix6d& information, double sigma_log_scale = 0);
  /// The previous anchor in the track segment of `anchor`; nothing if `anchor` is none or the
  /// first.
  std::optional<KeyframeId> previous_anchor(KeyframeId anchor) const;
  /// Sets the information of the motion from the previous anchor to this one, with all keyframes
  /// between them marginalized; it replaces the accumulated covariances of the links.
  void inform_anchor(KeyframeId anchor, const Matrix6d& information);
  /// Adds the motion from the previous anchor (of any track segment) to this one measured by other
  /// sensors, as a robust constraint. Throws ArgumentError unless both are anchors.
  void add_motion(KeyframeId previous, KeyframeId anchor, const SE3& T_previous_anchor,
                  const Matrix6d& covariance);
  std::size_t add_loop(const Loop& loop);  ///< adds a loop closure; returns its number
  /// Multiplies the covariance of position and rotation of the loop with this number.
  void scale_loop_covariance(std::size_t number, double factor);
  /// Undoes all mergers, which finish() may make again, and gives a component of their own to
  /// places that nothing connects any more: after loops were removed from the history.
  void reconsider();
  /// Multiplies all lengths of the track segment that begins with keyframe `first` by `factor`,
  /// after its scale has been measured. A component that consists of this segment is scaled about
  /// its first keyframe; if the segment is linked to others, its places keep their positions.
  void rescale(KeyframeId first, double factor);

  /// Optimizes the places with the changes since the last call; joins components that loops
  /// connect, and merges places whose keyframes are all older than `first_open`.
  IncrementalStep optimize(KeyframeId first_open = kBeforeAll);
  IncrementalStep finish();  ///< the same, iterated to convergence

  /// Transforms points and camera positions from the keyframe's frame and scale into the map.
  Sim3 S_map_keyframe(KeyframeId id) const { return partition_.S_map_keyframe(chain_, id); }
  SE3 T_map_keyframe(KeyframeId id) const { return rigid_part(S_map_keyframe(id)); }
  PlaceId place_of(KeyframeId keyframe) const { return partition_.place_of(keyframe); }
  /// Whether a segment of a place begins with the keyframe.
  bool is_anchor(KeyframeId keyframe) const { return partition_.is_anchor(keyframe); }
  int component_of(KeyframeId keyframe) const { return partition_.state_of(keyframe).component; }
  /// Whether the scale of at least one of the two keyframes is unknown.
  bool scale_unknown(KeyframeId a, KeyframeId b) const;
  bool metric() const;  ///< whether the first component's scale is known
  /// Motion between two keyframes of one track segment by the links alone; nothing otherwise.
  std::optional<TrackedMotion> odometry(KeyframeId from, KeyframeId to) const;
  /// Relative pose of two keyframes according to the map at the last optimization, with its
  /// covariance; nothing if their places are not connected or one of them is newer.
  std::optional<PredictedMotion> predicted(KeyframeId from, KeyframeId to) const;
  PlaceGraph place_graph() const;     ///< current place graph; appearances are empty
  std::vector<Place> places() const;  ///< places of the graph
  /// Constraints of the graph that have changed since the last call.
  std::vector<MapChanges::ConstraintChange> take_constraint_changes();
  /// State from which another mapper can continue; the caller sets its median depth.
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
  std::size_t judged_loops_ = 0;  // number of loops when mergers were last checked
  // Constraints that depend on earlier keyframes are up to date in the optimizer, or have been
  // returned by take_constraint_changes().
  KeyframeId unoptimized_from_ = kBeforeAll, unpublished_from_ = kBeforeAll;
};

}  // namespace placegraph
