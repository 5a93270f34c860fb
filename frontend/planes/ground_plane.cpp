#include <placegraph/frontend/planes/ground_plane.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Distance of neighbouring samples in the reference image. Chosen.
constexpr int kGroundStep_px = 3;
/// Levels of the image pyramid, coarse to fine. Chosen.
constexpr int kGroundLevels = 3;
/// Maximum number of Gauss-Newton iterations per level. Chosen.
constexpr int kGroundIterations = 12;
/// Share of the samples that counts as independent, for the covariance: neighbours are correlated.
/// Chosen.
constexpr double kIndependentShare = 0.1;
/// Minimum correlation of the aligned samples; there is no result below it. Chosen.
constexpr double kMinGroundZncc = 0.5;
/// Minimum number of samples seen in both images. Chosen.
constexpr int kMinGroundSamples = 400;

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// One level of the two pyramids with its camera.
struct Level {
  Image ref, cur;  // CV_8UC1
  Image mask;      // mask of ref, 0 = not the ground; empty: all pixels may be ground
  Camera camera;
};

/// Pixel of the road in the reference image.
struct Sample {
  Vector3d ray_ref;  // z = 1
  double grey_ref;
};

std::vector<Level> build_levels(const Image& image_ref, const Image& image_cur,
                                const Image& mask_ref, const Camera& camera, int count) {
  require(mask_ref.empty() || (mask_ref.type() == CV_8UC1 && mask_ref.size() == image_ref.size()),
          "ground_plane: needs a mask of the image's size");
  std::vector<Level> levels{{image_ref, image_cur, mask_ref, camera}};
  for (int i = 1; i < count; ++i) {
    Level level = levels.back();
    cv::pyrDown(levels.back().ref, level.ref);
    cv::pyrDown(levels.back().cur, level.cur);
    if (!mask_ref.empty())
      cv::resize(levels.back().mask, level.mask, level.ref.size(), 0, 0, cv::INTER_NEAREST);
    level.camera.width = level.ref.cols;
    level.camera.height = level.ref.rows;
    for (double* value : {&level.camera.fx, &level.camera.fy, &level.camera.cx, &level.camera.cy})
      *value /= 2;  // pyrDown keeps the even pixels
    levels.push_back(level);
  }
  return levels;
}

struct Grey {
  double value, du, dv;
};

/// Bilinear value and its exact gradient; the caller keeps a border of one pixel.
Grey sample_grey(const Image& image, double u, double v) {
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  const double a = u - u0, b = v - v0;
  const unsigned char* top = image.ptr(v0) + u0;
  const unsigned char* bottom = image.ptr(v0 + 1) + u0;
  const double left = top[0] + b * (bottom[0] - top[0]);
  const double right = top[1] + b * (bottom[1] - top[1]);
  const double upper = top[0] + a * (top[1] - top[0]);
  const double lower = bottom[0] + a * (bottom[1] - bottom[0]);
  return {left + a * (right - left), right - left, lower - upper};
}

std::vector<Sample> collect_samples(const Level& level, const Plane& plane,
                                    const GroundPlaneOptions& o, int step) {
  std::vector<Sample> samples;
  const Camera& c = level.camera;
  for (int v = step; v < c.height - 1; v += step) {
    for (int u = step; u < c.width - 1; u += step) {
      const Vector3d ray((u - c.cx) / c.fx, (v - c.cy) / c.fy, 1);
      // Depth of the ray's point on the plane.
      const double depth_heights = 1 / plane.normal.dot(ray);
      if (!(depth_heights > o.near_heights && depth_heights < o.far_heights)) continue;
      if (std::abs(ray.x() * depth_heights) > o.half_width_heights) continue;
      if (!level.mask.empty() && !level.mask.at<unsigned char>(v, u)) continue;
      samples.push_back({ray, static_cast<double>(level.ref.at<unsigned char>(v, u))});
    }
  }
  return samples;
}

/// Keeps every n-th, about `most` in all: enough for an approximation that a finer level refines.
std::vector<Sample> thinned(std::vector<Sample> samples, std::size_t most = 1500) {
  const std::size_t stride = samples.size() / most + 1;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < samples.size(); i += stride) samples[kept++] = samples[i];
  samples.resize(kept, {Vector3d::Zero(), 0});
  return samples;
}

/// The pixel of a sample in the current image for g = n/d; X is its point, scaled by 1 / depth.
bool warp(const Level& level, const Matrix3d& R, const Vector3d& t, const Vector3d& g,
          const Sample& sample, Vector2d& px, Vector3d& X) {
  const Camera& c = level.camera;
  X = R * sample.ray_ref + t * g.dot(sample.ray_ref);
  if (X.z() < 1e-3) return false;
  px = {c.fx * X.x() / X.z() + c.cx, c.fy * X.y() / X.z() + c.cy};
  return px[0] >= 1 && px[1] >= 1 && px[0] < c.width - 2 && px[1] < c.height - 2;
}

double zncc(const Level& level, const Matrix3d& R, const Vector3d& t, const Vector3d& g,
            const std::vector<Sample>& samples, int* seen) {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  Vector2d px;
  Vector3d X;
  for (const Sample& sample : samples) {
    if (!warp(level, R, t, g, sample, px, X)) continue;
    const double x = sample.grey_ref, y = sample_grey(level.cur, px[0], px[1]).value;
    n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  if (seen) *seen = static_cast<int>(n);
  if (n < 2) return 0;
  const double va = aa - a * a / n, vb = bb - b * b / n;
  return va > 0 && vb > 0 ? (ab - a * b / n) / std::sqrt(va * vb) : 0;
}

/// g = n/d (3), rotation omega (3): R = exp(omega) R_start, direction of the translation (2):
/// t = t_start + |t_start| B u with B across it, gain, bias.
constexpr int kParameters = 10;
using Parameters = Eigen::Matrix<double, kParameters, 1>;
using ParameterMatrix = Eigen::Matrix<double, kParameters, kParameters>;

/// Motion with the directions in which it is corrected.
struct Motion {
  Matrix3d R;
  Vector3d t;
  Eigen::Matrix<double, 3, 2> across;  // B |t_start|
  Vector3d omega = Vector3d::Zero();   // correction so far, for the prior
  Vector2d u = Vector2d::Zero();

  explicit Motion(const SE3& T_cur_ref)
      : R(T_cur_ref.rotation().matrix()), t(T_cur_ref.translation()) {
    const double length = std::max(t.norm(), 1e-12);
    const Vector3d direction = t / length, e = direction.unitOrthogonal();
    across << length * e, length * direction.cross(e);
  }
  void correct(const Vector3d& d_omega, const Vector2d& d_u) {
    R = SO3::exp(d_omega).matrix() * R;
    t += across * d_u;
    omega += d_omega;
    u += d_u;
  }
};

/// State and result of Gauss-Newton at one level.
struct Fit {
  Vector3d g;  // n/d
  double gain = 1, bias = 0;
  // Whitened by the residuals' dispersion, prior included.
  ParameterMatrix normal = ParameterMatrix::Zero();
  int seen = 0;
};

/// Adds the priors: pitch and roll of g about the prior's normal, and the motion about its start.
void add_priors(const GroundPlanePrior& prior, const Vector3d& g, const Motion& motion,
                ParameterMatrix& H, Parameters& b) {
  const Vector3d& n0 = prior.plane_ref.normal;
  const double length = g.norm();
  const Vector3d n = g / length;
  const Vector3d e1 = n0.unitOrthogonal(), e2 = n0.cross(e1);
  Eigen::Matrix<double, 2, 3> basis;
  basis << e1.transpose(), e2.transpose();
  const Vector2d r = basis * n / prior.sigma_normal_rad;
  const Eigen::Matrix<double, 2, 3> J =
      basis * (Matrix3d::Identity() - n * n.transpose()) / (length * prior.sigma_normal_rad);
  H.topLeftCorner<3, 3>() += J.transpose() * J;
  b.head<3>() -= J.transpose() * r;

  const double w_rotation = 1 / (prior.sigma_rotation_rad * prior.sigma_rotation_rad);
  const double w_direction = 1 / (prior.sigma_direction_rad * prior.sigma_direction_rad);
  H.diagonal().segment<3>(3).array() += w_rotation;
  b.segment<3>(3) -= w_rotation * motion.omega;
  H.diagonal().segment<2>(6).array() += w_direction;
  b.segment<2>(6) -= w_direction * motion.u;
}

/// Residual of one sample and its derivative; false if it is out of view.
bool linearize(const Level& level, const Motion& motion, const Fit& fit, const Sample& sample,
               double& residual, Parameters& J) {
  Vector2d px;
  Vector3d X;
  if (!warp(level, motion.R, motion.t, fit.g, sample, px, X)) return false;
  const Grey grey = sample_grey(level.cur, px[0], px[1]);
  residual = grey.value - fit.gain * sample.grey_ref - fit.bias;
  const Camera& c = level.camera;
  const double a = grey.du * c.fx / X.z(), b = grey.dv * c.fy / X.z();
  const Vector3d by_X(a, b, -(a * X.x() + b * X.y()) / X.z());
  const double inverse_depth = fit.g.dot(sample.ray_ref);
  const Vector3d rotated = X - motion.t * inverse_depth;
  J << by_X.dot(motion.t) * sample.ray_ref, rotated.cross(by_X),
      inverse_depth * (motion.across.transpose() * by_X), -sample.grey_ref, -1;
  return true;
}

void align_level(const Level& level, const std::vector<Sample>& samples,
                 const GroundPlanePrior& prior, Motion& motion, Fit& fit) {
  std::vector<double> residuals(samples.size()), magnitudes;
  std::vector<Parameters> jacobians(samples.size());
  constexpr double kMoved = 5e-4;  // share of the distance: a twentieth of the flatness of a road
  for (int iteration = 0; iteration < kGroundIterations; ++iteration) {
    magnitudes.clear();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (linearize(level, motion, fit, samples[i], residuals[i], jacobians[i]))
        magnitudes.push_back(std::abs(residuals[i]));
      else
        residuals[i] = std::numeric_limits<double>::quiet_NaN();
    }
    fit.seen = static_cast<int>(magnitudes.size());
    if (fit.seen < 50) return;
    const double sigma = std::max(1.0, 1.4826 * median_of(magnitudes));
    const double cut = 4.685 * sigma;
    ParameterMatrix H = ParameterMatrix::Zero();
    Parameters b = Parameters::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!(std::abs(residuals[i]) < cut)) continue;
      const double q = 1 - residuals[i] * residuals[i] / (cut * cut);
      const double weight = q * q * kIndependentShare / (sigma * sigma);
      H.selfadjointView<Eigen::Lower>().rankUpdate(jacobians[i], weight);
      b.noalias() -= weight * residuals[i] * jacobians[i];
    }
    H.triangularView<Eigen::StrictlyUpper>() = H.transpose();
    add_priors(prior, fit.g, motion, H, b);
    fit.normal = H;
    Parameters step = H.ldlt().solve(b);
    if (!step.allFinite()) return;
    // Each step moves the plane by at most a fifth of its distance.
    const double moved = step.head<3>().norm() / fit.g.norm();
    if (moved > 0.2) step *= 0.2 / moved;
    fit.g += step.head<3>();
    motion.correct(step.segment<3>(3), step.segment<2>(6));
    fit.gain += step[8];
    fit.bias += step[9];
    if (moved < kMoved) break;
  }
}

/// Distance at which the road matches best, within a factor of the prior's. Gauss-Newton alone
/// converges to the nearest local minimum of a fine texture.
double start_distance(const Level& level, const Matrix3d& R, const Vector3d& t, const Plane& prior,
                      const GroundPlaneOptions& o) {
  const auto samples = thinned(collect_samples(level, prior, o, 2));
  double best = -1, best_distance = prior.distance_m;
  for (double factor = 0.7; factor < 1.4; factor *= 1.02) {
    const double distance = factor * prior.distance_m;
    int seen = 0;
    const double score = zncc(level, R, t, prior.normal / distance, samples, &seen);
    if (seen < static_cast<int>(samples.size()) / 3 || score <= best) continue;
    best = score;
    best_distance = distance;
  }
  return best_distance;
}

}  // namespace

GroundPlaneResult align_ground_plane(const Image& image_ref, const Image& image_cur,
                                     const Camera& camera, const SE3& T_cur_ref,
                                     const GroundPlanePrior& prior,
                                     const GroundPlaneOptions& options, const Image& mask_ref) {
  const Plane& prior_ref = prior.plane_ref;
  require(image_ref.type() == CV_8UC1 && image_ref.size() == image_cur.size(),
          "align_ground_plane: needs two grey images of one size");
  require(prior_ref.distance_m > 0, "align_ground_plane: the prior's distance must be positive");
  const auto levels = build_levels(image_ref, image_cur, mask_ref, camera, kGroundLevels);
  const Matrix3d R = T_cur_ref.rotation().matrix();
  const Vector3d& t = T_cur_ref.translation();

  GroundPlaneResult result;
  if (!(t.norm() > 0)) {
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate, "no translation");
    return result;
  }
  Motion motion(T_cur_ref);
  Fit fit;
  fit.g = prior_ref.normal / start_distance(levels[std::min<std::size_t>(1, levels.size() - 1)], R,
                                            t, prior_ref, options);
  std::vector<Sample> samples;
  for (int i = static_cast<int>(levels.size()) - 1; i >= 0; --i) {
    // The step follows the pixel size, so that all levels have the same number of samples.
    const int step = std::max(1, (kGroundStep_px + (1 << i) - 1) >> i);
    samples = collect_samples(levels[i], prior_ref, options, step);
    if (i > 0) samples = thinned(std::move(samples));
    align_level(levels[i], samples, prior, motion, fit);
  }
  result.samples = fit.seen;
  if (fit.seen < kMinGroundSamples || !fit.g.allFinite()) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      std::to_string(fit.seen) + " road pixels in both views");
    return result;
  }
  const double length = fit.g.norm();
  // In the scale of the given translation, whose direction has been corrected.
  const double stretch = motion.t.norm() / T_cur_ref.translation().norm();
  result.plane_ref = {fit.g / length, 1 / (length * stretch)};
  result.T_cur_ref = SE3(motion.R, motion.t / stretch);
  result.zncc = zncc(levels[0], motion.R, motion.t, fit.g, samples, nullptr);
  const ParameterMatrix covariance = fit.normal.ldlt().solve(ParameterMatrix::Identity());
  const Vector3d n = result.plane_ref.normal;
  const double variance = n.dot(covariance.topLeftCorner<3, 3>() * n) / (length * length);
  result.sigma_log_distance = std::sqrt(std::max(0.0, variance));
  const Vector3d e1 = n.unitOrthogonal(), e2 = n.cross(e1);
  for (const Vector3d& e : {e1, e2})
    result.sigma_normal_rad =
        std::max(result.sigma_normal_rad,
                 std::sqrt(std::max(0.0, e.dot(covariance.topLeftCorner<3, 3>() * e))) / length);
  if (!(result.sigma_log_distance < 0.5)) {
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate, "the distance is too uncertain");
  } else if (result.zncc < kMinGroundZncc) {
    result.outcome =
        Outcome::failure(Outcome::Code::kInconsistent, "ZNCC " + std::to_string(result.zncc));
  } else {
    result.outcome = Outcome::ok();
  }
  return result;
}

GroundPlaneResult search_ground_plane(const Image& image_ref, const Image& image_cur,
                                      const Camera& camera, const SE3& T_cur_ref,
                                      const Vector3d& level_ref, const GroundPlaneOptions& options,
                                      const Image& mask_ref) {
  const double step_length = T_cur_ref.translation().norm();
  GroundPlaneResult failure;
  if (!(step_length > 0)) {
    failure.outcome = Outcome::failure(Outcome::Code::kDegenerate, "no translation");
    return failure;
  }
  const auto levels = build_levels(image_ref, image_cur, mask_ref, camera, 3);
  const Level& level = levels[1];
  const Matrix3d R = T_cur_ref.rotation().matrix();
  const Vector3d& t = T_cur_ref.translation();
  const Vector3d n0 = level_ref.normalized();
  const Vector3d right = Vector3d::UnitX();

  double best = -1;
  Plane best_plane;
  for (int tick = -8; tick <= 8; ++tick) {
    const double pitch_rad = deg_to_rad(tick * 0.5);
    const Plane candidate{SO3::exp(right * pitch_rad) * n0, 1};
    const auto samples = collect_samples(level, candidate, options, 3);
    for (double distance = 0.02 * step_length; distance < 50 * step_length; distance *= 1.03) {
      int seen = 0;
      const double score = zncc(level, R, t, candidate.normal / distance, samples, &seen);
      if (seen < static_cast<int>(samples.size()) / 3 || seen < 60 || score <= best) continue;
      best = score;
      best_plane = {candidate.normal, distance};
    }
  }
  if (best < 0) {
    failure.outcome = Outcome::failure(Outcome::Code::kTooFewData, "no road in view");
    return failure;
  }
  // The pitch is known to the step of the search, the roll is unknown.
  constexpr double kSigmaRad = deg_to_rad(1.5);
  return align_ground_plane(image_ref, image_cur, camera, T_cur_ref, {best_plane, kSigmaRad},
                            options, mask_ref);
}

}  // namespace placegraph
