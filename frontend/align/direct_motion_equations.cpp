#include <placegraph/frontend/align/direct_motion_equations.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

namespace placegraph {
namespace {

/// Width of Tukey's weights: 95 % efficiency for normal residuals (Holland & Welsch 1977).
constexpr double kDirectTukeyWidth = 4.685;

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Sample = DirectReference::Sample;

/// Prior standard deviations of gain and bias, least of a grey value [grey].
constexpr double kSigmaGain = 0.3, kSigmaBias = 30, kLeastSigmaGrey = 1.5;

/// A camera whose pixels are those of a level.
struct LevelCamera {
  double fx, fy, cx, cy;
  LevelCamera(const Camera& c, int level) {
    const double scale = std::ldexp(1.0, -level);
    fx = scale * c.fx, fy = scale * c.fy, cx = scale * c.cx, cy = scale * c.cy;
  }
  std::optional<Vector2d> project(const Vector3d& X, const Image& image) const {
    if (!(X.z() > 1e-3)) return std::nullopt;
    const Vector2d px(fx * X.x() / X.z() + cx, fy * X.y() / X.z() + cy);
    if (!inside_bicubic(image, px.x(), px.y())) return std::nullopt;
    return px;
  }
  /// Derivative of a grey value with respect to the point X at its pixel.
  Vector3d by_point(const Vector2d& gradient, const Vector3d& X) const {
    const double a = gradient.x() * fx / X.z(), b = gradient.y() * fy / X.z();
    return {a, b, -(a * X.x() + b * X.y()) / X.z()};
  }
};

Matrix3d information_of(const Matrix3d& covariance) {
  // A plane with zero covariance gets a standard deviation of 1e-5.
  const Matrix3d C = covariance + 1e-10 * Matrix3d::Identity();
  return C.ldlt().solve(Matrix3d::Identity());
}

/// M, raised to at least `floor` in every direction.
Matrix6d bounded_below(const Matrix6d& M, const Matrix6d& floor) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d> solver(M, floor);
  if (solver.info() != Eigen::Success) return M + floor;
  const Matrix6d L = floor * solver.eigenvectors();
  return L * solver.eigenvalues().cwiseMax(1.0).asDiagonal() * L.transpose();
}

}  // namespace

DirectEquations::DirectEquations(const DirectReference& reference, const SE3& T_ref_cur,
                                 const MotionGuess& guess)
    : reference_(reference), guess_(guess), T_cur_ref_(T_ref_cur.inverse()) {
  for (const SurfacePatch& patch : reference.patches())
    planes_.push_back({patch.g_ref, 1, 0, information_of(patch.g_covariance)});
}

/// Initializes the bias of every plane by the median difference of the grey values.
void DirectEquations::start_photometry() {
  photometry_known_ = true;
  std::vector<std::vector<double>> differences(planes_.size());
  for (const Row& row : rows_)
    differences[static_cast<std::size_t>(row.plane)].push_back(row.residual);
  for (std::size_t k = 0; k < planes_.size(); ++k)
    if (!differences[k].empty()) planes_[k].bias = median_of(differences[k]);
  for (Row& row : rows_) row.residual -= planes_[static_cast<std::size_t>(row.plane)].bias;
}

void DirectEquations::linearize(const Image& image, int level) {
  const auto& samples = reference_.levels().at(static_cast<std::size_t>(level));
  const LevelCamera camera(reference_.camera(), level);
  const Matrix3d R = T_cur_ref_.rotation().matrix();
  const Vector3d& t = T_cur_ref_.translation();
  rows_.clear();
  all_ = static_cast<int>(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    const PlaneState& plane = planes_[static_cast<std::size_t>(sample.patch)];
    const double w = plane.g.dot(sample.ray_ref);
    const Vector3d X = R * sample.ray_ref + t * w;
    const auto px = camera.project(X, image);
    if (!px) continue;
    const GreySample grey = sample_bicubic(image, px->x(), px->y());
    const Vector3d forward = camera.by_point({grey.du, grey.dv}, X);
    // In the reference frame, in which the motion is perturbed, with the mean of both gradients.
    const Vector3d by_ref = 0.5 * (R.transpose() * forward +
                                   plane.gain * camera.by_point(sample.gradient, sample.ray_ref));
    Row row;
    row.J << w * by_ref, sample.ray_ref.cross(by_ref);
    row.J_local << forward.dot(t) * sample.ray_ref, -sample.grey, -1;
    row.px = *px;
    row.grey = grey.value;
    row.residual = grey.value - plane.gain * sample.grey - plane.bias;
    row.sample = static_cast<int>(i);
    row.plane = sample.patch;
    rows_.push_back(row);
  }
  if (!photometry_known_) start_photometry();
  visible_ = static_cast<int>(rows_.size());
  level_ = level;
  weigh();
}

void DirectEquations::weigh() {
  magnitudes_.clear();
  for (const Row& row : rows_) magnitudes_.push_back(std::abs(row.residual));
  if (magnitudes_.empty()) return;
  sigma_ = std::max(kLeastSigmaGrey, 1.4826 * median_of(magnitudes_));
  const double cut = kDirectTukeyWidth * sigma_;
  for (Row& row : rows_) {
    const double q = 1 - row.residual * row.residual / (cut * cut);
    row.weight = q > 0 ? q * q : 0;
    // The derivative of the score weight(e) e.
    row.psi_slope = q > 0 ? q * (5 * q - 4) : 0;
  }
}

std::vector<DirectEquations::Block> DirectEquations::blocks(bool by_slope) const {
  std::vector<Block> blocks(planes_.size());
  const double per_variance = 1 / (sigma_ * sigma_);
  for (const Row& row : rows_) {
    if (row.weight <= 0) continue;
    Block& block = blocks[static_cast<std::size_t>(row.plane)];
    const double w = per_variance * (by_slope ? row.psi_slope : row.weight);
    block.H.selfadjointView<Eigen::Lower>().rankUpdate(row.J, w);
    block.C.noalias() += w * row.J * row.J_local.transpose();
    block.L.selfadjointView<Eigen::Lower>().rankUpdate(row.J_local, w);
    const double e = per_variance * row.weight * row.residual;
    block.b.noalias() += e * row.J;
    block.c.noalias() += e * row.J_local;
  }
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    Block& block = blocks[k];
    const PlaneState& plane = planes_[k];
    block.H.triangularView<Eigen::StrictlyUpper>() = block.H.transpose();
    block.L.triangularView<Eigen::StrictlyUpper>() = block.L.transpose();
    block.L.topLeftCorner<3, 3>() += plane.g_information;
    block.c.head<3>() += plane.g_information * (plane.g - reference_.patches()[k].g_ref);
    block.L(3, 3) += 1 / (kSigmaGain * kSigmaGain);
    block.c[3] += (plane.gain - 1) / (kSigmaGain * kSigmaGain);
    block.L(4, 4) += 1 / (kSigmaBias * kSigmaBias);
    block.c[4] += plane.bias / (kSigmaBias * kSigmaBias);
  }
  return blocks;
}

bool DirectEquations::step() {
  if (visible_ < 30) return false;
  const auto parts = blocks(false);
  // T_ref_cur = T_cur_ref^-1 moves by -Ad(T_cur_ref) xi.
  const Matrix6d A = -T_cur_ref_.adjoint();
  const Vector6d off = (guess_.T_ref_cur.inverse() * T_cur_ref_.inverse()).log();
  Matrix6d S = A.transpose() * guess_.information * A;
  Vector6d s = A.transpose() * guess_.information * off;
  std::vector<Eigen::LDLT<Eigen::Matrix<double, 5, 5>>> solvers;
  for (const Block& part : parts) {
    const auto& solver = solvers.emplace_back(part.L);
    S += part.H - part.C * solver.solve(part.C.transpose());
    s += part.b - part.C * solver.solve(part.c);
  }
  S.diagonal() *= 1 + 1e-9;
  const Eigen::LDLT<Matrix6d> solver(S);
  const Vector6d xi = -solver.solve(s);
  if (solver.info() != Eigen::Success || !solver.isPositive() || !xi.allFinite()) return false;

  double moved = 0;
  const LevelCamera camera(reference_.camera(), level_);
  const auto& samples = reference_.levels()[static_cast<std::size_t>(level_)];
  for (const Row& row : rows_) {
    const Sample& sample = samples[static_cast<std::size_t>(row.sample)];
    const double w = planes_[static_cast<std::size_t>(row.plane)].g.dot(sample.ray_ref);
    const Vector3d d = w * xi.head<3>() + xi.tail<3>().cross(sample.ray_ref);
    moved += std::hypot(camera.fx * (d.x() - sample.ray_ref.x() * d.z()),
                        camera.fy * (d.y() - sample.ray_ref.y() * d.z()));
  }
  step_px_ = moved / visible_;
  // The linear model of grey values is valid within a few pixels.
  constexpr double kFarthest_px = 6;
  const double shrink = std::min(1.0, kFarthest_px / std::max(step_px_, 1e-9));
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    const Local d = -solvers[k].solve(parts[k].c + parts[k].C.transpose() * xi);
    if (!d.allFinite()) return false;
    planes_[k].g += shrink * d.head<3>();
    planes_[k].gain += shrink * d[3];
    planes_[k].bias += shrink * d[4];
  }
  T_cur_ref_ = T_cur_ref_.plus(Vector6d(shrink * xi));
  return true;
}

void DirectEquations::report(DirectMotion& motion) const {
  motion.T_ref_cur = T_cur_ref_.inverse();
  motion.visible_share = all_ > 0 ? static_cast<double>(visible_) / all_ : 0;
  motion.planes.clear();
  std::vector<double> n(planes_.size()), mean(planes_.size());
  for (const Row& row : rows_) {
    n[static_cast<std::size_t>(row.plane)] += row.weight;
    mean[static_cast<std::size_t>(row.plane)] += row.weight * row.grey;
  }
  // Grey levels beyond which noise is contradiction, and deviations of an inlier. Chosen.
  constexpr double kWidestSigma = 12, kInlierSigmas = 2.5;
  const double inlier = kInlierSigmas * std::min(sigma_, kWidestSigma);
  const auto parts = blocks(false);
  for (std::size_t k = 0; k < planes_.size(); ++k) {
    if (n[k] > 0) mean[k] /= n[k];
    motion.planes.push_back({planes_[k].g,
                             parts[k].L.topLeftCorner<3, 3>().ldlt().solve(Matrix3d::Identity()),
                             planes_[k].gain, planes_[k].bias, 0, 0});
  }
  double unexplained = 0, variance = 0, inliers = 0;
  motion.seen.clear();
  for (const Row& row : rows_) {
    const auto k = static_cast<std::size_t>(row.plane);
    unexplained += row.weight * row.residual * row.residual;
    variance += row.weight * (row.grey - mean[k]) * (row.grey - mean[k]);
    const bool on = std::abs(row.residual) < inlier;
    inliers += on;
    ++motion.planes[k].visible;
    motion.planes[k].inlier_share += on;
    motion.seen.push_back({row.px, row.residual / sigma_});
  }
  for (auto& plane : motion.planes) plane.inlier_share /= std::max(1, plane.visible);
  motion.inlier_share = visible_ > 0 ? inliers / visible_ : 0;
  motion.agreement = variance > 0 ? std::sqrt(std::max(0.0, 1 - unexplained / variance)) : 0;
}

bool DirectEquations::covariance(DirectMotion& motion) const {
  const Matrix6d A = -T_cur_ref_.adjoint();
  const Matrix6d prior = A.transpose() * guess_.information * A;
  // Use the derivative of the score in the equations, unless they become indefinite.
  for (const bool by_slope : {true, false}) {
    const auto parts = blocks(by_slope);
    Matrix6d S = prior, M = prior, independent = prior;
    std::vector<Eigen::Matrix<double, 6, 5>> local_share;  // C L^-1
    bool sound = true;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Eigen::LDLT<Eigen::Matrix<double, 5, 5>> solver(parts[k].L);
      sound = sound && solver.isPositive();
      local_share.push_back(solver.solve(parts[k].C.transpose()).transpose());
      S += parts[k].H - local_share[k] * parts[k].C.transpose();
      const Matrix6d plane = local_share[k].leftCols<3>() * planes_[k].g_information *
                             local_share[k].leftCols<3>().transpose();
      M += plane;
      independent += plane;
    }
    std::map<int, Vector6d> tiles;
    const auto& samples = reference_.levels()[static_cast<std::size_t>(level_)];
    const double per_variance = 1 / (sigma_ * sigma_);
    for (const Row& row : rows_) {
      if (row.weight <= 0) continue;
      const Vector6d score =
          per_variance * row.weight * row.residual *
          (row.J - local_share[static_cast<std::size_t>(row.plane)] * row.J_local);
      const int tile = samples[static_cast<std::size_t>(row.sample)].tile;
      tiles.try_emplace(tile, Vector6d::Zero()).first->second += score;
      independent.noalias() += score * score.transpose();
    }
    for (const auto& [tile, score] : tiles) M.noalias() += score * score.transpose();
    const Eigen::LDLT<Matrix6d> solver(S);
    sound = sound && solver.info() == Eigen::Success && solver.isPositive() &&
            (solver.vectorD().array() > 0).all();
    if (!sound) continue;
    const Matrix6d inverse = solver.solve(Matrix6d::Identity());
    const Matrix6d C = inverse * bounded_below(M, independent) * inverse;
    if (!C.allFinite()) continue;
    motion.covariance = A * C * A.transpose();
    motion.covariance = (0.5 * (motion.covariance + motion.covariance.transpose())).eval();
    return true;
  }
  return false;
}

double correlation_at(const DirectReference& reference, const std::vector<Sample>& samples,
                      const Image& image, int level, const SE3& T_cur_ref) {
  struct Sums {
    double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  };
  std::vector<Sums> sums(reference.patches().size());
  const LevelCamera camera(reference.camera(), level);
  const Matrix3d R = T_cur_ref.rotation().matrix();
  double seen = 0;
  for (const Sample& sample : samples) {
    const auto k = static_cast<std::size_t>(sample.patch);
    const double w = reference.patches()[k].g_ref.dot(sample.ray_ref);
    const auto px = camera.project(R * sample.ray_ref + T_cur_ref.translation() * w, image);
    if (!px) continue;
    const double x = sample.grey, y = value_bicubic(image, px->x(), px->y());
    Sums& s = sums[k];
    s.n += 1, s.a += x, s.b += y, s.aa += x * x, s.bb += y * y, s.ab += x * y;
    seen += 1;
  }
  if (3 * seen < static_cast<double>(samples.size())) return -1;
  double total = 0;
  for (const Sums& s : sums) {
    if (s.n < 2) continue;
    const double va = s.aa - s.a * s.a / s.n, vb = s.bb - s.b * s.b / s.n;
    if (va > 0 && vb > 0) total += s.n * (s.ab - s.a * s.b / s.n) / std::sqrt(va * vb);
  }
  return total / seen;
}

}  // namespace placegraph
