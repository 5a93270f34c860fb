#pragma once
#include <placegraph/backend/solver/local_solver_options.h>
#include <placegraph/backend/solver/normal_equations.h>

namespace placegraph {

/// The engine `native`: Gauss-Newton or Levenberg-Marquardt on block-sparse normal equations.
/// If the cost would rise, Gauss-Newton steps are limited to a trust region by Powell's dogleg. A
/// factor is reused: later steps are by conjugate gradients preconditioned with it while that is
/// cheaper than a new factorization. Steps that shrink by a constant factor, as where residuals are
/// large, are replaced by the sum of their geometric series (Aitken). If the constraints leave
/// directions undetermined (singular normal equations), or if the dogleg was shortened repeatedly,
/// the steps are damped regardless of the step rule.
template <class Group>
class NativeSolver {
 public:
  explicit NativeSolver(const LocalSolverOptions& options) : options_(options) {}
  [[nodiscard]] LocalSolution solve(PackedGraph<Group>& graph);

 private:
  struct Step {
    Eigen::VectorXd dx;
    double promised = 0;  ///< predicted decrease of the cost by the quadratic model
  };
  std::optional<Step> newton_step();
  std::optional<Step> conjugate_gradients(int max_iterations);
  std::optional<Step> damped_step();
  bool negligible(const Step& step) const;

  bool take(PackedGraph<Group>& graph, const Step& step, double least_gain);
  bool take_series(PackedGraph<Group>& graph, const Step& newton);
  bool take_dogleg(PackedGraph<Group>& graph, const Step& newton);
  bool take_damped(PackedGraph<Group>& graph, const Step& step);

  LocalSolverOptions options_;
  std::optional<NormalEquations<Group>> equations_;
  double cost_ = 0;               ///< cost at the poses where the equations were linearized
  double relative_decrease_ = 1;  ///< by the last step; small if the last factor is accurate
  double radius_ = 0;             ///< radius of the trust region, in the norm of sqrt(diag(H))
  double lambda_ = 0;             ///< damping in units of diag(H); 0: not damped
  double raise_ = 2;              ///< factor of the damping at the next rejection
  double gain_ = 0;  ///< decrease by the last step, accepted or not, as a share of the prediction
  Eigen::VectorXd last_;  ///< the Newton step before, as far as it was taken as it is
  double shrinkage_ = 0;  ///< ratio of its length to that of the one before; 0: unknown
  int shortened_ = 0;     ///< number of successive dogleg steps that were no Newton steps
  std::vector<Group> before_shortening_;
};

}  // namespace placegraph
