#include <ceres/problem.h>
#include <ceres/solver.h>
#include <placegraph/backend/factors/absolute_rotation.h>
#include <placegraph/backend/factors/ceres_factor.h>
#include <placegraph/backend/factors/distance.h>
#include <placegraph/backend/factors/height_above_plane.h>
#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/kernel_loss.h>
#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/plane_observation.h>
#include <placegraph/backend/factors/point_factor.h>
#include <placegraph/backend/factors/point_on_plane.h>
#include <placegraph/backend/factors/pose_prior.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/window/window_state.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <string>

namespace placegraph {
namespace {

/// A free keyframe outside the prior needs this many points and lines to be determined.
constexpr int kMinPointsPerKeyframe = 3;

/// The window as a Ceres problem. Ceres orders the blocks of one elimination group by address, and
/// the order decides the last bits of the sums: the blocks of a group lie in one array, by kind and
/// in the order of the ids.
class WindowProblem {
 public:
  explicit WindowProblem(const WindowState& state)
      : state_(state),
        loss_({RobustKernel::Kind::kHuber, state.options.huber_px}),
        poses_(7 * state.keyframes.size() + VariableBlock<SO3>::kSize * state.worlds.size() +
               VariableBlock<Line3>::kSize * state.lines.size() +
               VariableBlock<Plane3>::kSize * state.planes.size()),
        points_(3 * state.landmarks.size()),
        points_by_keyframe_(state.keyframes.size()),
        is_held_(state.keyframes.size()),
        problem_(ownership()),
        ordering_(std::make_shared<ceres::ParameterBlockOrdering>()) {
    for (const auto& [id, T_map_cam] : state.keyframes) {
      VariableBlock<SE3>::store(T_map_cam, &poses_[7 * ids_.size()]);
      ids_.push_back(id);
    }
    for (const auto& [id, plane_map] : state.planes) {
      VariableBlock<Plane3>::store(plane_map, plane_block(plane_ids_.size()));
      plane_ids_.push_back(id);
    }
    for (const auto& [id, R_map_world] : state.worlds) {
      VariableBlock<SO3>::store(R_map_world, world_block(world_ids_.size()));
      world_ids_.push_back(id);
    }
    add_points();
    add_lines();
    for (const HeightObservation& height : state.heights) add_height(height);
    for (const PlaneObservation& observation : state.plane_observations)
      add_plane_observation(observation);
    for (const PosePrior& prior : state.pose_priors) add_pose_prior(prior);
    for (const MotionObservation& motion : state.motions) add_motion(motion);
    for (const DistanceObservation& distance : state.distances) add_distance(distance);
    if (const auto reference = scale_reference(state)) add_distance(*reference);
    for (const WorldObservation& observation : state.world_observations)
      add_world_observation(observation);
    if (!state.prior.empty()) add_prior();
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      double* const pose = &poses_[7 * k];
      if (!problem_.HasParameterBlock(pose)) continue;
      problem_.SetManifold(pose, &manifold_);
      ordering_->AddElementToGroup(pose, 1);
      if (state.fixed == ids_[k]) problem_.SetParameterBlockConstant(pose);
    }
    for (std::size_t k = 0; k < plane_ids_.size(); ++k) {
      if (!problem_.HasParameterBlock(plane_block(k))) continue;
      problem_.SetManifold(plane_block(k), &plane_manifold_);
      ordering_->AddElementToGroup(plane_block(k), 1);
    }
    for (std::size_t k = 0; k < world_ids_.size(); ++k) {
      if (!problem_.HasParameterBlock(world_block(k))) continue;
      problem_.SetManifold(world_block(k), &world_manifold_);
      ordering_->AddElementToGroup(world_block(k), 1);
    }
  }

  /// Why the data determine no estimate, or ok.
  Outcome check() const {
    if (ids_.size() < 2) return too_few("a window of fewer than two keyframes");
    for (std::size_t k = 0; k < ids_.size(); ++k) {
      const auto& in_prior = state_.prior.keyframes;
      // While a keyframe is held, the prior is too weak to determine others.
      const bool by_prior =
          !state_.fixed && std::binary_search(in_prior.begin(), in_prior.end(), ids_[k]);
      if (state_.fixed == ids_[k] || by_prior || points_by_keyframe_[k] >= kMinPointsPerKeyframe ||
          is_held_[k])
        continue;
      return too_few("keyframe " + std::to_string(ids_[k]) + " sees " +
                     std::to_string(points_by_keyframe_[k]) +
                     " points or lines that others see too, " +
                     std::to_string(kMinPointsPerKeyframe) + " needed");
    }
    return Outcome::ok();
  }

  /// Motions one after the other agree as they are: there is no step that makes less of nothing.
  bool settled() {
    constexpr double kNothing = 1e-12;
    double cost = 1;
    return state_.landmarks.empty() && state_.lines.empty() &&
           problem_.Evaluate({}, &cost, nullptr, nullptr, nullptr) && cost < kNothing;
  }

  ceres::Solver::Summary solve() {
    ceres::Solver::Options options;
    // Lines meet keyframes only, not one another.
    options.linear_solver_type = state_.lines.empty() ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
    options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
    options.dense_linear_algebra_library_type = ceres::EIGEN;
    options.linear_solver_ordering = ordering_;
    options.num_threads = 1;
    options.max_num_iterations = state_.options.max_iterations;
    options.function_tolerance = state_.options.relative_decrease;
    options.gradient_tolerance = 0;
    options.parameter_tolerance = 0;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary;
  }

  bool finite() const {
    const auto good = [](double x) { return std::isfinite(x); };
    return std::all_of(poses_.begin(), poses_.end(), good) &&
           std::all_of(points_.begin(), points_.end(), good);
  }

  /// Takes the estimate over. Landmarks that were not in the problem move with the keyframe that
  /// saw them last.
  void read_back(WindowState& state) const {
    const std::map<std::int64_t, SE3> before = state.keyframes;
    std::size_t k = 0;
    for (auto& [id, T_map_cam] : state.keyframes) {
      double const* const pose = &poses_[7 * k++];
      if (problem_.HasParameterBlock(pose) && state.fixed != id)
        T_map_cam = VariableBlock<SE3>::load(pose);
    }
    std::size_t i = 0;
    for (auto& [id, landmark] : state.landmarks) {
      double const* const point = &points_[3 * i++];
      if (problem_.HasParameterBlock(point)) {
        landmark.p_map = Eigen::Map<const Eigen::Vector3d>(point);
      } else if (!landmark.observations.empty()) {
        const std::int64_t seen = landmark.observations.back().keyframe;
        landmark.p_map = state.keyframes.at(seen) * (before.at(seen).inverse() * landmark.p_map);
      }
    }
    i = 0;
    for (auto& [id, line] : state.lines) {
      double const* const block = &poses_[first_line() + VariableBlock<Line3>::kSize * i++];
      if (problem_.HasParameterBlock(block)) {
        line.line_map = VariableBlock<Line3>::load(block);
      } else if (!line.observations.empty()) {
        const std::int64_t seen = line.observations.back().keyframe;
        const SE3 motion = state.keyframes.at(seen) * before.at(seen).inverse();
        line.line_map = Line3::from_direction(motion * line.line_map.nearest_point(),
                                              motion.rotation() * line.line_map.direction());
      }
    }
    i = 0;
    for (auto& [id, plane_map] : state.planes)
      plane_map =
          VariableBlock<Plane3>::load(&poses_[first_plane() + VariableBlock<Plane3>::kSize * i++]);
    i = 0;
    for (auto& [id, R_map_world] : state.worlds)
      R_map_world =
          VariableBlock<SO3>::load(&poses_[first_world() + VariableBlock<SO3>::kSize * i++]);
  }

 private:
  static ceres::Problem::Options ownership() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }
  static Outcome too_few(const std::string& reason) {
    return Outcome::failure(Outcome::Code::kTooFewData, reason);
  }
  std::size_t position(std::int64_t keyframe) const {
    return static_cast<std::size_t>(std::lower_bound(ids_.begin(), ids_.end(), keyframe) -
                                    ids_.begin());
  }

  std::size_t first_world() const { return 7 * state_.keyframes.size(); }
  std::size_t first_line() const {
    return first_world() + VariableBlock<SO3>::kSize * state_.worlds.size();
  }
  std::size_t first_plane() const {
    return first_line() + VariableBlock<Line3>::kSize * state_.lines.size();
  }
  double* world_block(std::size_t k) {
    return &poses_[first_world() + VariableBlock<SO3>::kSize * k];
  }
  double* world_of_id(std::int64_t world) {
    return world_block(static_cast<std::size_t>(
        std::lower_bound(world_ids_.begin(), world_ids_.end(), world) - world_ids_.begin()));
  }
  double* plane_block(std::size_t k) {
    return &poses_[first_plane() + VariableBlock<Plane3>::kSize * k];
  }
  double* plane_of_id(std::int64_t plane) {
    return plane_block(static_cast<std::size_t>(
        std::lower_bound(plane_ids_.begin(), plane_ids_.end(), plane) - plane_ids_.begin()));
  }

  void add_points() {
    double* point = points_.data();
    for (const auto& [id, landmark] : state_.landmarks) {
      Eigen::Map<Eigen::Vector3d>{point} = landmark.p_map;
      const auto usable = usable_observations(state_, landmark);
      for (const WindowObservation* o : usable) {
        const std::size_t k = position(o->keyframe);
        double* const pose = &poses_[7 * k];
        ++points_by_keyframe_[k];
        problem_.AddResidualBlock(&reprojections_.emplace_back(reprojection_of(state_.camera, *o)),
                                  &loss_, pose, point);
        if (!o->inverse_depth) continue;
        problem_.AddResidualBlock(
            &inverse_depths_.emplace_back(InverseDepth(*o->inverse_depth, o->sigma_inverse_depth)),
            &loss_, pose, point);
      }
      if (!usable.empty()) {
        ordering_->AddElementToGroup(point, 0);
        if (landmark.on_plane)
          problem_.AddResidualBlock(
              &plane_points_.emplace_back(PointOnPlaneFactor(landmark.on_plane->sigma_m)), &loss_,
              point, plane_of_id(landmark.on_plane->plane));
      }
      point += 3;
    }
  }
  /// Lines are few and stand beside the poses: with blocks of one size only among what is
  /// eliminated, Ceres' code for points stays fast.
  void add_lines() {
    double* block = poses_.data() + first_line();
    for (const auto& [id, line] : state_.lines) {
      VariableBlock<Line3>::store(line.line_map, block);
      if (is_usable(line)) {
        for (const LineObservation& o : line.observations) {
          const std::size_t k = position(o.keyframe);
          ++points_by_keyframe_[k];
          for_factors(state_.camera, o, [&](const LineReprojectionFactor& factor) {
            problem_.AddResidualBlock(&segments_.emplace_back(factor), &loss_, &poses_[7 * k],
                                      block);
          });
        }
        problem_.SetManifold(block, &line_manifold_);
        ordering_->AddElementToGroup(block, 1);
      }
      block += VariableBlock<Line3>::kSize;
    }
  }
  void add_height(const HeightObservation& h) {
    problem_.AddResidualBlock(&heights_.emplace_back(HeightAbovePlaneFactor(h.height_m, h.sigma_m)),
                              &loss_, &poses_[7 * position(h.keyframe)], plane_of_id(h.plane));
  }
  void add_plane_observation(const PlaneObservation& o) {
    problem_.AddResidualBlock(
        &planes_seen_.emplace_back(PlaneObservationFactor(o.plane_cam, whitening_of(o))), &loss_,
        &poses_[7 * position(o.keyframe)], plane_of_id(o.plane));
  }
  void add_pose_prior(const PosePrior& prior) {
    const std::size_t k = position(prior.keyframe);
    bool deficient = false;
    problem_.AddResidualBlock(&pose_priors_.emplace_back(PosePriorFactor<SE3>(
                                  prior.T_map_cam, whitening(prior.information, &deficient))),
                              nullptr, &poses_[7 * k]);
    if (!deficient) is_held_[k] = true;
  }
  void add_motion(const MotionObservation& m) {
    const std::size_t from = position(m.from), to = position(m.to);
    bool deficient = false;
    problem_.AddResidualBlock(&motions_.emplace_back(RelativePoseFactor<SE3>(
                                  m.T_from_to, whitening(m.information, &deficient))),
                              nullptr, &poses_[7 * from], &poses_[7 * to]);
    if (!deficient) is_held_[from] = is_held_[to] = true;
  }
  void add_distance(const DistanceObservation& d) {
    problem_.AddResidualBlock(&distances_.emplace_back(DistanceFactor(d.distance_m, d.sigma_m)),
                              &loss_, &poses_[7 * position(d.from)], &poses_[7 * position(d.to)]);
  }
  void add_world_observation(const WorldObservation& o) {
    problem_.AddResidualBlock(
        &rotations_.emplace_back(AbsoluteRotationFactor(o.R_cam_world, whitening_of(o))), &loss_,
        &poses_[7 * position(o.keyframe)], world_of_id(o.world));
  }
  void add_prior() {
    std::vector<double*> blocks;
    for (const std::int64_t id : state_.prior.keyframes)
      blocks.push_back(&poses_[7 * position(id)]);
    for (const std::int64_t id : state_.prior.planes) blocks.push_back(plane_of_id(id));
    for (const std::int64_t id : state_.prior.worlds) blocks.push_back(world_of_id(id));
    problem_.AddResidualBlock(&prior_.emplace(state_.prior), nullptr, blocks);
  }

  const WindowState& state_;
  KernelLoss loss_;
  VariableManifold<SE3> manifold_;
  VariableManifold<Line3> line_manifold_;
  VariableManifold<Plane3> plane_manifold_;
  VariableManifold<SO3> world_manifold_;
  std::vector<std::int64_t> ids_;        ///< of keyframes, ascending
  std::vector<std::int64_t> plane_ids_;  ///< ascending
  std::vector<std::int64_t> world_ids_;  ///< ascending
  std::vector<double> poses_;            ///< of all keyframes; after them worlds, lines, planes
  std::vector<double> points_;
  std::vector<int> points_by_keyframe_;
  std::vector<char> is_held_;  ///< by a pose prior or a motion of full rank
  std::deque<PointFactor<Reprojection>> reprojections_;
  std::deque<PointFactor<InverseDepth>> inverse_depths_;
  std::deque<CeresFactor<LineReprojectionFactor>> segments_;
  std::deque<CeresFactor<PointOnPlaneFactor>> plane_points_;
  std::deque<CeresFactor<HeightAbovePlaneFactor>> heights_;
  std::deque<CeresFactor<PlaneObservationFactor>> planes_seen_;
  std::deque<CeresFactor<PosePriorFactor<SE3>>> pose_priors_;
  std::deque<CeresFactor<RelativePoseFactor<SE3>>> motions_;
  std::deque<CeresFactor<DistanceFactor>> distances_;
  std::deque<CeresFactor<AbsoluteRotationFactor>> rotations_;
  std::optional<MarginalPriorFactor> prior_;
  ceres::Problem problem_;  // after all it points to
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
};

}  // namespace

std::vector<const WindowObservation*> usable_observations(const WindowState& state,
                                                          const WindowLandmark& landmark) {
  std::vector<const WindowObservation*> usable;
  if (landmark.observations.size() < 2) return usable;
  usable.reserve(landmark.observations.size());
  for (const WindowObservation& o : landmark.observations) {
    const SE3& T_map_cam = state.keyframes.at(o.keyframe);
    const Eigen::Vector3d offset_map = landmark.p_map - T_map_cam.translation();
    const double depth_m = T_map_cam.rotation().matrix().col(2).dot(offset_map);
    if (depth_m > kMinDepth_m && depth_m < 1e12) usable.push_back(&o);
  }
  if (usable.size() < 2) usable.clear();
  return usable;
}

bool is_usable(const WindowLine& line) {
  std::size_t images = line.observations.size();
  for (const LineObservation& o : line.observations) images += o.second.has_value();
  return line.observations.size() >= 2 && images >= 3;
}

bool has_full_pose_prior(const WindowState& state) {
  return std::any_of(state.pose_priors.begin(), state.pose_priors.end(), [](const PosePrior& p) {
    bool deficient = false;
    whitening(p.information, &deficient);
    return !deficient;
  });
}

bool is_full(const MotionObservation& motion) {
  bool deficient = false;
  whitening(motion.information, &deficient);
  return !deficient;
}

bool has_metric_observation(const WindowState& state) {
  if (!state.distances.empty() || !state.plane_observations.empty()) return true;
  if (std::any_of(state.motions.begin(), state.motions.end(), is_full)) return true;
  // What is known of a rotation alone has no unit.
  const auto places =
      std::count_if(state.pose_priors.begin(), state.pose_priors.end(),
                    [](const PosePrior& p) { return !p.information.topRows<3>().isZero(0); });
  if (places + state.fixed.has_value() >= 2 && places > 0) return true;
  for (const HeightObservation& height : state.heights) {
    int points = 0;
    for (const auto& [id, landmark] : state.landmarks)
      points += landmark.on_plane && landmark.on_plane->plane == height.plane;
    if (points >= 3) return true;
  }
  for (const auto& [id, landmark] : state.landmarks)
    for (const WindowObservation& o : landmark.observations)
      if (o.inverse_depth) return true;
  for (const auto& [id, line] : state.lines)
    for (const LineObservation& o : line.observations)
      if (o.second) return true;
  return false;
}

std::optional<DistanceObservation> scale_reference(const WindowState& state) {
  const bool free = !state.fixed && !state.prior.empty();
  if (free || state.keyframes.empty() || state.prior_holds_scale || has_metric_observation(state))
    return std::nullopt;
  const std::int64_t reference = state.fixed.value_or(state.keyframes.begin()->first);
  const Eigen::Vector3d first = state.keyframes.at(reference).translation();
  DistanceObservation farthest{reference, reference, 0, 1};
  for (const auto& [id, T_map_cam] : state.keyframes) {
    const double distance_m = (T_map_cam.translation() - first).norm();
    if (distance_m > farthest.distance_m) farthest = {reference, id, distance_m, 0.01 * distance_m};
  }
  if (farthest.distance_m < 1e-9) return std::nullopt;
  return farthest;
}

WindowSummary optimize_window(WindowState& state) {
  WindowSummary summary;
  WindowProblem problem(state);
  summary.outcome = problem.check();
  if (!summary.outcome || problem.settled()) return summary;
  const ceres::Solver::Summary solved = problem.solve();
  summary.cost_initial = solved.initial_cost;
  summary.cost_final = solved.final_cost;
  summary.iterations = std::max(0, static_cast<int>(solved.iterations.size()) - 1);
  if (!solved.IsSolutionUsable() || !problem.finite()) {
    summary.cost_final = summary.cost_initial;
    summary.outcome = Outcome::failure(Outcome::Code::kNotConverged, solved.message);
    return summary;
  }
  const auto held =
      state.held_world ? std::optional(state.worlds.at(*state.held_world)) : std::nullopt;
  const Eigen::Vector3d p_map_oldest = state.keyframes.begin()->second.translation();
  problem.read_back(state);
  if (held) {
    // A prior that holds the window in the map swings it at the end of the way behind it.
    turn_window(state, *state.held_world, *held);
    const Eigen::Vector3d moved = state.keyframes.begin()->second.translation();
    move_window(state, SE3(SO3(), p_map_oldest - moved));
  }
  return summary;
}

}  // namespace placegraph
