#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/raw_camera.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

void RawCamera::check() const {
  camera.check();
  for (const double k : denominator)
    require(std::isfinite(k), "camera.denominator: " + std::to_string(k) + " is not finite");
  require(!is_rational() || camera.distortion == Distortion::kRadialTangential,
          "camera.denominator: only a radial-tangential lens has one");
}

std::vector<double> RawCamera::coefficients() const {
  const std::ptrdiff_t count = camera.distortion == Distortion::kEquidistant ? 4 : 5;
  std::vector<double> k(camera.coefficients.begin(), camera.coefficients.begin() + count);
  if (is_rational()) k.insert(k.end(), denominator.begin(), denominator.end());
  return k;
}

double RawCamera::rational_reach() const {
  const auto& k = camera.coefficients;
  constexpr double kStep_rad = 1e-3;
  double reach = 0;
  for (int i = 1; i < 1570; ++i) {  // up to a right angle
    const double r = std::tan(i * kStep_rad), x = r * r;
    const double below = 1 + x * (denominator[0] + x * (denominator[1] + x * denominator[2]));
    const double distorted = r * (1 + x * (k[0] + x * (k[1] + x * k[4]))) / below;
    if (!(below > 0 && distorted > reach)) break;
    reach = distorted;
  }
  return reach;
}

void set_radial_tangential(const std::vector<double>& coefficients, RawCamera& raw) {
  const std::size_t n = coefficients.size();
  const auto zero_from = [&](std::size_t first) {
    return n <= first || std::all_of(coefficients.begin() + static_cast<std::ptrdiff_t>(first),
                                     coefficients.end(), [](double k) { return k == 0; });
  };
  require(n >= 4 && zero_from(8) && (n >= 8 || zero_from(5)),
          fmt::format("a radial-tangential lens has 4, 5 or 8 coefficients, not {}{}", n,
                      n > 8 ? " (thin prism and tilt are read where they are zero; else undistort "
                              "the images first)"
                            : ""));
  raw.camera.distortion = Distortion::kRadialTangential;
  std::copy_n(coefficients.begin(), std::min<std::size_t>(n, 5), raw.camera.coefficients.begin());
  if (n >= 8) std::copy_n(coefficients.begin() + 5, 3, raw.denominator.begin());
}

}  // namespace placegraph
