#pragma once
#include <placegraph/backend/internal/window/sliding_window.h>
#include <placegraph/frontend/internal/cloud_planes/depth_planes.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/cues/cue_options.h>

#include <map>
#include <optional>
#include <vector>

namespace placegraph {

/// The planes that a sliding window knows as landmarks. A plane seen in a keyframe is a sighting of
/// the landmark it agrees with: by the Mahalanobis distance with the marginal covariance that the
/// window has of the landmark from that keyframe (99 % of chi2), by the side it is seen from, and
/// by where on it things were seen before, so that a coplanar surface elsewhere is another one.
/// What agrees with two landmarks of one place about alike, as a door leaf before its wall may, is
/// left alone. What agrees with none waits for a second keyframe that sees it too. Landmarks go on
/// unseen for a while, known ever less well.
class PlaneCue {
 public:
  explicit PlaneCue(const PlaneLandmarkOptions& options, LogSink log = {})
      : options_(options), log_(std::move(log)) {
    options_.check();
  }

  /// Hands the planes seen in the newest keyframe over, in its camera's frame. Returns the landmark
  /// each is a sighting of; nothing of those that wait or are left alone.
  std::vector<std::optional<PlaneId>> add(KeyframeId keyframe, const std::vector<DepthPlane>& seen,
                                          SlidingWindow& window);
  /// After the window has been optimized: sightings that do not fit are taken out, with a landmark
  /// whose sightings do not fit again and again.
  void prune(SlidingWindow& window);
  /// The ids of the landmarks, ascending.
  std::vector<PlaneId> landmarks() const;
  void reset();

 private:
  struct Landmark {
    KeyframeId last_seen;
    int misfits = 0;  ///< since it last fitted
    /// Its normal, to the side it is seen from.
    Eigen::Vector3d toward_map = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> points_map;  ///< where it was seen
  };
  struct Waiting {
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
  PlaneId begin(const Waiting& before, const Waiting& now, SlidingWindow& window);
  void forget(KeyframeId keyframe, SlidingWindow& window);

  PlaneLandmarkOptions options_;
  LogSink log_;
  PlaneId next_{1};
  std::map<PlaneId, Landmark> landmarks_;
  std::vector<Waiting> waiting_;  ///< of keyframes in the window, ascending
};

}  // namespace placegraph
