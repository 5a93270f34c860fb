#include <placegraph/frontend/planes/homography_fit.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace placegraph {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Vector8d = Eigen::Matrix<double, 8, 1>;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// Ratio of a triangle's area to its longest side squared below which three points count as
/// collinear.
constexpr double kMinTriangle = 0.02;
/// A step this small (H of norm one, pixels scaled to one) ends the iteration.
constexpr double kSmallStep = 1e-10;
/// Smallest to largest eigenvalue of the scaled normal equations below which H is not determined.
constexpr double kMinCondition = 1e-13;

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Twice the signed area over the longest side squared.
double shape(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0 ? cross(b - a, c - a) / longest : 0;
}

/// x' = scale (x - centre), as a matrix.
struct Conditioning {
  Vector2d centre = Vector2d::Zero();
  double scale = 1;
  Matrix3d matrix() const {
    Matrix3d T = Vector3d(scale, scale, 1).asDiagonal();
    T.topRightCorner<2, 1>() = -scale * centre;
    return T;
  }
  Vector2d operator()(const Vector2d& px) const { return scale * (px - centre); }
};

template <class Indices>
Vector2d mean(const std::vector<Vector2d>& px, const Indices& which) {
  Vector2d sum = Vector2d::Zero();
  for (const int i : which) sum += px[static_cast<std::size_t>(i)];
  return sum / static_cast<double>(which.size());
}

/// Both views centred and with one scale, so that noise that is equal in both remains equal.
template <class Indices>
std::array<Conditioning, 2> conditioning(const PointMatches& matches, const Indices& which) {
  std::array<Conditioning, 2> views;
  views[0].centre = mean(matches.px_ref, which);
  views[1].centre = mean(matches.px_cur, which);
  double spread = 0;
  for (const int i : which) {
    const auto k = static_cast<std::size_t>(i);
    spread += (matches.px_ref[k] - views[0].centre).squaredNorm() +
              (matches.px_cur[k] - views[1].centre).squaredNorm();
  }
  spread = std::sqrt(spread / (2.0 * static_cast<double>(which.size())));
  if (spread > 0) views[0].scale = views[1].scale = 1 / spread;
  return views;
}

/// Derivatives of (x, y) = dehomogenized H (u, v, 1): by the entries of H, row by row.
Eigen::Matrix<double, 2, 9> derivative_by_entries(const Matrix3d& H, const Vector2d& from,
                                                  const Vector2d& to) {
  const Vector3d h = from.homogeneous() / (H.row(2) * from.homogeneous())(0);
  Eigen::Matrix<double, 2, 9> J = Eigen::Matrix<double, 2, 9>::Zero();
  J.block<1, 3>(0, 0) = h.transpose();
  J.block<1, 3>(1, 3) = h.transpose();
  J.block<1, 3>(0, 6) = -to[0] * h.transpose();
  J.block<1, 3>(1, 6) = -to[1] * h.transpose();
  return J;
}

Matrix3d unit(const Matrix3d& H) { return H / H.norm(); }

Vector9d entries(const Matrix3d& H) {
  return (Vector9d() << H.row(0).transpose(), H.row(1).transpose(), H.row(2).transpose())
      .finished();
}

Matrix3d from_entries(const Vector9d& h) {
  Matrix3d H;
  H << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], h[8];
  return H;
}

/// Eight orthonormal directions orthogonal to h.
Eigen::Matrix<double, 9, 8> across(const Vector9d& h) {
  const Eigen::HouseholderQR<Vector9d> qr(h);
  const Matrix9d Q = qr.householderQ();
  return Q.rightCols<8>();
}

struct Normal {
  Matrix8d information = Matrix8d::Zero();
  Vector8d gradient = Vector8d::Zero();
  Matrix8d expected = Matrix8d::Zero();  // information without weights
  double cost = 0;
};

Normal normal_equations(const Matrix3d& H, const Eigen::Matrix<double, 9, 8>& basis,
                        const PointMatches& matches, const TransferNoise& noise) {
  Normal normal;
  for (int k = 0; k < matches.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const TransferError error = transfer_error(H, matches.px_ref[i], matches.px_cur[i]);
    normal.cost += noise.cost(error);
    if (!std::isfinite(normal.cost)) return normal;
    const Eigen::Matrix<double, 2, 8> J =
        derivative_by_entries(H, matches.px_ref[i], matches.px_cur[i] - error.residual) * basis;
    const Eigen::Matrix<double, 8, 2> JW = J.transpose() * error.unit_covariance.inverse();
    const Matrix8d one = JW * J;
    const double weight = noise.weight(error);
    normal.expected += one;
    normal.information += weight * one;
    normal.gradient.noalias() += weight * JW * error.residual;
  }
  return normal;
}

}  // namespace

double TransferNoise::cost(const TransferError& error) const {
  const double s = error.squared / (sigma_px * sigma_px);
  const double tail =
      std::isfinite(freedom) ? 0.5 * (freedom + 2) * std::log1p(s / freedom) : s / 2;
  return tail + std::log(2 * std::numbers::pi * sigma_px * sigma_px) + 0.5 * error.log_determinant;
}

double TransferNoise::weight(const TransferError& error) const {
  return std::isfinite(freedom) ? (freedom + 2) / (freedom + error.squared / (sigma_px * sigma_px))
                                : 1;
}

double TransferNoise::information() const {
  return std::isfinite(freedom) ? (freedom + 2) / (freedom + 4) : 1;
}

TransferError transfer_error(const Matrix3d& H_cur_ref, const Vector2d& px_ref,
                             const Vector2d& px_cur) {
  TransferError error;
  const Vector3d moved = H_cur_ref * px_ref.homogeneous();
  // Whether w is positive on the plane's visible side depends on the sign of H: normal homographies
  // have det > 0 with w > 0 there.
  if (!(moved[2] * H_cur_ref.determinant() > 0)) {
    error.residual.setZero();
    error.unit_covariance.setIdentity();
    error.squared = std::numeric_limits<double>::infinity();
    return error;
  }
  const Vector2d to = moved.head<2>() / moved[2];
  Matrix2d J;
  J.row(0) = (H_cur_ref.row(0) - to[0] * H_cur_ref.row(2)).head<2>() / moved[2];
  J.row(1) = (H_cur_ref.row(1) - to[1] * H_cur_ref.row(2)).head<2>() / moved[2];
  error.residual = px_cur - to;
  error.unit_covariance = Matrix2d::Identity() + J * J.transpose();
  const double determinant = error.unit_covariance.determinant();
  error.squared = error.residual.dot(error.unit_covariance.inverse() * error.residual);
  error.log_determinant = std::log(determinant);
  return error;
}

std::optional<Matrix3d> homography_through(const PointMatches& matches,
                                           const std::array<int, 4>& which) {
  std::array<Vector2d, 4> from, to;
  const auto [ref, cur] = conditioning(matches, which);
  for (std::size_t k = 0; k < 4; ++k) {
    from[k] = ref(matches.px_ref[static_cast<std::size_t>(which[k])]);
    to[k] = cur(matches.px_cur[static_cast<std::size_t>(which[k])]);
  }
  constexpr std::array<std::array<std::size_t, 3>, 4> triangles = {
      {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
  for (const auto& [a, b, c] : triangles) {
    const double before = shape(from[a], from[b], from[c]), after = shape(to[a], to[b], to[c]);
    if (std::abs(before) < kMinTriangle || std::abs(after) < kMinTriangle || before * after < 0)
      return std::nullopt;
  }
  Matrix8d A = Matrix8d::Zero();
  Vector8d b;
  for (int k = 0; k < 4; ++k) {
    const Vector2d& p = from[static_cast<std::size_t>(k)];
    const Vector2d& q = to[static_cast<std::size_t>(k)];
    A.row(2 * k) << p[0], p[1], 1, 0, 0, 0, -q[0] * p[0], -q[0] * p[1];
    A.row(2 * k + 1) << 0, 0, 0, p[0], p[1], 1, -q[1] * p[0], -q[1] * p[1];
    b.segment<2>(2 * k) = q;
  }
  const Vector8d h = A.partialPivLu().solve(b);
  if (!h.allFinite()) return std::nullopt;
  const Matrix3d H =
      cur.matrix().inverse() * from_entries((Vector9d() << h, 1).finished()) * ref.matrix();
  // The orientation of the triangles is the same, so that the determinant is positive where w is.
  if (!H.allFinite() || !(H.determinant() > 0)) return std::nullopt;
  return unit(H);
}

HomographyFit refine_homography(const Matrix3d& H_start, const PointMatches& matches,
                                const std::vector<int>& which, const TransferNoise& noise,
                                int max_iterations) {
  HomographyFit fit;
  fit.H_cur_ref = unit(H_start);
  if (which.size() < 4) {
    fit.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                   std::to_string(which.size()) + " matches, 4 needed");
    return fit;
  }
  const auto [ref, cur] = conditioning(matches, which);
  PointMatches scaled;
  for (const int i : which) {
    scaled.px_ref.push_back(ref(matches.px_ref[static_cast<std::size_t>(i)]));
    scaled.px_cur.push_back(cur(matches.px_cur[static_cast<std::size_t>(i)]));
  }
  const TransferNoise scaled_noise{noise.sigma_px * ref.scale, noise.freedom};
  Matrix3d H = unit(cur.matrix() * H_start * ref.matrix().inverse());
  Eigen::Matrix<double, 9, 8> basis = across(entries(H));
  Normal normal = normal_equations(H, basis, scaled, scaled_noise);
  for (; fit.iterations < max_iterations && std::isfinite(normal.cost); ++fit.iterations) {
    const Vector8d step = normal.information.ldlt().solve(normal.gradient);
    if (!step.allFinite()) break;
    const Matrix3d H_next = unit(from_entries(entries(H) + basis * step));
    const Eigen::Matrix<double, 9, 8> basis_next = across(entries(H_next));
    const Normal next = normal_equations(H_next, basis_next, scaled, scaled_noise);
    if (!(next.cost <= normal.cost)) break;
    H = H_next;
    basis = basis_next;
    normal = next;
    if (step.norm() < kSmallStep) break;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix8d> eigen(normal.expected);
  if (!std::isfinite(normal.cost) ||
      !(eigen.eigenvalues()[0] > kMinCondition * eigen.eigenvalues()[7])) {
    fit.outcome =
        Outcome::failure(Outcome::Code::kDegenerate, "the matches do not determine a homography");
    return fit;
  }
  // Back to pixels: h = M h_scaled / |M h_scaled|, M the Kronecker product of the conditionings.
  const Matrix3d left = cur.matrix().inverse(), right = ref.matrix();
  Matrix9d M;
  for (int i = 0; i < 9; ++i) M.col(i) = entries(left * from_entries(Vector9d::Unit(i)) * right);
  const Vector9d h = M * entries(H);
  const Vector9d direction = h.normalized();
  const Eigen::Matrix<double, 9, 8> J =
      (Matrix9d::Identity() - direction * direction.transpose()) / h.norm() * M * basis;
  const double variance =
      scaled_noise.sigma_px * scaled_noise.sigma_px / scaled_noise.information();
  fit.H_cur_ref = from_entries(direction);
  fit.covariance = J * normal.expected.inverse() * J.transpose() * variance;
  // Densities of scaled pixels are higher by the scale of an area.
  fit.cost = normal.cost - 2 * static_cast<double>(which.size()) * std::log(ref.scale);
  fit.outcome = Outcome::ok();
  return fit;
}

}  // namespace placegraph
