#pragma once
#include <placegraph/backend/incremental/incremental_optimizer.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_graph.h>

#include <map>

namespace placegraph {

/// Current state of a constraint between places.
struct PlaceConstraint {
  enum class Kind { kLink, kLoop, kMotion };
  using Key = std::pair<Kind, std::int64_t>;  ///< unchanged for as long as the constraint exists
  Key key;
  std::optional<RelativePoseConstraint> measured;  ///< nothing: both ends are in one place
};

/// Optimizes the poses of places incrementally while places are added, constraints become more
/// accurate and their ends move to other places, each at a cost proportional to the change.
class PlaceOptimizer {
 public:
  explicit PlaceOptimizer(const IncrementalOptions& options);

  bool knows(PlaceId place) const { return optimizer_.pose(node_of_place(place)).has_value(); }
  /// Kind of its poses; nothing before the first one.
  std::optional<PoseKind> kind() const;
  /// Removes all places and constraints.
  void reset();
  /// Starts with these places at their given poses; removes the previous state.
  IncrementalStep begin(const std::vector<PoseNode>& places,
                        const std::vector<PlaceConstraint>& constraints);
  /// Adds new places, and all constraints that are new or have changed.
  IncrementalStep follow(const std::vector<PoseNode>& places,
                         const std::vector<PlaceConstraint>& constraints);
  /// Iterates to convergence.
  IncrementalStep finish() { return optimizer_.finish(); }

  /// Pose of a place. Throws ArgumentError for an unknown place, as does relative_covariance().
  Sim3 S_map_place(PlaceId place) const;
  /// Covariance of S_from_to in its right tangent; the last row and column are zero over SE(3).
  Matrix7d relative_covariance(PlaceId from, PlaceId to) const;

 private:
  struct Tracked {
    int number = 0;  // number of the constraint in the optimizer
    NodeId from, to;
  };

  IncrementalOptions options_;
  IncrementalOptimizer optimizer_;
  std::map<PlaceConstraint::Key, Tracked> tracked_;
};

}  // namespace placegraph
