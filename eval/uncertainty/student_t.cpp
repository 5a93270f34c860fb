#include <placegraph/eval/uncertainty/student_t.h>
#include <placegraph/graph/core/error.h>

#include <unsupported/Eigen/SpecialFunctions>

namespace placegraph {

double student_t_tail(double x, double dof) {
  const double beyond = 0.5 * Eigen::numext::betainc(0.5 * dof, 0.5, dof / (dof + x * x));
  return x >= 0 ? beyond : 1 - beyond;
}

double student_t_quantile(double probability, double dof) {
  require(probability > 0 && probability < 1, "student_t_quantile: probability");
  require(dof > 0, "student_t_quantile: degrees of freedom");
  if (probability < 0.5) return -student_t_quantile(1 - probability, dof);
  double low = 0, high = 1;
  while (student_t_tail(high, dof) > 1 - probability) high *= 2;
  for (int i = 0; i < 100 && high - low > 1e-13 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (student_t_tail(middle, dof) > 1 - probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace placegraph
