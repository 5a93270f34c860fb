#pragma once
#include <placegraph/backend/incremental/incremental_optimizer.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/place_graph.h>

#include <map>

namespace placegraph {

/// A constraint between places as it stands.
struct PlaceConstraint {
  enum class Kind { kLink, kLoop, kMotion };
  using Key = std::pair<Kind, std::int64_t>;  ///< the same for as long as the constraint exists
  Key key;
  std::optional<RelativePoseConstraint> measured;  ///< nothing: both ends lie in one place
};

/// Keeps the poses of places at the optimum of their graph while places are added, constraints are
/// measured better and ends of constraints move to other places, each at the cost of what it
/// changes.
class PlaceOptimizer {
 public:
  explicit PlaceOptimizer(const IncrementalOptions& options);

  bool knows(PlaceId place) const { return optimizer_.pose(node_of_place(place)).has_value(); }
  /// Kind of its poses; nothing before there is one.
  std::optional<PoseKind> kind() const;
  /// Forgets all places and constraints.
  void reset();
  /// Begins with these places where they are; what was known before is forgotten.
  IncrementalStep begin(const std::vector<PoseNode>& places,
                        const std::vector<PlaceConstraint>& constraints);
  /// New places, and all constraints that are new or have changed.
  IncrementalStep follow(const std::vector<PoseNode>& places,
                         const std::vector<PlaceConstraint>& constraints);
  /// Iterates to the end.
  IncrementalStep finish() { return optimizer_.finish(); }

  /// Throws ArgumentError for an unknown place, as the next does.
  Sim3 S_map_place(PlaceId place) const;
  /// Of S_from_to in its right tangent; the last row and column are zero over SE(3).
  Matrix7d relative_covariance(PlaceId from, PlaceId to) const;

 private:
  struct Tracked {
    int number = 0;  // of the constraint in the optimizer
    NodeId from, to;
  };

  IncrementalOptions options_;
  IncrementalOptimizer optimizer_;
  std::map<PlaceConstraint::Key, Tracked> tracked_;
};

}  // namespace placegraph
