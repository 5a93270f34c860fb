#include <ceres/problem.h>
#include <ceres/solver.h>
#include <placegraph/backend/factors/inverse_depth.h>
#include <placegraph/backend/factors/point_on_plane.h>
#include <placegraph/backend/linear/sparse_algebra.h>
#include <placegraph/backend/solver/ceres_factor.h>
#include <placegraph/backend/solver/kernel_loss.h>
#include <placegraph/backend/window/point_factor.h>
#include <placegraph/backend/window/window_blocks.h>
#include <placegraph/backend/window/window_problem.h>
#include <placegraph/backend/window/window_transform.h>

#include <algorithm>
#include <deque>

namespace placegraph {
namespace {

/// Minimum number of points and lines that determine a free keyframe outside the prior.
constexpr int kMinPointsPerKeyframe = 3;

/// Options with which the problem does not own blocks and factors.
ceres::Problem::Options borrowed_parts() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

Outcome too_few(const std::string& reason) {
  return Outcome::failure(Outcome::Code::kTooFewData, reason);
}

/// The window as a Ceres problem: points, which are eliminated first, lines and all other
/// variables.
class WindowProblem {
 public:
  explicit WindowProblem(const WindowState& state)
      : state_(state),
        loss_({RobustKernel::Kind::kHuber, state.options.huber_px}),
        blocks_(state),
        points_by_keyframe_(state.keyframes.size()),
        problem_(borrowed_parts()),
        ordering_(std::make_shared<ceres::ParameterBlockOrdering>()) {
    add_points();
    add_lines();
    add_factors();
    add_prior();
    add_variables();
  }

  /// Ok, or the reason for which the data determine no estimate.
  Outcome check() const;
  /// Whether the cost is already zero, as for a chain of motions: no step can lower it.
  bool settled();
  ceres::Solver::Summary solve();
  bool finite() const { return blocks_.finite(); }
  /// Writes the estimate to the state. Points and lines that were not in the problem move with the
  /// keyframe that observed them last.
  void read_back(WindowState& state) const;

 private:
  void add_points();
  void add_point(const WindowLandmark& landmark, double* point);
  void add_lines();
  void add_factors();
  void add_factor(const WindowFactor& factor);
  void add_prior();
  void add_variables();
  bool is_determined(std::size_t k) const;
  ceres::Manifold* manifold_of(const WindowVariable& variable);

  const WindowState& state_;
  KernelLoss loss_;
  VariableManifold<SE3> pose_manifold_;
  VariableManifold<Line3> line_manifold_;
  VariableManifold<Plane3> plane_manifold_;
  VariableManifold<SO3> rotation_manifold_;
  WindowBlocks blocks_;
  std::vector<int> points_by_keyframe_;
  std::optional<WindowFactor> reference_;
  std::deque<PointFactor<Reprojection>> reprojections_;
  std::deque<PointFactor<InverseDepth>> inverse_depths_;
  std::deque<CeresFactor<LineReprojectionFactor>> segments_;
  std::deque<CeresFactor<PointOnPlaneFactor>> plane_points_;
  std::deque<DynamicCeresFactor> factors_;
  std::optional<MarginalPriorFactor> prior_;
  ceres::Problem problem_;  // declared after all objects that it points to
  std::shared_ptr<ceres::ParameterBlockOrdering> ordering_;
};

void WindowProblem::add_points() {
  std::size_t k = 0;
  for (const auto& [id, landmark] : state_.landmarks) add_point(landmark, blocks_.point(k++));
}

void WindowProblem::add_point(const WindowLandmark& landmark, double* point) {
  const auto usable = usable_observations(state_, landmark);
  for (const WindowObservation* o : usable) {
    const std::size_t k = blocks_.position(o->keyframe);
    double* const pose = blocks_.variable(k);
    ++points_by_keyframe_[k];
    problem_.AddResidualBlock(&reprojections_.emplace_back(reprojection_of(state_.camera, *o)),
                              &loss_, pose, point);
    if (!o->inverse_depth) continue;
    problem_.AddResidualBlock(
        &inverse_depths_.emplace_back(InverseDepth(*o->inverse_depth, o->sigma_inverse_depth)),
        &loss_, pose, point);
  }
  if (usable.empty()) return;
  ordering_->AddElementToGroup(point, 0);
  if (!landmark.on_plane) return;
  problem_.AddResidualBlock(
      &plane_points_.emplace_back(PointOnPlaneFactor(landmark.on_plane->sigma_m)), &loss_, point,
      blocks_.at(plane_variable(landmark.on_plane->plane)));
}

/// Lines are few and are solved with the poses: Ceres' code for points is fast only if all
/// eliminated blocks have the same size.
void WindowProblem::add_lines() {
  std::size_t i = 0;
  for (const auto& [id, line] : state_.lines) {
    double* const block = blocks_.line(i++);
    if (!is_usable(line)) continue;
    for (const LineObservation& o : line.observations) {
      const std::size_t k = blocks_.position(o.keyframe);
      ++points_by_keyframe_[k];
      for_factors(state_.camera, o, [&](const LineReprojectionFactor& factor) {
        problem_.AddResidualBlock(&segments_.emplace_back(factor), &loss_, blocks_.variable(k),
                                  block);
      });
    }
    problem_.SetManifold(block, &line_manifold_);
    ordering_->AddElementToGroup(block, 1);
  }
}

void WindowProblem::add_factors() {
  reference_ = scale_reference(state_);
  if (reference_) add_factor(*reference_);
  for (const WindowFactor& factor : state_.factors) add_factor(factor);
}

void WindowProblem::add_factor(const WindowFactor& factor) {
  std::vector<Variable> values;
  std::vector<double*> blocks;
  for (const WindowVariable& variable : factor.variables) {
    values.push_back(value_of(state_, variable));
    blocks.push_back(blocks_.at(variable));
  }
  problem_.AddResidualBlock(&factors_.emplace_back(*factor.factor, std::move(values)),
                            factor.robust ? &loss_ : nullptr, blocks);
}

void WindowProblem::add_prior() {
  if (state_.prior.empty()) return;
  std::vector<double*> blocks;
  for (const KeyframeId id : state_.prior.keyframes)
    blocks.push_back(blocks_.at(keyframe_variable(id)));
  for (const PlaneId id : state_.prior.planes) blocks.push_back(blocks_.at(plane_variable(id)));
  for (const ManhattanFrameId id : state_.prior.manhattan_frames)
    blocks.push_back(blocks_.at(manhattan_variable(id)));
  problem_.AddResidualBlock(&prior_.emplace(state_.prior), nullptr, blocks);
}

ceres::Manifold* WindowProblem::manifold_of(const WindowVariable& variable) {
  switch (variable.kind) {
    case WindowVariable::Kind::kPlane:
      return &plane_manifold_;
    case WindowVariable::Kind::kManhattanFrame:
      return &rotation_manifold_;
    default:
      return &pose_manifold_;
  }
}

void WindowProblem::add_variables() {
  for (std::size_t k = 0; k < blocks_.variables().size(); ++k) {
    double* const block = blocks_.variable(k);
    if (!problem_.HasParameterBlock(block)) continue;
    problem_.SetManifold(block, manifold_of(blocks_.variables()[k]));
    ordering_->AddElementToGroup(block, 1);
    if (k < blocks_.keyframes() && state_.fixed == blocks_.variables()[k].keyframe())
      problem_.SetParameterBlockConstant(block);
  }
}

/// Whether the data determine the pose of the k-th keyframe.
bool WindowProblem::is_determined(std::size_t k) const {
  const WindowVariable& keyframe = blocks_.variables()[k];
  if (state_.fixed == keyframe.keyframe() || points_by_keyframe_[k] >= kMinPointsPerKeyframe)
    return true;
  // While a keyframe is held, the prior is too weak to determine others.
  const auto& in_prior = state_.prior.keyframes;
  if (!state_.fixed && std::binary_search(in_prior.begin(), in_prior.end(), keyframe.keyframe()))
    return true;
  return std::any_of(state_.factors.begin(), state_.factors.end(), [&](const WindowFactor& factor) {
    return touches(factor, keyframe) && determines(state_, factor, keyframe);
  });
}

Outcome WindowProblem::check() const {
  if (blocks_.keyframes() < 2) return too_few("a window of fewer than two keyframes");
  for (std::size_t k = 0; k < blocks_.keyframes(); ++k)
    if (!is_determined(k))
      return too_few(to_string(blocks_.variables()[k]) + " observes " +
                     std::to_string(points_by_keyframe_[k]) +
                     " points or lines that other keyframes observe, too; " +
                     std::to_string(kMinPointsPerKeyframe) + " needed");
  return Outcome::ok();
}

bool WindowProblem::settled() {
  // A cost of rounding errors. Chosen.
  constexpr double kNothing = 1e-12;
  double cost = 1;
  return state_.landmarks.empty() && state_.lines.empty() &&
         problem_.Evaluate({}, &cost, nullptr, nullptr, nullptr) && cost < kNothing;
}

ceres::Solver::Summary WindowProblem::solve() {
  ceres::Solver::Options options;
  // Residuals connect lines to keyframes only, not to other lines.
  options.linear_solver_type = state_.lines.empty() ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  options.sparse_linear_algebra_library_type = kSparseAlgebra;
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

void WindowProblem::read_back(WindowState& state) const {
  const std::map<KeyframeId, SE3> before = state.keyframes;
  std::size_t k = 0;
  for (auto& [id, T_map_cam] : state.keyframes) {
    double const* const pose = blocks_.variable(k++);
    if (problem_.HasParameterBlock(pose) && state.fixed != id)
      T_map_cam = VariableBlock<SE3>::load(pose);
  }
  for (auto& [id, plane_map] : state.planes)
    plane_map = VariableBlock<Plane3>::load(blocks_.variable(k++));
  for (auto& [id, R_map_manhattan] : state.manhattan_frames)
    R_map_manhattan = VariableBlock<SO3>::load(blocks_.variable(k++));
  const auto motion_of = [&](const auto& landmark) {
    const KeyframeId seen = landmark.observations.back().keyframe;
    return std::pair(state.keyframes.at(seen), before.at(seen).inverse());
  };
  std::size_t i = 0;
  for (auto& [id, landmark] : state.landmarks) {
    double const* const point = blocks_.point(i++);
    if (problem_.HasParameterBlock(point)) {
      landmark.p_map = VariableBlock<Eigen::Vector3d>::load(point);
    } else if (!landmark.observations.empty()) {
      const auto [T_map_now, T_before_map] = motion_of(landmark);
      landmark.p_map = T_map_now * (T_before_map * landmark.p_map);
    }
  }
  i = 0;
  for (auto& [id, line] : state.lines) {
    double const* const block = blocks_.line(i++);
    if (problem_.HasParameterBlock(block)) {
      line.line_map = VariableBlock<Line3>::load(block);
    } else if (!line.observations.empty()) {
      const auto [T_map_now, T_before_map] = motion_of(line);
      line.line_map = moved(line.line_map, T_map_now * T_before_map);
    }
  }
}

}  // namespace

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
  const auto held = state.held_manhattan_frame
                        ? std::optional(state.manhattan_frames.at(*state.held_manhattan_frame))
                        : std::nullopt;
  const Eigen::Vector3d p_map_oldest = state.keyframes.begin()->second.translation();
  problem.read_back(state);
  if (held) {
    // A prior that ties the window to the map rotates it about a distant point of the past path.
    rotate_window(state, *state.held_manhattan_frame, *held);
    const Eigen::Vector3d moved_to = state.keyframes.begin()->second.translation();
    move_window(state, SE3(SO3(), p_map_oldest - moved_to));
  }
  return summary;
}

}  // namespace placegraph
