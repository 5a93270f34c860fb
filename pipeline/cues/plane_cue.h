#pragma once
#include <placegraph/backend/window/sliding_window.h>
#include <placegraph/frontend/cloud_planes/depth_planes.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/cues/cue_options.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// Plane landmarks of a sliding window. A plane seen in a keyframe is an observation of the
/// landmark with which it agrees: in Mahalanobis distance with the landmark's marginal covariance
/// in that keyframe (99 % of chi2), in the side from which it is seen, and in the positions at
/// which points on it were seen before, so that a coplanar surface elsewhere is another landmark. A
/// plane that agrees about equally well with two landmarks of one place, such as a door leaf in
/// front of its wall, is ignored. A plane that agrees with none becomes a landmark when a second
/// keyframe sees it. Landmarks remain for a while without observations, with increasing
/// uncertainty.
class PlaneCue {
 public:
  explicit PlaneCue(const PlaneLandmarkOptions& options, LogSink log = {})
      : options_(options), log_(std::move(log)) {
    options_.check();
  }

  /// Adds the planes seen in the newest keyframe, in its camera's frame. Returns the landmark of
  /// each plane; nothing for planes that are candidates or ignored.
  std::vector<std::optional<PlaneId>> add(KeyframeId keyframe, const std::vector<DepthPlane>& seen,
                                          SlidingWindow& window);
  /// Removes observations that do not fit, after the window has been optimized, and landmarks with
  /// repeated misfits.
  void prune(SlidingWindow& window);
  /// Ids of the landmarks, ascending.
  std::vector<PlaneId> landmarks() const;
  void reset();

 private:
  struct Landmark {
    KeyframeId last_seen;
    int misfits = 0;  ///< number of misfits since the last observation that fitted
    /// Normal of the plane, towards the side from which it is seen.
    Eigen::Vector3d toward_map = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> points_map;  ///< points of earlier observations
  };
  struct Candidate {
    KeyframeId keyframe;
    DepthPlane plane;
  };
  struct Match {
    double chi2 = 0, overlap = 0, score = 0;
    std::size_t seen = 0;
    PlaneId landmark;
  };
  std::vector<Match> matches(KeyframeId keyframe, const std::vector<DepthPlane>& seen,
                             const SlidingWindow& window) const;
  Eigen::Matrix3d drift(const Plane3& plane_cam) const;
  void see(KeyframeId keyframe, const DepthPlane& plane, PlaneId id, SlidingWindow& window);
  static std::vector<std::optional<PlaneId>> assign(const std::vector<Match>& all,
                                                    std::size_t count);
  std::optional<std::size_t> partner(KeyframeId keyframe, const DepthPlane& plane,
                                     const SlidingWindow& window) const;
  PlaneId begin(const Candidate& before, const Candidate& now, SlidingWindow& window);
  void forget(KeyframeId keyframe, SlidingWindow& window);

  PlaneLandmarkOptions options_;
  LogSink log_;
  PlaneId next_{1};
  std::map<PlaneId, Landmark> landmarks_;
  std::vector<Candidate> candidates_;  ///< planes in keyframes of the window, ascending
};

}  // namespace placegraph
