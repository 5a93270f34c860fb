#include <placegraph/frontend/lines/pose_from_lines.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>

namespace placegraph {
namespace {

/// RANSAC is skipped if this share of the lines are inliers of the predicted pose. Chosen.
constexpr double kPriorLineInlierRatio = 0.6;
/// Width of the Huber kernel [standard deviations]. Chosen.
constexpr double kLineHuberSigmas = 3;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double squared_error_px(const Camera& camera, const SE3& T_ref_cam, const SeenLine& line) {
  const auto r =
      line_residual_px(camera, T_ref_cam, line.line_ref, line.seen.first, line.seen.second);
  if (!r) return kInfinity;
  const auto z =
      depth_on_line(camera, T_ref_cam, line.line_ref, 0.5 * (line.seen.first + line.seen.second));
  return z && *z > 0 ? r->cwiseAbs2().maxCoeff() : kInfinity;
}

std::vector<int> inliers_of(const Camera& camera, const SE3& T_ref_cam,
                            const std::vector<SeenLine>& lines, double threshold_px) {
  std::vector<int> inliers;
  for (int i = 0; i < static_cast<int>(lines.size()); ++i)
    if (squared_error_px(camera, T_ref_cam, lines[i]) < threshold_px * threshold_px)
      inliers.push_back(i);
  return inliers;
}

/// Gauss-Newton; returns T_ref_cam and the normal matrix in `normal`. Distances beyond `huber_px`
/// or `huber_sigmas` of their own, whichever is greater, are downweighted.
SE3 refine(const Camera& camera, const std::vector<SeenLine>& lines,
           const std::vector<int>& indices, const SE3& T_start, const PoseGuess* guess,
           double huber_sigmas, double huber_px, int iterations, Matrix6d* normal) {
  SE3 T = T_start;
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    for (const int i : indices) {
      const SeenLine& line = lines[i];
      Eigen::Matrix<double, 2, 6> J;
      const auto r =
          line_residual_px(camera, T, line.line_ref, line.seen.first, line.seen.second, &J);
      if (!r) continue;
      const double width = std::max(huber_px, huber_sigmas * line.seen.sigma_px);
      const double w = std::min(1.0, width / std::max(1e-12, r->norm())) /
                       (line.seen.sigma_px * line.seen.sigma_px);
      H.noalias() += w * J.transpose() * J;
      g.noalias() += w * J.transpose() * *r;
    }
    if (guess) {  // the derivative of the log is near the identity for a small error
      H += guess->information;
      g += guess->information * (guess->T_ref_cam.inverse() * T).log();
    }
    if (normal) *normal = H;
    const Vector6d step = -(H + 1e-10 * H.trace() * Matrix6d::Identity()).ldlt().solve(g);
    if (!step.allFinite()) break;
    T = T.plus(step);
    if (step.norm() < 1e-9) break;
  }
  return T;
}

PoseFromLines finish(const Camera& camera, const std::vector<SeenLine>& lines,
                     const PoseFromLinesOptions& options, const PoseGuess* guess,
                     const SE3& T_start, std::vector<int> inliers) {
  PoseFromLines result;
  result.T_ref_cam = T_start;
  for (int round = 0; round < 2; ++round) {
    result.T_ref_cam = refine(camera, lines, inliers, result.T_ref_cam, guess, kLineHuberSigmas, 0,
                              8, &result.information);
    inliers = inliers_of(camera, result.T_ref_cam, lines, options.threshold_px);
  }
  result.inliers = std::move(inliers);
  const int count = static_cast<int>(result.inliers.size());
  double sum = 0;
  for (const int i : result.inliers) {
    const SeenLine& line = lines[i];
    const auto r = line_residual_px(camera, result.T_ref_cam, line.line_ref, line.seen.first,
                                    line.seen.second);
    if (r) sum += r->squaredNorm() / (line.seen.sigma_px * line.seen.sigma_px);
  }
  result.rms_sigmas = count ? std::sqrt(sum / (2.0 * count)) : 0;
  if (count < options.ransac.min_inliers) {
    result.outcome =
        Outcome::failure(Outcome::Code::kNoConsensus, std::to_string(count) + " inliers of " +
                                                          std::to_string(lines.size()) + " lines");
    return result;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(result.information, Eigen::EigenvaluesOnly);
  const bool fixed = eigen.eigenvalues()[0] > 1e-9 * eigen.eigenvalues()[5];
  // Scaled by the scatter of the lines if it exceeds their stated covariances.
  result.information /= std::max(1.0, result.rms_sigmas * result.rms_sigmas);
  result.outcome = fixed
                       ? Outcome::ok()
                       : Outcome::failure(Outcome::Code::kDegenerate,
                                          "the lines do not determine all six degrees of freedom");
  return result;
}

/// The roots of a real trigonometric polynomial of degree four given by its values at nine equally
/// spaced angles.
std::vector<double> trigonometric_roots(const std::array<double, 9>& values) {
  using Complex = std::complex<double>;
  // Degree of the polynomial of three lines.
  constexpr int kDegree = 8;
  Eigen::Matrix<Complex, kDegree + 1, 1>
      c;  // coefficients of z^0 .. z^8, z = exp(i angle), times z^4
  for (int k = 0; k <= kDegree; ++k) {
    Complex sum = 0;
    for (int j = 0; j <= kDegree; ++j)
      sum += values[j] * std::polar(1.0, -2 * std::numbers::pi * j * (k - 4) / 9.0);
    c[k] = sum / 9.0;
  }
  const double size = c.cwiseAbs().maxCoeff();
  if (!(std::abs(c[kDegree]) > 1e-12 * size)) return {};
  Eigen::Matrix<Complex, kDegree, kDegree> companion =
      Eigen::Matrix<Complex, kDegree, kDegree>::Zero();
  for (int k = 0; k < kDegree; ++k) {
    if (k > 0) companion(k, k - 1) = 1;
    companion(k, kDegree - 1) = -c[k] / c[kDegree];
  }
  const Eigen::ComplexEigenSolver<Eigen::Matrix<Complex, kDegree, kDegree>> eigen(companion, false);
  std::vector<double> roots;
  for (int k = 0; k < kDegree; ++k) {
    const Complex z = eigen.eigenvalues()[k];
    if (std::abs(std::abs(z) - 1) < 1e-3) roots.push_back(std::arg(z));
  }
  return roots;
}

}  // namespace

std::vector<SE3> solve_three_lines(const std::array<Line3, 3>& lines_ref,
                                   const std::array<Eigen::Vector3d, 3>& normals_cam) {
  Eigen::Matrix3d C, V;  // m_1 is the third axis of C, v_1 the first of V
  C.col(2) = normals_cam[0];
  C.col(0) = C.col(2).unitOrthogonal();
  C.col(1) = C.col(2).cross(C.col(0));
  V.col(0) = lines_ref[0].direction();
  V.col(1) = V.col(0).unitOrthogonal();
  V.col(2) = V.col(0).cross(V.col(1));
  Eigen::Vector3d m[2], v[2];
  for (int i = 0; i < 2; ++i) {
    m[i] = C.transpose() * normals_cam[i + 1];
    v[i] = V.transpose() * lines_ref[i + 1].direction();
  }
  // R = C Rz(alpha) Rx(beta) V^T; each line: A_i cos alpha + B_i sin alpha + D_i = 0.
  const auto system = [&](double beta) {
    Eigen::Matrix<double, 2, 3> rows;
    for (int i = 0; i < 2; ++i) {
      const double q = v[i].y() * std::cos(beta) - v[i].z() * std::sin(beta);
      const double r = v[i].y() * std::sin(beta) + v[i].z() * std::cos(beta);
      rows.row(i) << v[i].x() * m[i].x() + q * m[i].y(), v[i].x() * m[i].y() - q * m[i].x(),
          m[i].z() * r;
    }
    return rows;
  };
  const auto determinants = [&](double beta) {
    const Eigen::Matrix<double, 2, 3> S = system(beta);
    return Eigen::Vector3d(S.col(0).x() * S.col(1).y() - S.col(1).x() * S.col(0).y(),
                           S.col(1).x() * S.col(2).y() - S.col(2).x() * S.col(1).y(),
                           S.col(2).x() * S.col(0).y() - S.col(0).x() * S.col(2).y());
  };
  std::array<double, 9> values;
  for (int j = 0; j < 9; ++j) {
    const Eigen::Vector3d d = determinants(2 * std::numbers::pi * j / 9);
    values[j] = d[1] * d[1] + d[2] * d[2] - d[0] * d[0];
  }
  std::vector<SE3> poses;
  for (const double beta : trigonometric_roots(values)) {
    const Eigen::Vector3d d = determinants(beta);
    if (!(std::abs(d[0]) > 1e-9)) continue;
    const double alpha = std::atan2(d[2] / d[0], d[1] / d[0]);
    const Eigen::Matrix3d R = C * Eigen::AngleAxisd(alpha, Eigen::Vector3d::UnitZ()).matrix() *
                              Eigen::AngleAxisd(beta, Eigen::Vector3d::UnitX()).matrix() *
                              V.transpose();
    Eigen::Matrix3d M;
    Eigen::Vector3d b;
    for (int i = 0; i < 3; ++i) {
      M.row(i) = normals_cam[i].transpose();
      b[i] = -normals_cam[i].dot(R * lines_ref[i].nearest_point());
    }
    const Eigen::FullPivLU<Eigen::Matrix3d> lu(M);
    if (!(std::abs(M.determinant()) > 1e-6)) return {};
    poses.emplace_back(R, Eigen::Vector3d(lu.solve(b)));
  }
  return poses;
}

PoseFromLines estimate_pose_from_lines(const Camera& camera, const std::vector<SeenLine>& lines,
                                       const PoseFromLinesOptions& options, Random& random,
                                       const PoseGuess* guess) {
  options.check();
  const int n = static_cast<int>(lines.size());
  PoseFromLines result;
  if (n < std::max(3, options.ransac.min_inliers)) {
    result.outcome =
        Outcome::failure(Outcome::Code::kTooFewData,
                         std::to_string(n) + " lines, " +
                             std::to_string(std::max(3, options.ransac.min_inliers)) + " needed");
    return result;
  }
  for (const SeenLine& line : lines)
    require(line.seen.sigma_px > 0, "estimate_pose_from_lines: sigma_px must be positive");
  if (guess) {
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    // A wide kernel first, so that lines are not rejected for the guess' error of some pixels.
    const SE3 T = refine(camera, lines, all, guess->T_ref_cam, guess, kLineHuberSigmas,
                         options.threshold_px, 10, nullptr);
    std::vector<int> inliers = inliers_of(camera, T, lines, options.threshold_px);
    if (static_cast<double>(inliers.size()) >= kPriorLineInlierRatio * n)
      return finish(camera, lines, options, guess, T, std::move(inliers));
  }
  std::vector<Eigen::Vector3d> normals;
  for (const SeenLine& line : lines)
    normals.push_back(plane_normal(camera, line.seen.first, line.seen.second));
  const auto solve = [&](const std::vector<int>& s) {
    std::vector<SE3> models;
    for (const SE3& T_cam_ref :
         solve_three_lines({lines[s[0]].line_ref, lines[s[1]].line_ref, lines[s[2]].line_ref},
                           {normals[s[0]], normals[s[1]], normals[s[2]]}))
      models.push_back(T_cam_ref.inverse());
    return models;
  };
  const auto error = [&](const SE3& T_ref_cam, int i) {
    return squared_error_px(camera, T_ref_cam, lines[i]);
  };
  const auto improve = [&](const SE3& T_ref_cam, const std::vector<int>& inliers) {
    return refine(camera, lines, inliers, T_ref_cam, nullptr, kLineHuberSigmas,
                  options.threshold_px / 2, 4, nullptr);
  };
  const auto consensus = ransac<SE3>(n, 3, options.threshold_px * options.threshold_px,
                                     options.ransac, random, solve, error, improve);
  if (!consensus.outcome) {
    result.outcome = consensus.outcome;
    result.inliers = consensus.inliers;
    return result;
  }
  return finish(camera, lines, options, guess, consensus.model, consensus.inliers);
}

}  // namespace placegraph
