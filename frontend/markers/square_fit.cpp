#include <placegraph/frontend/markers/square_fit.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace placegraph {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int kParameters = 7;
constexpr int kOffsetStart = 0, kOffsetEnd = 1, kMean = 2, kMeanSlope = 3, kHalf = 4,
              kHalfSlope = 5, kBlur = 6;
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;

/// A pixel beside a side: position along it (0 to 1) and distance outside of it.
struct SidePixel {
  double along = 0, outside_px = 0, grey = 0;
};

struct Side {
  Vector2d start, end, outwards;       ///< expected side
  Vector2d offset = Vector2d::Zero();  ///< offset of the fit at start and end, outwards
  Matrix2d covariance = Matrix2d::Zero();
  double contrast = 0;
};

/// The image's pixels in undistorted coordinates.
class StraightPixels {
 public:
  StraightPixels(const Image& grey, const Camera* lens) : grey_(grey) {
    if (lens && lens->distortion != Distortion::kNone) lens_ = lens;
  }
  std::optional<Vector2d> straight(const Vector2d& px) const {
    if (!lens_) return px;
    const auto ray = lens_->unproject(px);
    if (!ray) return std::nullopt;
    return Vector2d(lens_->fx * ray->x() + lens_->cx, lens_->fy * ray->y() + lens_->cy);
  }
  std::optional<Vector2d> image(const Vector2d& straight, Matrix2d& J_image_straight) const {
    J_image_straight.setIdentity();
    if (!lens_) return straight;
    Eigen::Matrix<double, 2, 3> J;
    const auto px = lens_->project(
        {(straight.x() - lens_->cx) / lens_->fx, (straight.y() - lens_->cy) / lens_->fy, 1}, &J);
    J_image_straight << J.col(0) / lens_->fx, J.col(1) / lens_->fy;
    return px;
  }
  /// The pixels of the parallelogram around a side in the image.
  template <class Use>
  void visit_band(const Side& side, double reach_px, const Use& use) const {
    Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    Matrix2d J;
    for (const Vector2d& end : {side.start, side.end}) {
      const auto px = image(end, J);
      if (!px) return;
      low = low.cwiseMin(*px);
      high = high.cwiseMax(*px);
    }
    const double grown = reach_px + (lens_ ? 0.1 * (high - low).norm() : 0) + 1;
    const int left = std::max(0, static_cast<int>(low.x() - grown));
    const int top = std::max(0, static_cast<int>(low.y() - grown));
    const int right = std::min(grey_.cols - 1, static_cast<int>(high.x() + grown));
    const int bottom = std::min(grey_.rows - 1, static_cast<int>(high.y() + grown));
    for (int v = top; v <= bottom; ++v) {
      const std::uint8_t* row = grey_.ptr<std::uint8_t>(v);
      for (int u = left; u <= right; ++u)
        if (const auto at = straight(Vector2d(u, v))) use(*at, row[u]);
    }
  }

 private:
  const Image& grey_;
  const Camera* lens_ = nullptr;
};

/// The usable part of a side: near its ends the neighbouring sides change the grey values.
struct Band {
  double inside_px = 0, outside_px = 0;
  double border_px = 0;                     ///< width of the dark border across the side
  double start_margin = 0, end_margin = 0;  ///< shares of the side
};

double cotangent(const Vector2d& a, const Vector2d& b) {
  const double cross = a.x() * b.y() - a.y() * b.x();
  return std::abs(a.dot(b)) / std::max(1e-6, std::abs(cross));
}

std::vector<SidePixel> pixels_of(const StraightPixels& pixels, const Side& side, const Band& band,
                                 std::size_t most) {
  const Vector2d extent = side.end - side.start;
  std::vector<SidePixel> result;
  pixels.visit_band(side, std::max(band.inside_px, band.outside_px),
                    [&](const Vector2d& px, double grey) {
                      const double along = (px - side.start).dot(extent) / extent.squaredNorm();
                      const double outside = (px - side.start).dot(side.outwards);
                      if (along < band.start_margin || along > 1 - band.end_margin) return;
                      if (outside < -band.inside_px || outside > band.outside_px) return;
                      result.push_back({along, outside, grey});
                    });
  // Long sides have more pixels than needed: some are left out, in a pattern unrelated to the grid.
  if (result.size() <= most) return result;
  std::vector<SidePixel> kept;
  const double share = static_cast<double>(most) / static_cast<double>(result.size()),
               irrational = 0.6180339887498949;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double at = irrational * static_cast<double>(i);
    if (at - std::floor(at) < share) kept.push_back(result[i]);
  }
  return kept;
}

/// Initial levels from the two ends of the band.
Parameters start_of(const std::vector<SidePixel>& pixels, const Band& band) {
  double inside = 0, outside = 0, n_inside = 1e-9, n_outside = 1e-9;
  for (const SidePixel& pixel : pixels) {
    if (pixel.outside_px < -0.4 * band.inside_px) {
      inside += pixel.grey;
      ++n_inside;
    } else if (pixel.outside_px > 0.4 * band.outside_px) {
      outside += pixel.grey;
      ++n_outside;
    }
  }
  inside /= n_inside;
  outside /= n_outside;
  Parameters x = Parameters::Zero();
  x[kMean] = (inside + outside) / 2;
  x[kHalf] = (outside - inside) / 2;
  x[kBlur] = 0.9;
  return x;
}

/// A step from -1 to 1 smoothed by a unit Gaussian, and its slope.
struct Step {
  double value = 0, slope = 0;
};
Step step_at(double z) {
  // From a table, as it is needed at every pixel in every iteration; linear interpolation, to 2e-5.
  constexpr double kReach = 5, kPerUnit = 64;
  constexpr int kEntries = static_cast<int>(2 * kReach * kPerUnit) + 2;
  static const std::array<Step, kEntries> table = [] {
    std::array<Step, kEntries> steps;
    for (int i = 0; i < kEntries; ++i) {
      const double at = i / kPerUnit - kReach;
      steps[i] = {std::erf(at * M_SQRT1_2),
                  std::sqrt(2 / std::numbers::pi) * std::exp(-0.5 * at * at)};
    }
    return steps;
  }();
  if (!(std::abs(z) < kReach)) return {z < 0 ? -1.0 : 1.0, 0};
  const double at = (z + kReach) * kPerUnit;
  const int index = static_cast<int>(at);
  const double share = at - index;
  const Step &low = table[index], &high = table[index + 1];
  return {low.value + share * (high.value - low.value),
          low.slope + share * (high.slope - low.slope)};
}

double error_and_jacobian(const Parameters& x, const SidePixel& pixel, Parameters& J) {
  const double u = pixel.along, centred = u - 0.5;
  const double distance = pixel.outside_px - (x[kOffsetStart] * (1 - u) + x[kOffsetEnd] * u);
  const double z = distance / x[kBlur];
  const Step step = step_at(z);
  const double half = x[kHalf] + x[kHalfSlope] * centred;
  double by_distance = half * step.slope / x[kBlur];
  double by_blur = -half * step.slope * z / x[kBlur];
  double value = x[kMean] + x[kMeanSlope] * centred + half * step.value;
  J[kOffsetStart] = -by_distance * (1 - u);
  J[kOffsetEnd] = -by_distance * u;
  J[kMean] = 1;
  J[kMeanSlope] = centred;
  J[kHalf] = step.value;
  J[kHalfSlope] = step.value * centred;
  J[kBlur] = by_blur;
  return pixel.grey - value;
}

/// Levenberg-Marquardt from `x`; false if there is no step.
bool fit_side(const std::vector<SidePixel>& pixels, const Band& band, double min_contrast,
              Parameters& x, Side& side) {
  const int n = static_cast<int>(pixels.size());
  if (n < 3 * kParameters || 2 * x[kHalf] < min_contrast) return false;
  const auto evaluate = [&](const Parameters& at, Normal& H, Parameters& g) {
    double cost = 0;
    Parameters J;
    H.setZero();
    g.setZero();
    for (const SidePixel& pixel : pixels) {
      const double r = error_and_jacobian(at, pixel, J);
      H.noalias() += J * J.transpose();
      g += r * J;
      cost += r * r;
    }
    return cost;
  };
  Normal H, H_next;
  Parameters g, g_next;
  double cost = evaluate(x, H, g), damping = 1e-3;
  // Iterations at most, and bounds of the blur. Chosen.
  constexpr int kIterations = 12;
  constexpr double kLeastBlur_px = 0.2, kMostBlur_px = 4;
  for (int i = 0; i < kIterations && damping < 1e6; ++i) {
    Normal damped = H;
    damped.diagonal() *= 1 + damping;
    damped.diagonal().array() += 1e-9;
    const Parameters step = damped.ldlt().solve(g);
    Parameters next = x + step;
    next[kBlur] = std::clamp(next[kBlur], kLeastBlur_px, kMostBlur_px);
    const double next_cost = evaluate(next, H_next, g_next);
    const bool still = step.head<2>().cwiseAbs().maxCoeff() < 3e-3;
    if (!(next_cost < cost)) {
      if (still) break;
      damping *= 10;
      continue;
    }
    x = next;
    H = H_next;
    g = g_next;
    cost = next_cost;
    damping *= 0.1;
    if (still) break;
  }
  side.offset = x.head<2>();
  side.contrast = 2 * x[kHalf];
  // The error of a grey value is at least its rounding.
  const double variance = std::max(1.0 / 12, cost / (n - kParameters));
  side.covariance = variance * (H + 1e-9 * Normal::Identity()).inverse().topLeftCorner<2, 2>();
  return side.offset.allFinite() && side.covariance.allFinite() && side.contrast >= min_contrast &&
         side.offset.cwiseAbs().maxCoeff() < std::max(band.inside_px, band.outside_px);
}

std::optional<Vector2d> intersection(const Vector2d& a, const Vector2d& b, const Vector2d& c,
                                     const Vector2d& d) {
  Matrix2d directions;
  directions << b - a, c - d;
  if (std::abs(directions.determinant()) < 1e-9) return std::nullopt;
  const Vector2d share = directions.inverse() * (c - a);
  return Vector2d(a + share[0] * (b - a));
}

/// Intersections of the fitted sides, with their covariance.
bool join(const std::array<Side, 4>& sides, SquareFit& fit) {
  Eigen::Matrix<double, 8, 8> J = Eigen::Matrix<double, 8, 8>::Zero(), offsets = J;
  for (int i = 0; i < 4; ++i) {
    const Side& before = sides[(i + 3) % 4];
    const Side& after = sides[i];
    offsets.block<2, 2>(2 * i, 2 * i) = after.covariance;
    const auto corner = intersection(before.start + before.offset[0] * before.outwards,
                                     before.end + before.offset[1] * before.outwards,
                                     after.start + after.offset[0] * after.outwards,
                                     after.end + after.offset[1] * after.outwards);
    if (!corner) return false;
    fit.corners_px[i] = *corner;
    // The two sides move outwards by their offsets at the corner.
    Matrix2d normals;
    normals << before.outwards.transpose(), after.outwards.transpose();
    const Matrix2d moved = normals.inverse();
    const auto share = [&](const Side& side) {
      const Vector2d extent = side.end - side.start;
      return (*corner - side.start).dot(extent) / extent.squaredNorm();
    };
    const double u_before = share(before), u_after = share(after);
    const int at_before = 2 * ((i + 3) % 4), at_after = 2 * i;
    J.block<2, 1>(2 * i, at_before) = moved.col(0) * (1 - u_before);
    J.block<2, 1>(2 * i, at_before + 1) = moved.col(0) * u_before;
    J.block<2, 1>(2 * i, at_after) = moved.col(1) * (1 - u_after);
    J.block<2, 1>(2 * i, at_after + 1) = moved.col(1) * u_after;
  }
  fit.covariance = J * offsets * J.transpose();
  return fit.covariance.allFinite();
}

/// One pass: fits the sides around the corners in `fit` and updates these corners.
bool fit_once(const StraightPixels& pixels, double border_share, const SquareFitOptions& options,
              bool first, std::array<Parameters, 4>& parameters, SquareFit& fit) {
  const SquareCorners corners = fit.corners_px;
  const Vector2d middle = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
  std::array<Side, 4> sides;
  fit.contrast = 255;
  for (int i = 0; i < 4; ++i) {
    Side& side = sides[i];
    side.start = corners[i];
    side.end = corners[(i + 1) % 4];
    const Vector2d extent = side.end - side.start;
    const double length = extent.norm();
    if (length < 4) return false;
    side.outwards = Vector2d(extent.y(), -extent.x()) / length;
    if (side.outwards.dot(side.start - middle) < 0) side.outwards = -side.outwards;
    const Vector2d before = corners[(i + 3) % 4] - side.start;
    const Vector2d after = corners[(i + 2) % 4] - side.end;
    // The width of the border is that at the nearer of the two ends.
    Band band;
    band.border_px = border_share * std::min(std::abs(before.dot(side.outwards)),
                                             std::abs(after.dot(side.outwards)));
    // First located, then measured from nearby pixels only: the cells next to the border affect the
    // fit if the border is hardly wider than the blur.
    constexpr double kFound_px = 2.5, kLeast_px = 1.5;
    band.inside_px = first ? std::clamp(band.border_px, kFound_px, options.reach_px)
                           : std::clamp(0.5 * band.border_px, kLeast_px, options.reach_px);
    band.outside_px = band.inside_px;
    // Margin at a corner, and its largest share of a side. Chosen.
    constexpr double kCorner_px = 1.5, kMostMargin = 0.3;
    band.start_margin =
        std::min(kMostMargin, (kCorner_px + band.inside_px * cotangent(before, extent)) / length);
    band.end_margin =
        std::min(kMostMargin, (kCorner_px + band.inside_px * cotangent(after, extent)) / length);
    const std::vector<SidePixel> beside = pixels_of(pixels, side, band, first ? 80 : 400);
    Parameters& x = parameters[i];
    if (x[kBlur] == 0) x = start_of(beside, band);
    x[kOffsetStart] = x[kOffsetEnd] = 0;
    if (!fit_side(beside, band, options.min_contrast, x, side)) return false;
    fit.contrast = std::min(fit.contrast, side.contrast);
  }
  return join(sides, fit);
}

}  // namespace

std::optional<SquareFit> fit_square(const Image& grey, const SquareCorners& expected_px,
                                    double border_share, const SquareFitOptions& options,
                                    const Camera* lens) {
  options.check();
  require(!grey.empty() && grey.type() == CV_8UC1, "fit_square: grey image needed");
  const StraightPixels pixels(grey, lens);
  SquareFit fit;
  for (int i = 0; i < 4; ++i) {
    const auto straight = pixels.straight(expected_px[i]);
    if (!straight || !straight->allFinite()) return std::nullopt;
    fit.corners_px[i] = *straight;
  }
  std::array<Parameters, 4> parameters;
  parameters.fill(Parameters::Zero());
  // Rounds at most. Chosen.
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    const SquareCorners before = fit.corners_px;
    if (!fit_once(pixels, border_share, options, round == 0, parameters, fit)) return std::nullopt;
    double moved = 0;
    for (int i = 0; i < 4; ++i) moved = std::max(moved, (fit.corners_px[i] - before[i]).norm());
    if (moved > 2 * options.reach_px) return std::nullopt;
    if (round > 0 && moved < 0.1) break;
  }
  Eigen::Matrix<double, 8, 8> J = Eigen::Matrix<double, 8, 8>::Zero();
  for (int i = 0; i < 4; ++i) {
    Matrix2d J_corner;
    const auto px = pixels.image(fit.corners_px[i], J_corner);
    if (!px) return std::nullopt;
    fit.corners_px[i] = *px;
    J.block<2, 2>(2 * i, 2 * i) = J_corner;
  }
  fit.covariance = J * fit.covariance * J.transpose();
  if (!(fit.covariance.diagonal().maxCoeff() < options.max_sigma_px * options.max_sigma_px))
    return std::nullopt;
  fit.covariance.diagonal().array() += options.min_sigma_px * options.min_sigma_px;
  return fit;
}

}  // namespace placegraph
