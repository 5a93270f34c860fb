#pragma once
#include <placegraph/backend/pose_graph_optimizer.h>
#include <placegraph/graph/place_graph.h>
#include <placegraph/pipeline/tracked_motion.h>

#include <map>

namespace placegraph {

struct PlaceOptions {
  double max_distance =
      0.3;  ///< of a keyframe from its place's anchor, as a share of the median depth
  double max_angle_deg = 20;  ///< between a keyframe and its place's anchor
  RobustKernel loop_kernel{RobustKernel::Kind::kCauchy, 3};
  void check() const;
};
void visit(OptionVisitor& field, PlaceOptions& options);

/// Gathers keyframes into topological places, keeps what is known between them, and moves the
/// places when a loop says so. Keyframes come in odometry coordinates, which stay untouched; the
/// map frame follows from the places.
class PlaceMapper {
 public:
  explicit PlaceMapper(const PlaceOptions& options);

  /// The motion from the previous keyframe of the same run of tracking.
  struct Link {
    std::int64_t from = 0;
    SE3 T_from_this;
    Matrix6d information = Matrix6d::Zero();
    ConstraintSource source = ConstraintSource::kOdometry;
  };
  /// A new keyframe; without a link it begins a component of its own at `T_map_guess`.
  void add_keyframe(std::int64_t id, const std::optional<Link>& link, const SE3& T_map_guess,
                    double median_depth_m);
  /// A newer estimate of the motion from its link's keyframe to keyframe `id` (the window went on);
  /// `information`, of T_from_this in its right tangent, stays as it was if none is given.
  void update_link(std::int64_t id, const SE3& T_from_this,
                   const std::optional<Matrix6d>& information);
  /// A revisit; `information` is that of T_match_query in its right tangent.
  void add_loop(std::int64_t query, std::int64_t match, const SE3& T_match_query,
                const Matrix6d& information);
  /// All positions of keyframes from `first` on grow by `factor` about the first one.
  void rescale(std::int64_t first, double factor);

  /// Optimizes the place graph; joins components that loops connect.
  [[nodiscard]] PoseGraphReport optimize(const PoseGraphOptions& options, const LogSink& log);

  SE3 T_map_keyframe(std::int64_t id) const;
  std::int64_t place_of(std::int64_t keyframe) const;
  int component_of(std::int64_t keyframe) const;
  /// Motion between two keyframes of one component by the links alone; nothing otherwise.
  std::optional<TrackedMotion> odometry(std::int64_t from, std::int64_t to) const;
  /// The graph as it stands; appearances are empty.
  PlaceGraph place_graph() const;

 private:
  struct Node {
    std::int64_t place;
    std::optional<Link> link;
    SE3 T_run_keyframe;  // along the links of its run of tracking
    int run;             // consecutive keyframes joined by odometry links
    double way = 0;      // from the beginning of the run
  };
  struct LoopEdge {
    std::int64_t query, match;
    SE3 T_match_query;
    Matrix6d information;
  };
  SE3 T_place_keyframe(std::int64_t id) const;
  void follow_links(std::int64_t first);
  std::vector<RelativePoseConstraint> constraints() const;
  void bring_together();

  PlaceOptions options_;
  std::map<std::int64_t, Node> nodes_;
  std::vector<Place> places_;
  std::vector<LoopEdge> loops_;
  int runs_ = 0;
};

}  // namespace placegraph
