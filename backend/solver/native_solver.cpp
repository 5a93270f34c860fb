#include <placegraph/backend/solver/native_solver.h>
#include <placegraph/graph/text/log_message.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

/// Relative residual of a sufficiently accurate step in the preconditioner's norm: near the minimum
/// Gauss-Newton itself gains about two digits per step.
constexpr double kForcing = 1e-2;
/// Pivots below this share of the diagonal are regarded as undetermined directions.
constexpr double kSingularPivot = 1e-12;
constexpr double kLeastGain = 1e-4;  ///< minimum share of the predicted decrease
// Rejected steps in a row that end a descent. Chosen.
constexpr int kMaxRejections = 30;
/// After this number of successive shortened steps the solver restarts from the initial poses with
/// damping: the dogleg would need hundreds of steps to bend a long chain. The initial damping is
/// very small, because bending has very little curvature.
constexpr int kMostShortened = 8;
constexpr double kDampingOfOpenDirections = 1e-4;
constexpr double kFirstDamping = 1e-10, kLeastDamping = 1e-16;

}  // namespace

/// Solves H dx = -g by conjugate gradients if the last factor is accurate enough, else by a new
/// factor. Empty if H is singular.
template <class Group>
auto NativeSolver<Group>::newton_step() -> std::optional<Step> {
  BlockCholesky& H = equations_->matrix();
  if (H.has_factor() && relative_decrease_ < 0.5) {
    const int affordable = static_cast<int>(0.6 * H.solves_per_factorization());
    if (affordable >= 2)
      if (auto step = conjugate_gradients(affordable)) return step;
  }
  if (!H.factorize() || H.smallest_pivot() < kSingularPivot) return std::nullopt;
  Step step{-equations_->gradient(), 0};
  H.solve(step.dx);
  step.promised = -equations_->gradient().dot(step.dx);
  return step;
}

/// Preconditioned conjugate gradients (Hestenes & Stiefel 1952) on H dx = -g from zero; empty if
/// they do not converge within `max_iterations`, which is predicted early from the convergence
/// rate.
template <class Group>
auto NativeSolver<Group>::conjugate_gradients(int max_iterations) -> std::optional<Step> {
  BlockCholesky& H = equations_->matrix();
  Eigen::VectorXd residual = -equations_->gradient(), z = residual, product;
  H.solve(z);
  Step step{Eigen::VectorXd::Zero(z.size()), 0};
  Eigen::VectorXd direction = z;
  double rz = residual.dot(z);
  const double goal = kForcing * kForcing * rz;
  const double first = rz;
  for (int k = 1; k <= max_iterations; ++k) {
    H.multiply(direction, product);
    const double curvature = direction.dot(product);
    if (!(curvature > 0)) return std::nullopt;
    const double alpha = rz / curvature;
    step.dx += alpha * direction;
    residual -= alpha * product;
    z = residual;
    H.solve(z);
    const double rz_next = residual.dot(z);
    if (rz_next <= goal) {
      step.promised = -equations_->gradient().dot(step.dx);
      return step;
    }
    const double pace = std::pow(rz_next / first, 1.0 / k);
    if (first * std::pow(pace, max_iterations) > goal) return std::nullopt;
    direction = z + (rz_next / rz) * direction;
    rz = rz_next;
  }
  return std::nullopt;
}

template <class Group>
auto NativeSolver<Group>::damped_step() -> std::optional<Step> {
  BlockCholesky& H = equations_->matrix();
  const Eigen::VectorXd diagonal = H.diagonal();
  const double floor = 1e-6 * diagonal.maxCoeff();
  for (int attempt = 0; attempt < kMaxRejections; ++attempt, lambda_ *= 10) {
    const Eigen::VectorXd damping = lambda_ * diagonal.cwiseMax(floor);
    if (!H.factorize(damping)) continue;
    Step step{-equations_->gradient(), 0};
    H.solve(step.dx);
    // f - model(dx) = -2 g dx - dx H dx with (H + D) dx = -g.
    step.promised =
        -equations_->gradient().dot(step.dx) + step.dx.dot(damping.cwiseProduct(step.dx));
    return step;
  }
  return std::nullopt;
}

template <class Group>
bool NativeSolver<Group>::negligible(const Step& step) const {
  return step.promised <= options_.relative_decrease * cost_ ||
         step.dx.template lpNorm<Eigen::Infinity>() < 1e-13;
}

/// Moves by the step if the cost falls by a sufficient share of the predicted decrease.
template <class Group>
bool NativeSolver<Group>::take(PackedGraph<Group>& graph, const Step& step, double least_gain) {
  const std::vector<Group> before = graph.poses;
  equations_->move(graph, step.dx);
  // Steps are nearly always accepted, so the equations are directly computed at the new poses.
  const double cost = equations_->linearize(graph, options_.rotation_error);
  gain_ = (cost_ - cost) / step.promised;
  const bool taken = options_.step_rule == StepRule::kGaussNewton && lambda_ == 0
                         ? std::isfinite(cost)
                         : cost_ - cost >= least_gain * step.promised;
  if (taken) {
    relative_decrease_ = std::abs(cost_ - cost) / cost_;
    cost_ = cost;
    return true;
  }
  graph.poses = before;
  equations_->linearize(graph, options_.rotation_error);
  return false;
}

/// Where large residuals let successive Newton steps shrink by a constant factor in one direction,
/// their sum is known in advance: tries it, if the cost falls by more than by the step itself.
template <class Group>
bool NativeSolver<Group>::take_series(PackedGraph<Group>& graph, const Step& newton) {
  constexpr double kAligned = 0.95;   // cosine of successive steps
  constexpr double kLeast = 0.5;      // ratio of their lengths: below, the series is short
  constexpr double kConstant = 0.05;  // change of the ratio
  constexpr double kGain = 2;         // that of a step of the series itself is below
  const double before = last_.size() == newton.dx.size() ? last_.norm() : 0;
  const double length = newton.dx.norm();
  const double shrinkage = before > 0 ? length / before : 0;
  const bool constant = shrinkage > kLeast && shrinkage < 1 &&
                        std::abs(shrinkage - shrinkage_) < kConstant &&
                        newton.dx.dot(last_) > kAligned * length * before;
  shrinkage_ = shrinkage;
  last_ = newton.dx;
  if (!constant) return false;
  shrinkage_ = 0;
  const Step sum{newton.dx / (1 - shrinkage), newton.promised};
  if (!take(graph, sum, kGain)) return false;
  last_.resize(0);
  return true;
}

/// Powell's dogleg (Nocedal & Wright 2006, section 4.1) in the norm of sqrt(diag(H)): the Newton
/// step if it is in the trust region, else the combination of it and the Cauchy point.
template <class Group>
bool NativeSolver<Group>::take_dogleg(PackedGraph<Group>& graph, const Step& newton) {
  BlockCholesky& H = equations_->matrix();
  const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const double newton_length = newton.dx.cwiseProduct(scale).norm();
  if (newton_length <= radius_) {
    if (take_series(graph, newton) || take(graph, newton, kLeastGain)) {
      shortened_ = 0;
      radius_ = std::max(radius_, 3 * newton_length);
      return true;
    }
    radius_ = 0.5 * newton_length;
  }
  if (shortened_++ == 0) before_shortening_ = graph.poses;
  const Eigen::VectorXd& g = equations_->gradient();
  const Eigen::VectorXd downhill = -g.cwiseQuotient(scale.cwiseAbs2());
  Eigen::VectorXd product;
  H.multiply(downhill, product);
  const Eigen::VectorXd cauchy =
      downhill * (-g.dot(downhill) / std::max(downhill.dot(product), 1e-300));
  const auto norm = [&](const Eigen::VectorXd& dx) { return dx.cwiseProduct(scale).norm(); };
  for (int attempt = 0; attempt < kMaxRejections; ++attempt, radius_ *= 0.35) {
    Step step;
    if (const double length = norm(cauchy); length >= radius_) {
      step.dx = cauchy * (radius_ / length);
    } else {
      // |cauchy + s (newton - cauchy)| = radius, the root in [0, 1].
      const Eigen::VectorXd bend = (newton.dx - cauchy).cwiseProduct(scale);
      const double a = bend.squaredNorm(), b = bend.dot(cauchy.cwiseProduct(scale));
      const double c = length * length - radius_ * radius_;
      const double root = std::sqrt(std::max(0.0, b * b - a * c));
      const double s = b > 0 ? -c / (b + root) : (root - b) / std::max(a, 1e-300);
      step.dx = cauchy + std::clamp(s, 0.0, 1.0) * (newton.dx - cauchy);
    }
    H.multiply(step.dx, product);
    step.promised = -2 * equations_->gradient().dot(step.dx) - step.dx.dot(product);
    if (negligible(step)) return false;
    if (take(graph, step, kLeastGain)) return true;
  }
  return false;
}

/// The damping follows the gain (Nielsen 1999).
template <class Group>
bool NativeSolver<Group>::take_damped(PackedGraph<Group>& graph, const Step& step) {
  if (!take(graph, step, kLeastGain)) {
    lambda_ *= raise_;
    raise_ *= 2;
    return false;
  }
  const double beyond = 2 * gain_ - 1;
  lambda_ = std::max(lambda_ * std::max(1.0 / 3, 1 - beyond * beyond * beyond), kLeastDamping);
  raise_ = 2;
  return true;
}

template <class Group>
LocalSolution NativeSolver<Group>::solve(PackedGraph<Group>& graph) {
  if (!equations_ || !equations_->fits(graph)) equations_.emplace(graph);
  relative_decrease_ = 1;
  radius_ = std::numeric_limits<double>::infinity();
  lambda_ = options_.step_rule == StepRule::kLevenbergMarquardt ? 1e-5 : 0;
  raise_ = 2;
  shortened_ = 0;
  last_.resize(0);
  shrinkage_ = 0;
  LocalSolution solution;
  cost_ = solution.cost_initial = equations_->linearize(graph, options_.rotation_error);
  solution.outcome = Outcome::failure(Outcome::Code::kNotConverged,
                                      "the maximum number of iterations was reached");
  int rejections = 0;
  for (;;) {
    std::optional<Step> step;
    if (lambda_ == 0 && shortened_ == kMostShortened) {
      graph.poses = before_shortening_;
      cost_ = equations_->linearize(graph, options_.rotation_error);
      lambda_ = kFirstDamping;
    }
    if (lambda_ == 0 && !(step = newton_step())) lambda_ = kDampingOfOpenDirections;
    if (lambda_ > 0) step = damped_step();
    if (!step || !step->dx.allFinite()) {
      solution.outcome =
          Outcome::failure(Outcome::Code::kNotConverged, "the normal equations have no solution");
      break;
    }
    if (negligible(*step)) {
      solution.outcome = Outcome::ok();
      break;
    }
    if (solution.iterations == options_.max_iterations) break;
    ++solution.iterations;
    const bool taken = lambda_ > 0 ? take_damped(graph, *step)
                       : options_.step_rule == StepRule::kGaussNewton
                           ? take(graph, *step, kLeastGain)
                           : take_dogleg(graph, *step);
    rejections = taken ? 0 : rejections + 1;
    log(options_.log, LogLevel::kDebug, "iteration {}: cost {:f}", solution.iterations, cost_);
    // No step of any length lowers the cost: the minimum, up to rounding.
    if (!taken && (lambda_ == 0 || rejections == kMaxRejections)) {
      solution.outcome = Outcome::ok();
      break;
    }
  }
  solution.cost_final = cost_;
  const BlockCholesky& H = equations_->matrix();
  solution.regular = lambda_ == 0 && H.has_factor() && H.smallest_pivot() >= kSingularPivot;
  return solution;
}

template class NativeSolver<SE2>;
template class NativeSolver<SE3>;
template class NativeSolver<Sim3>;

}  // namespace placegraph
