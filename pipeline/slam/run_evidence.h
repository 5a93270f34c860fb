#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/pipeline/health/contradicted_steps.h>
#include <placegraph/pipeline/health/health_monitor.h>
#include <placegraph/pipeline/overlays/static_overlay.h>
#include <placegraph/pipeline/odometry/odometry.h>
#include <placegraph/pipeline/slam/environment_monitor.h>
#include <placegraph/pipeline/slam/link_feed.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// Components of a running system that learn from all frames what its map does not contain.
struct RunEvidence {
  Odometry& odometry;
  LinkFeed& links;
  HealthMonitor& health;
  ContradictedSteps& contradicted;
  EnvironmentMonitor& environments;
  std::optional<StaticOverlay>& overlay;  ///< nothing: overlays are not searched for
};

/// What they have learned, as the bytes of PlaceHistory::evidence. `newest`: the last frame that
/// they know.
std::string evidence_of(const RunEvidence& sources, std::optional<FrameId> newest);

/// Takes over what an interrupted run had learned; `last` is the frame with which it goes on.
/// Returns the last frame that is in the evidence, nothing without any. Throws ArgumentError for
/// the evidence of another version of the program, of other options, or that is damaged.
std::optional<FrameId> take_up_evidence(const std::string& evidence, const RunEvidence& sources,
                                        const Frame& last);

/// The classified keyframes in the evidence of a run; none in that of another version of the
/// program or where there is none. Throws ArgumentError for evidence that is damaged.
std::vector<EnvironmentObservation> environments_in(const std::string& evidence);

}  // namespace placegraph
