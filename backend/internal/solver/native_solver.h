#pragma once
#include <placegraph/backend/internal/solver/local_solver_options.h>
#include <placegraph/backend/internal/solver/normal_equations.h>

namespace placegraph {

/// The engine `native`: Gauss-Newton steps, kept in a trust region by Powell's dogleg where the
/// cost would rise, or Levenberg-Marquardt, over block-sparse normal equations. A factor is kept as
/// long as it serves: later steps come from conjugate gradients preconditioned with it while that
/// is cheaper than factorizing anew. Where the constraints leave directions open (singular normal
/// equations), or where the dogleg had to be shortened time and again, the steps are damped
/// whatever the rule.
template <class Group>
class NativeSolver {
 public:
  explicit NativeSolver(const LocalSolverOptions& options) : options_(options) {}
  [[nodiscard]] LocalSolution solve(PackedGraph<Group>& graph);

 private:
  struct Step {
    Eigen::VectorXd dx;
    double promised = 0;  ///< decrease of the cost by the quadratic model
  };
  std::optional<Step> newton_step();
  std::optional<Step> conjugate_gradients(int max_iterations);
  std::optional<Step> damped_step();
  bool negligible(const Step& step) const;

  bool take(PackedGraph<Group>& graph, const Step& step);
  bool take_dogleg(PackedGraph<Group>& graph, const Step& newton);
  bool take_damped(PackedGraph<Group>& graph, const Step& step);

  LocalSolverOptions options_;
  std::optional<NormalEquations<Group>> equations_;
  double cost_ = 0;               ///< at the poses where the equations were linearized
  double relative_decrease_ = 1;  ///< of the last step: how near the last factor still is
  double radius_ = 0;             ///< of the trust region, in the norm of sqrt(diag(H))
  double lambda_ = 0;             ///< damping in units of diag(H); 0: not damped
  double raise_ = 2;              ///< by which the next rejection raises it
  double gain_ = 0;               ///< of the last step, taken or not, as a share of its promise
  int shortened_ = 0;             ///< steps of the dogleg in a row that were no Newton steps
  std::vector<Group> before_shortening_;
};

}  // namespace placegraph
