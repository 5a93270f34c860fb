#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace placegraph {

double chi_squared_tail(double x, int dof) {
  if (x <= 0) return 1;
  const double half = 0.5 * x;
  double tail = dof % 2 == 1 ? std::erfc(std::sqrt(half)) : std::exp(-half);
  double term =
      dof % 2 == 1 ? std::sqrt(half / std::numbers::pi) * 2 * std::exp(-half) : half * tail;
  for (int k = dof % 2 == 1 ? 1 : 2; k < dof; k += 2) {  // from k to k + 2 degrees
    tail += term;
    term *= half / (0.5 * k + 1);
  }
  return tail;
}

double chi_squared_quantile(double probability, int dof) {
  require(probability > 0 && probability < 1, "chi_squared_quantile: probability");
  double low = 0, high = 1;
  while (chi_squared_tail(high, dof) > 1 - probability) high *= 2;
  for (int i = 0; i < 100 && high - low > 1e-13 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (chi_squared_tail(middle, dof) > 1 - probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double mean_square_quantile(double z, double dof) {
  const double variance = 2 / (9 * dof);
  const double root = std::max(0.0, 1 - variance + z * std::sqrt(variance));
  return root * root * root;
}

}  // namespace placegraph
