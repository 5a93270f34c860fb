#include <placegraph/graph/core/robust_kernel.h>

#include <cmath>

namespace placegraph {

RobustKernel::Value RobustKernel::evaluate(double s) const {
  const double b = width * width;
  switch (kind) {
    case Kind::kNone:
      break;
    case Kind::kHuber: {
      if (s <= b) break;
      const double r = std::sqrt(s);
      return {2 * width * r - b, width / r, -width / (2 * s * r)};
    }
    case Kind::kCauchy: {
      const double inverse = 1 / (1 + s / b);
      return {b * std::log1p(s / b), inverse, -inverse * inverse / b};
    }
    case Kind::kTukey: {
      if (s > b) return {b / 3, 0, 0};
      const double value = 1 - s / b;
      return {b / 3 * (1 - value * value * value), value * value, -2 / b * value};
    }
    case Kind::kGemanMcClure: {
      const double factor = b / (b + s);
      return {s * factor, factor * factor, -2 * factor * factor / (b + s)};
    }
    case Kind::kDcs: {  // Agarwal et al. 2013, as a kernel: rho' is the square of their scale
      if (s <= b) break;
      const double scale = 2 * b / (b + s);
      return {b * (3 * s - b) / (b + s), scale * scale, -2 * scale * scale / (b + s)};
    }
    case Kind::kTruncated:
      if (s <= b) break;
      return {b, 0, 0};
  }
  return {s, 1, 0};
}

const std::vector<std::string>& robust_kernel_names() {
  static const std::vector<std::string> names = {"none",          "huber", "cauchy",   "tukey",
                                                 "geman_mcclure", "dcs",   "truncated"};
  return names;
}

}  // namespace placegraph
