#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/graph/core/angle.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

namespace placegraph {
namespace {

Eigen::Matrix3d line_projection(const Camera& c) {
  Eigen::Matrix3d K_line;
  K_line << c.fy, 0, 0, 0, c.fx, 0, -c.fy * c.cx, -c.fx * c.cy, c.fx * c.fy;
  return K_line;
}

struct Planes {
  int a = 0, b = 0;
  double rotation_rad = -1;
};

/// The two observations whose planes, rotated into the reference frame, have the largest angle.
Planes widest(const std::vector<Eigen::Vector3d>& normals_ref) {
  Planes best;
  const int n = static_cast<int>(normals_ref.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const double angle = std::asin(std::min(1.0, normals_ref[i].cross(normals_ref[j]).norm()));
      if (angle > best.rotation_rad) best = {i, j, angle};
    }
  return best;
}

/// Standard deviation of the angle between the planes, from those of both image lines across.
double rotation_sigma_rad(const Camera& camera, const LineMeasurement& a,
                          const LineMeasurement& b) {
  return std::hypot(a.seen.sigma_px, b.seen.sigma_px) / std::min(camera.fx, camera.fy);
}

/// Gauss-Newton on the distances of the observations' carriers from the projected line, from a line
/// nearby; sets the line, its covariance and the largest error of an observation.
void refine_line(const Camera& camera, const std::vector<LineMeasurement>& observations,
                 TriangulatedLine& result) {
  Eigen::Matrix4d H;
  // Iterations at most. Chosen.
  constexpr int kIterations = 6;
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    H.setZero();
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    result.error_sigmas = 0;
    for (const LineMeasurement& s : observations) {
      Eigen::Matrix<double, 2, 4> J;
      const auto r = line_residual_px(camera, s.T_ref_cam, result.line_ref, s.seen.first,
                                      s.seen.second, nullptr, &J);
      if (!r) continue;
      const double w = 1 / (s.seen.sigma_px * s.seen.sigma_px);
      H += w * J.transpose() * J;
      g += w * J.transpose() * *r;
      result.error_sigmas =
          std::max(result.error_sigmas, r->cwiseAbs().maxCoeff() / s.seen.sigma_px);
    }
    if (iteration == kIterations) break;
    const Eigen::Vector4d step = -H.ldlt().solve(g);
    if (!step.allFinite()) break;
    result.line_ref = result.line_ref.plus(step);
  }
  result.covariance = H.ldlt().solve(Eigen::Matrix4d::Identity());
}

}  // namespace

Eigen::Vector3d plane_normal(const Camera& camera, const Eigen::Vector2d& px_a,
                             const Eigen::Vector2d& px_b) {
  const auto ray = [&](const Eigen::Vector2d& px) {
    return Eigen::Vector3d((px.x() - camera.cx) / camera.fx, (px.y() - camera.cy) / camera.fy, 1);
  };
  return ray(px_a).cross(ray(px_b)).normalized();
}

std::optional<Eigen::Vector2d> line_residual_px(const Camera& camera, const SE3& T_ref_cam,
                                                const Line3& line_ref, const Eigen::Vector2d& px_a,
                                                const Eigen::Vector2d& px_b,
                                                Eigen::Matrix<double, 2, 6>* J_pose,
                                                Eigen::Matrix<double, 2, 4>* J_line) {
  const Eigen::Matrix3d K_line = line_projection(camera);
  Eigen::Matrix<double, 6, 6> J_L_pose;
  Eigen::Matrix<double, 6, 4> J_L_line;
  const Line3::Coordinates L =
      transform_to(T_ref_cam, line_ref, J_pose ? &J_L_pose : nullptr, J_line ? &J_L_line : nullptr);
  const Eigen::Vector3d l = K_line * L.head<3>();
  const double length = l.head<2>().norm();
  if (!(length > 1e-9 * l.norm())) return std::nullopt;
  Eigen::Matrix<double, 2, 3> ends;
  ends << px_a.transpose(), 1, px_b.transpose(), 1;
  const Eigen::Vector2d r = ends * l / length;
  if (J_pose || J_line) {
    const Eigen::RowVector3d across(l[0] / length, l[1] / length, 0);
    const Eigen::Matrix<double, 2, 3> J_m = (ends - r * across) / length * K_line;
    if (J_pose) *J_pose = J_m * J_L_pose.topRows<3>();
    if (J_line) *J_line = J_m * J_L_line.topRows<3>();
  }
  return r;
}

std::optional<double> depth_on_line(const Camera& camera, const SE3& T_ref_cam,
                                    const Line3& line_ref, const Eigen::Vector2d& px) {
  const Line3::Coordinates L = transform_to(T_ref_cam, line_ref);
  // m = p x v for the point p = z x of the ray x on the line.
  const Eigen::Vector3d x((px.x() - camera.cx) / camera.fx, (px.y() - camera.cy) / camera.fy, 1);
  const Eigen::Vector3d across = x.cross(Eigen::Vector3d(L.tail<3>()));
  const double square = across.squaredNorm();
  if (!(square > 1e-12 * x.squaredNorm() * L.tail<3>().squaredNorm())) return std::nullopt;
  return across.dot(L.head<3>()) / square;
}

TriangulatedLine triangulate_line(const Camera& camera,
                                  const std::vector<LineMeasurement>& observations,
                                  const LineTriangulationOptions& options) {
  options.check();
  TriangulatedLine result;
  if (observations.size() < 2) {
    result.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      "a single observation only determines a plane");
    return result;
  }
  std::vector<Eigen::Vector3d> normals_ref;
  for (const LineMeasurement& s : observations)
    normals_ref.push_back(s.T_ref_cam.rotation() *
                          plane_normal(camera, s.seen.first, s.seen.second));
  const Planes planes = widest(normals_ref);
  const LineMeasurement &a = observations[planes.a], &b = observations[planes.b];
  result.rotation_rad = planes.rotation_rad;
  const auto start =
      meet(normals_ref[planes.a], normals_ref[planes.a].dot(a.T_ref_cam.translation()),
           normals_ref[planes.b], normals_ref[planes.b].dot(b.T_ref_cam.translation()));
  const double needed = std::max(deg_to_rad(options.min_rotation_deg),
                                 options.min_rotation_sigmas * rotation_sigma_rad(camera, a, b));
  if (!start || planes.rotation_rad < needed) {
    result.outcome = Outcome::failure(Outcome::Code::kDegenerate,
                                      "the angle between the planes through the line is too small");
    return result;
  }
  result.line_ref = *start;
  refine_line(camera, observations, result);
  bool in_front = result.covariance.allFinite();
  for (const LineMeasurement& s : observations) {
    const auto z =
        depth_on_line(camera, s.T_ref_cam, result.line_ref, 0.5 * (s.seen.first + s.seen.second));
    in_front = in_front && z && *z > 0;
  }
  if (!in_front || result.error_sigmas > options.max_error_sigmas)
    result.outcome = Outcome::failure(Outcome::Code::kInconsistent,
                                      in_front ? "an observation does not fit the line"
                                               : "the line is behind a camera that observes it");
  else
    result.outcome = Outcome::ok();
  return result;
}

}  // namespace placegraph
