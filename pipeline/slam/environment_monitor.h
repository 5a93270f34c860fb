#pragma once
#include <placegraph/frontend/scene/environment.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/map.h>
#include <placegraph/pipeline/slam/environment_observation.h>

#include <array>
#include <optional>
#include <vector>

namespace placegraph {

void visit_state(auto& archive, EnvironmentObservation& observation) {
  archive(observation.keyframe, observation.frame, observation.evidence.values,
          observation.probabilities, observation.kind);
}

/// Classifies the environment of keyframes in order of travel, and labels places by it.
class EnvironmentMonitor {
 public:
  EnvironmentMonitor(const EnvironmentFilterOptions& options, const Camera& camera)
      : filter_(options), camera_(camera) {}

  /// Classifies the newest keyframe. `shares`: shares of the surfaces in its image; null: not
  /// labelled. `points_cam`: landmarks in its camera's frame, in metres if `metric`. Returns
  /// whether the class has changed.
  bool classify(KeyframeId keyframe, const Frame& frame, const SurfaceShares* shares,
                const std::vector<Eigen::Vector3d>& points_cam, bool metric);
  /// Current environment class; nothing while it is unknown.
  std::optional<Environment> kind() const { return filter_.kind(); }
  /// Its name; "unknown" while it is.
  std::string name() const { return kind() ? environment_name(*kind()) : "unknown"; }
  /// What it lets assume; nothing while it is unknown.
  std::optional<Assumptions> assumptions() const {
    return kind() ? std::optional(assumptions_of(*kind())) : std::nullopt;
  }
  const std::vector<EnvironmentObservation>& observations() const { return observations_; }
  /// Labels places with the most frequent class of their keyframes, unless it is unknown.
  void label(std::vector<Place>& places) const;
  void visit_state(auto& archive) { archive(observations_, filter_); }

 private:
  EnvironmentFilter filter_;
  Camera camera_;
  std::vector<EnvironmentObservation> observations_;  // one per keyframe, ascending
};

}  // namespace placegraph
