#include <placegraph/frontend/planes/ground_plane.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// One level of the two pyramids with the camera that belongs to it.
struct Level {
  Image ref, cur;  // CV_8UC1
  Camera camera;
};

/// A pixel of the road in the reference image.
struct Sample {
  Vector3d ray_ref;  // z = 1
  double grey_ref;
};

std::vector<Level> build_levels(const Image& image_ref, const Image& image_cur,
                                const Camera& camera, int count) {
  std::vector<Level> levels{{image_ref, image_cur, camera}};
  for (int i = 1; i < count; ++i) {
    Level level = levels.back();
    cv::pyrDown(levels.back().ref, level.ref);
    cv::pyrDown(levels.back().cur, level.cur);
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
      const double depth_heights = 1 / plane.normal.dot(ray);  // of the ray's plane point
      if (!(depth_heights > o.near_heights && depth_heights < o.far_heights)) continue;
      if (std::abs(ray.x() * depth_heights) > o.half_width_heights) continue;
      samples.push_back({ray, static_cast<double>(level.ref.at<unsigned char>(v, u))});
    }
  }
  return samples;
}

/// The pixel of a sample in the current image for g = n/d, and the derivative by g.
bool warp(const Level& level, const Matrix3d& R, const Vector3d& t, const Vector3d& g,
          const Sample& sample, Vector2d& px, Eigen::Matrix<double, 2, 3>* J_px_g) {
  const Camera& c = level.camera;
  const Vector3d X = R * sample.ray_ref + t * g.dot(sample.ray_ref);
  if (X.z() < 1e-3) return false;
  px = {c.fx * X.x() / X.z() + c.cx, c.fy * X.y() / X.z() + c.cy};
  if (!(px[0] >= 1 && px[1] >= 1 && px[0] < c.width - 2 && px[1] < c.height - 2)) return false;
  if (J_px_g) {
    const Vector2d d((c.fx * t.x() - (px[0] - c.cx) * t.z()) / X.z(),
                     (c.fy * t.y() - (px[1] - c.cy) * t.z()) / X.z());
    *J_px_g = d * sample.ray_ref.transpose();
  }
  return true;
}

double zncc(const Level& level, const Matrix3d& R, const Vector3d& t, const Vector3d& g,
            const std::vector<Sample>& samples, int* seen) {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  Vector2d px;
  for (const Sample& sample : samples) {
    if (!warp(level, R, t, g, sample, px, nullptr)) continue;
    const double x = sample.grey_ref, y = sample_grey(level.cur, px[0], px[1]).value;
    n += 1, a += x, b += y, aa += x * x, bb += y * y, ab += x * y;
  }
  if (seen) *seen = static_cast<int>(n);
  if (n < 2) return 0;
  const double va = aa - a * a / n, vb = bb - b * b / n;
  return va > 0 && vb > 0 ? (ab - a * b / n) / std::sqrt(va * vb) : 0;
}

double median_of(std::vector<double>& values) {
  auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

/// What Gauss-Newton at one level works on and leaves behind.
struct Fit {
  Vector3d g;  // n/d
  double gain = 1, bias = 0;
  Matrix5d normal = Matrix5d::Zero();  // whitened by the residuals' spread, prior included
  int seen = 0;
};

/// Adds the prior on the direction of g: pitch and roll about n0.
void add_prior(const Vector3d& n0, double sigma_rad, const Vector3d& g, Matrix5d& H, Vector5d& b) {
  const double length = g.norm();
  const Vector3d n = g / length;
  const Vector3d e1 = n0.unitOrthogonal(), e2 = n0.cross(e1);
  Eigen::Matrix<double, 2, 3> basis;
  basis << e1.transpose(), e2.transpose();
  const Vector2d r = basis * n / sigma_rad;
  const Eigen::Matrix<double, 2, 3> J =
      basis * (Matrix3d::Identity() - n * n.transpose()) / (length * sigma_rad);
  H.topLeftCorner<3, 3>() += J.transpose() * J;
  b.head<3>() -= J.transpose() * r;
}

void align_level(const Level& level, const Matrix3d& R, const Vector3d& t,
                 const std::vector<Sample>& samples, const Vector3d& n0,
                 const GroundPlaneOptions& o, Fit& fit) {
  const double prior_sigma_rad = o.prior_sigma_deg * M_PI / 180;
  std::vector<double> residuals(samples.size()), magnitudes;
  std::vector<Vector5d> jacobians(samples.size());
  for (int iteration = 0; iteration < o.iterations; ++iteration) {
    magnitudes.clear();
    fit.seen = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      Vector2d px;
      Eigen::Matrix<double, 2, 3> J_px_g;
      residuals[i] = std::numeric_limits<double>::quiet_NaN();
      if (!warp(level, R, t, fit.g, samples[i], px, &J_px_g)) continue;
      const Grey grey = sample_grey(level.cur, px[0], px[1]);
      residuals[i] = grey.value - fit.gain * samples[i].grey_ref - fit.bias;
      jacobians[i] << (grey.du * J_px_g.row(0) + grey.dv * J_px_g.row(1)).transpose(),
          -samples[i].grey_ref, -1;
      magnitudes.push_back(std::abs(residuals[i]));
      ++fit.seen;
    }
    if (fit.seen < 50) return;
    const double sigma = std::max(1.0, 1.4826 * median_of(magnitudes));
    const double cut = 4.685 * sigma;
    Matrix5d H = Matrix5d::Zero();
    Vector5d b = Vector5d::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!(std::abs(residuals[i]) < cut)) continue;
      const double q = 1 - residuals[i] * residuals[i] / (cut * cut);
      const double weight = q * q * o.pixel_correlation / (sigma * sigma);
      H.noalias() += weight * jacobians[i] * jacobians[i].transpose();
      b.noalias() -= weight * residuals[i] * jacobians[i];
    }
    add_prior(n0, prior_sigma_rad, fit.g, H, b);
    fit.normal = H;
    const Vector5d step = H.ldlt().solve(b);
    if (!step.allFinite()) return;
    // No step may move the plane by more than a fifth of its distance.
    const double limit = 0.2 * fit.g.norm();
    const double length = step.head<3>().norm();
    fit.g += step.head<3>() * std::min(1.0, limit / std::max(length, 1e-12));
    fit.gain += step[3];
    fit.bias += step[4];
    if (length < 1e-5 * fit.g.norm()) break;
  }
}

}  // namespace

void GroundPlaneOptions::check() const {
  check_ranges(*this);
  require(near_heights < far_heights, "ground_plane: near_heights must be below far_heights");
}

void visit(OptionVisitor& field, GroundPlaneOptions& o) {
  field("near_heights", o.near_heights, "nearest road looked at, in camera heights", {0.5, 100});
  field("far_heights", o.far_heights, "farthest road looked at, in camera heights", {1, 200});
  field("half_width_heights", o.half_width_heights,
        "half the width of the road looked at, in camera heights", {0.2, 50});
  field("step_px", o.step_px, "grid of samples", {1, 32});
  field("pyramid_levels", o.pyramid_levels, "levels, coarse to fine", {1, 6});
  field("iterations", o.iterations, "Gauss-Newton steps per level", {1, 100});
  field("prior_sigma_deg", o.prior_sigma_deg,
        "pitch and roll of the plane vary this much about the prior", {0.01, 45});
  field("pixel_correlation", o.pixel_correlation,
        "share of the samples that counts as independent, for the covariance", {0.001, 1});
  field("min_zncc", o.min_zncc, "agreement below which nothing is said", {-1, 1});
  field("min_samples", o.min_samples, "fewest samples seen in both images", {50, 1000000});
}

GroundPlaneResult align_ground_plane(const Image& image_ref, const Image& image_cur,
                                     const Camera& camera, const SE3& T_cur_ref,
                                     const Plane& prior_ref, const GroundPlaneOptions& options) {
  require(image_ref.type() == CV_8UC1 && image_ref.size() == image_cur.size(),
          "align_ground_plane: two grey images of one size needed");
  require(prior_ref.distance_m > 0, "align_ground_plane: the prior's distance must be positive");
  const auto levels = build_levels(image_ref, image_cur, camera, options.pyramid_levels);
  const Matrix3d R = T_cur_ref.rotation().matrix();
  const Vector3d& t = T_cur_ref.translation();

  GroundPlaneResult result;
  Fit fit;
  fit.g = prior_ref.normal / prior_ref.distance_m;
  std::vector<Sample> samples;
  for (int i = static_cast<int>(levels.size()) - 1; i >= 0; --i) {
    // As many samples on every level, or the coarse ones would have too few to hold the fit.
    samples = collect_samples(levels[i], prior_ref, options, i == 0 ? options.step_px : 1);
    align_level(levels[i], R, t, samples, prior_ref.normal, options, fit);
  }
  result.samples = fit.seen;
  if (fit.seen < options.min_samples || !fit.g.allFinite()) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      std::to_string(fit.seen) + " road pixels in both views");
    return result;
  }
  const double length = fit.g.norm();
  result.plane_ref = {fit.g / length, 1 / length};
  result.zncc = zncc(levels[0], R, t, fit.g, samples, nullptr);
  const Matrix5d covariance = fit.normal.ldlt().solve(Matrix5d::Identity());
  const Vector3d n = result.plane_ref.normal;
  const double variance = n.dot(covariance.topLeftCorner<3, 3>() * n) / (length * length);
  result.sigma_log_distance = std::sqrt(std::max(0.0, variance));
  if (!(result.sigma_log_distance < 0.5)) {
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate, "the road shows too little");
  } else if (result.zncc < options.min_zncc) {
    result.outcome =
        Outcome::failure(Outcome::Code::kInconsistent, "ZNCC " + std::to_string(result.zncc));
  } else {
    result.outcome = Outcome::ok();
  }
  return result;
}

GroundPlaneResult search_ground_plane(const Image& image_ref, const Image& image_cur,
                                      const Camera& camera, const SE3& T_cur_ref,
                                      const Vector3d& level_ref,
                                      const GroundPlaneOptions& options) {
  const double step_length = T_cur_ref.translation().norm();
  GroundPlaneResult failure;
  if (!(step_length > 0)) {
    failure.outcome = Outcome::failure(Outcome::Code::kDegenerate, "no translation");
    return failure;
  }
  const auto levels = build_levels(image_ref, image_cur, camera, 3);
  const Level& level = levels[1];
  const Matrix3d R = T_cur_ref.rotation().matrix();
  const Vector3d& t = T_cur_ref.translation();
  const Vector3d n0 = level_ref.normalized();
  const Vector3d right = Vector3d::UnitX();

  double best = -1;
  Plane best_plane;
  for (int tick = -8; tick <= 8; ++tick) {
    const double pitch_rad = tick * 0.5 * M_PI / 180;
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
  return align_ground_plane(image_ref, image_cur, camera, T_cur_ref, best_plane, options);
}

}  // namespace placegraph
