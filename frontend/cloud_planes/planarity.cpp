#include <placegraph/frontend/cloud_planes/planarity.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

constexpr int kSamples = 256;  ///< number of points of a segment that are sampled
const double kSimilarCos = std::cos(deg_to_rad(10)), kGentleCos = std::cos(deg_to_rad(12)),
             kCreaseCos = std::cos(deg_to_rad(30));

std::vector<int> sample_points(const PlanarSegment& segment, const SuperPoints& cloud) {
  const int stride = std::max(1, static_cast<int>(segment.sums.count()) / kSamples);
  std::vector<int> sample;
  int count = 0;
  for (const int c : segment.cells)
    for (int k = cloud.cells[c].begin; k < cloud.cells[c].end; ++k)
      if (count++ % stride == 0) sample.push_back(cloud.order[k]);
  return sample;
}

/// Signed residual in standard deviations, including the allowed deviation.
double residual(const FittedPlane& fit, const FitPoint& point, const FitModel& model) {
  const bool ray = model.noise == PointNoise::kAlongRay;
  const double off =
      ray ? point.value - fit.g.dot(point.q) : fit.plane.normal.dot(point.q) - fit.plane.distance_m;
  return std::copysign(residual_sigmas(fit, point, model), off);
}

struct Shape {
  double linearity = 0, dispersion = 0;  ///< from the eigenvalues of the points' covariance
  double near = 0, far = 0;     ///< share of residuals below one, above two standard deviations
  double curved = 0, bend = 0;  ///< share of the residuals that a quadric explains; its size
};

Shape shape_of(const PlanarSegment& segment, const CloudPoints& points, const SuperPoints& cloud) {
  const std::vector<int> sample = sample_points(segment, cloud);
  const auto n = static_cast<Eigen::Index>(sample.size());
  Eigen::Matrix3Xd xyz(3, n);
  Eigen::VectorXd r(n);
  Shape shape;
  for (Eigen::Index i = 0; i < n; ++i) {
    const int p = sample[static_cast<std::size_t>(i)];
    xyz.col(i) = points.xyz[p];
    r[i] = residual(segment.plane, points.fit[p], points.model);
    shape.near += std::abs(r[i]) < 1;
    shape.far += std::abs(r[i]) > 2;
  }
  shape.near /= static_cast<double>(n), shape.far /= static_cast<double>(n);
  const Eigen::Vector3d mean = xyz.rowwise().mean();
  xyz.colwise() -= mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(xyz * xyz.transpose());
  const Eigen::Vector3d values = eigen.eigenvalues().cwiseMax(1e-30);
  shape.linearity = 1 - values[1] / values[2];
  shape.dispersion = std::sqrt(values[0] / values[2]);
  if (n < 12) return shape;
  Eigen::MatrixXd A(n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double u = eigen.eigenvectors().col(2).dot(xyz.col(i)) / std::sqrt(values[2] / n);
    const double v = eigen.eigenvectors().col(1).dot(xyz.col(i)) / std::sqrt(values[1] / n);
    A.row(i) << 1, u, v, u * u, u * v, v * v;
  }
  const Eigen::MatrixXd normal = A.transpose() * A + 1e-6 * n * Eigen::MatrixXd::Identity(6, 6);
  const Eigen::VectorXd fitted = A * normal.ldlt().solve(A.transpose() * r);
  const double before = r.squaredNorm(), after = (r - fitted).squaredNorm();
  shape.curved = before > 0 ? 1 - after / before : 0;
  shape.bend = std::sqrt(fitted.squaredNorm() / static_cast<double>(n));
  return shape;
}

/// Shares of the neighbours across the border, by kind.
struct Border {
  double pairs = 0;
  double goes_on = 0;  ///< on a cell at a small angle, as on a curved surface
  double gentle = 0;   ///< on a cell at a larger angle, but less than a crease
  double crease = 0;   ///< on a cell at a larger angle
  double rough = 0;    ///< on a cell that is not planar
};

Border border_of(const PlanarSegment& segment, const SuperPoints& cloud,
                 const std::vector<std::vector<int>>& contacts, const FitModel& model) {
  constexpr double kDifferent = 3;  // planar dissimilarity of cells that are not coplanar
  Border border;
  for (const int c : segment.cells)
    for (const int k : contacts[c]) {
      const Contact& contact = cloud.contacts[k];
      const int other = contact.a == c ? contact.b : contact.a;
      if (std::binary_search(segment.cells.begin(), segment.cells.end(), other)) continue;
      border.pairs += contact.pairs;
      const SuperPoint &here = cloud.cells[c], &there = cloud.cells[other];
      if (!there.planar) {
        border.rough += contact.pairs;
        continue;
      }
      const Eigen::Vector3d &n = here.plane.plane.normal, &m = there.plane.plane.normal;
      const double cosine = n.dot(m), sign = cosine < 0 ? -1 : 1;
      const Eigen::Vector3d to = there.centre - here.centre;
      // Each on different sides of the other's plane: a step. On the same side: a bend.
      const bool bends = n.dot(to) * -sign * m.dot(to) > 0;
      if (std::abs(cosine) < kCreaseCos)
        border.crease += contact.pairs;
      else if (bends && planar_dissimilarity(here, there, model) > kDifferent)
        (std::abs(cosine) > kGentleCos ? border.goes_on : border.gentle) += contact.pairs;
    }
  const double all = std::max(border.pairs, 1.0);
  border.goes_on /= all, border.gentle /= all, border.crease /= all, border.rough /= all;
  return border;
}

}  // namespace

PlanarityFeatures planarity_features(const PlanarSegment& segment, const CloudPoints& points,
                                     const SuperPoints& cloud,
                                     const std::vector<std::vector<int>>& contacts) {
  const double n = std::max(segment.sums.count(), 1.0);
  const double misfit =
      segment.plane.chi2 / (n * segment.sums.inflation(segment.plane, points.model));
  const Shape shape = shape_of(segment, points, cloud);
  double mean_angle = 0, similar = 0;
  for (const int c : segment.cells) {
    const double cosine =
        std::min(1.0, std::abs(cloud.cells[c].plane.plane.normal.dot(segment.plane.plane.normal)));
    mean_angle += cloud.cells[c].sums.count() * std::acos(cosine) / n;
    if (cosine > kSimilarCos) similar += cloud.cells[c].sums.count() / n;
  }
  const Border border = border_of(segment, cloud, contacts, points.model);
  return {std::log(misfit + 1e-3),
          shape.linearity,
          shape.dispersion,
          shape.near,
          shape.far,
          shape.curved,
          shape.bend,
          mean_angle,
          similar,
          border.goes_on,
          border.gentle,
          border.crease,
          border.rough,
          border.pairs / std::sqrt(n),
          std::log(n)};
}

}  // namespace placegraph
