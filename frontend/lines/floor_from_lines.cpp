#include <placegraph/frontend/lines/floor_from_lines.h>
#include <placegraph/graph/core/angle.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>

namespace placegraph {
namespace {

/// Deviation of vertical edges from the floor's normal. Chosen.
constexpr double kUpright_deg = 3;
/// Standard deviation of a vertical edge's end from its floor contact. Chosen.
constexpr double kFloorContact_px = 3;
/// Standard deviation of the floor [camera heights]. Chosen.
constexpr double kUnevenness = 0.01;
/// Maximum standard deviation of a height with a vote [camera heights]. Chosen.
constexpr double kMaxVoteSigma = 0.1;
/// Minimum ratio of the floor's votes to those of the level with most. Chosen.
constexpr double kMinVoteShare = 0.35;

/// Standard deviation of a line's direction, from the two rotations of U that change it.
double direction_sigma(const PlacedLine& line) {
  return std::sqrt(std::max(0.0, line.covariance(0, 0) + line.covariance(2, 2)));
}

/// Deviation from parallel of a built edge and of a shared direction, as shares of kUpright_deg.
constexpr double kEdgeShare = 0.3, kSharedShare = 0.1;

/// Directions for the vertical: the shared ones, and those of lines without a shared direction.
/// Lines of a shared direction have correlated errors, from the path that they were triangulated
/// from, and would outvote it by their number.
std::vector<SharedDirection> directions_of(const std::vector<PlacedLine>& lines,
                                           const std::vector<SharedDirection>& shared) {
  const double tolerance = kUpright_deg * kRadPerDeg;
  std::vector<SharedDirection> directions;
  for (const PlacedLine& line : lines) {
    const Eigen::Vector3d d = line.line_ref.direction();
    const double gate = std::max(tolerance, 2 * direction_sigma(line));
    if (std::any_of(shared.begin(), shared.end(),
                    [&](const SharedDirection& of) { return d.cross(of.d_ref).norm() < gate; }))
      continue;
    directions.push_back({d, std::hypot(direction_sigma(line), kEdgeShare * tolerance)});
  }
  for (const SharedDirection& direction : shared)
    directions.push_back(
        {direction.d_ref, std::hypot(direction.sigma_rad, kSharedShare * tolerance)});
  return directions;
}

/// The vertical with most support: orthogonal to horizontal lines, along vertical lines, with a
/// gate that narrows. Nothing if it is undetermined.
std::optional<Eigen::Vector3d> vertical(const std::vector<SharedDirection>& directions,
                                        const Eigen::Vector3d& down_guess,
                                        const FloorFromLinesOptions& options) {
  Eigen::Vector3d down = down_guess;
  for (const double gate_deg :
       {options.max_tilt_deg, options.max_tilt_deg / 2, options.max_tilt_deg / 4, kUpright_deg}) {
    const double gate = std::sin(gate_deg * kRadPerDeg);
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    int used = 0;
    for (const auto& [d, sigma] : directions) {
      const double along = std::abs(d.dot(down)), across = d.cross(down).norm();
      const double off = std::min(along, across) / std::max(gate, sigma);
      if (!(off < 1)) continue;
      const double w = std::pow(1 - off * off, 2) / (sigma * sigma);  // Tukey
      if (across < along)
        A += w * (Eigen::Matrix3d::Identity() - d * d.transpose());
      else
        A += w * d * d.transpose();
      ++used;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(A);
    if (used < 2 || !(eigen.eigenvalues()[1] > 1 / (kUpright_deg * kRadPerDeg)))
      return std::nullopt;
    const Eigen::Vector3d v = eigen.eigenvectors().col(0);
    down = v.dot(down) < 0 ? Eigen::Vector3d(-v) : v;
  }
  if (down.dot(down_guess) < std::cos(options.max_tilt_deg * kRadPerDeg)) return std::nullopt;
  return down;
}

/// A point whose height is that of a line, or of an upright's lower end, from the camera's centre.
struct Mark {
  LineId id;
  Eigen::Vector3d point;
  double sigma = 0;  ///< standard deviation of its height
};

/// The mark at a pixel of a line. `end_px`: standard deviation of the point along the line's image;
/// it does not change the height of a horizontal line.
std::optional<Mark> mark_at(const Camera& camera, const SE3& T_ref_cam, const PlacedLine& line,
                            const Eigen::Vector2d& px, const Eigen::Vector3d& down, double end_px) {
  const auto at = [&](const Line3& line_ref,
                      const Eigen::Vector2d& where) -> std::optional<Eigen::Vector3d> {
    const auto z = depth_on_line(camera, T_ref_cam, line_ref, where);
    const Eigen::Vector3d ray((where.x() - camera.cx) / camera.fx,
                              (where.y() - camera.cy) / camera.fy, 1);
    if (!z || !(*z > 0)) return std::nullopt;
    return T_ref_cam.rotation() * Eigen::Vector3d(*z * ray);
  };
  // Step of the difference quotient. Chosen, well above rounding.
  constexpr double kStep = 1e-6;
  const auto point = at(line.line_ref, px);
  if (!point) return std::nullopt;
  Eigen::Vector4d J;
  for (int k = 0; k < 4; ++k) {
    const auto moved = at(line.line_ref.plus(kStep * Eigen::Vector4d::Unit(k)), px);
    if (!moved) return std::nullopt;
    J[k] = (*moved - *point).dot(down) / kStep;
  }
  const auto slid = at(line.line_ref, px + line.seen.direction());
  const double by_end = slid ? end_px * (*slid - *point).dot(down) : 0;
  return Mark{line.id, *point,
              std::hypot(by_end, std::sqrt(std::max(0.0, J.dot(line.covariance * J))))};
}

std::vector<Mark> marks_of(const Camera& camera, const SE3& T_ref_cam,
                           const std::vector<PlacedLine>& lines, const Eigen::Vector3d& down) {
  constexpr double kBorder_px = 8;  // an edge that ends there continues outside
  std::vector<Mark> marks;
  const double gate = std::sin(kUpright_deg * kRadPerDeg);
  for (const PlacedLine& line : lines) {
    const Eigen::Vector3d d = line.line_ref.direction();
    const double sigma = direction_sigma(line);
    if (sigma > 2 * gate) continue;
    const bool upright = d.cross(down).norm() < std::max(gate, 2 * sigma);
    const bool level = std::abs(d.dot(down)) < std::max(gate, 2 * sigma);
    if (upright == level) continue;
    if (level) {
      if (const auto m = mark_at(camera, T_ref_cam, line, line.seen.middle(), down, 0))
        marks.push_back(*m);
      continue;
    }
    const auto a = mark_at(camera, T_ref_cam, line, line.seen.start, down, kFloorContact_px);
    const auto b = mark_at(camera, T_ref_cam, line, line.seen.end, down, kFloorContact_px);
    if (!a || !b) continue;
    const bool first = a->point.dot(down) > b->point.dot(down);
    const Eigen::Vector2d& end = first ? line.seen.start : line.seen.end;
    if (camera.contains(end, kBorder_px)) marks.push_back(first ? *a : *b);
  }
  return marks;
}

double sigma_of(const Mark& mark, double height) {
  return std::hypot(mark.sigma, 1.5 * kUnevenness * height);
}

/// The marks of one level: those near a height, then near their own mean, until it converges. The
/// initial height has no weight, or the lowest level would be the lower half of one.
std::vector<Mark> level_at(const std::vector<Mark>& marks, double height,
                           const Eigen::Vector3d& down) {
  // Iterations at most. Chosen.
  constexpr int kRounds = 10;
  std::vector<Mark> level;
  for (int round = 0; round < kRounds; ++round) {
    level.clear();
    double sum = 0, weights = 0;
    for (const Mark& m : marks) {
      const double sigma = sigma_of(m, height), h = m.point.dot(down);
      if (std::abs(h - height) > 2 * sigma) continue;
      level.push_back(m);
      sum += h / (sigma * sigma), weights += 1 / (sigma * sigma);
    }
    if (level.empty()) break;
    const double mean = sum / weights;
    const bool stays = std::abs(mean - height) < 1e-4 * height;
    height = mean;
    if (stays) break;
  }
  return level;
}

/// The marks of the lowest level with enough support.
std::vector<Mark> lowest_level(const std::vector<Mark>& marks, const Eigen::Vector3d& down,
                               const FloorFromLinesOptions& options) {
  std::vector<std::vector<Mark>> levels;
  std::size_t most = 0;
  for (const Mark& m : marks) {
    const double height = m.point.dot(down);
    if (!(height > 0) || m.sigma > kMaxVoteSigma * height) continue;
    levels.push_back(level_at(marks, height, down));
    most = std::max(most, levels.back().size());
  }
  const double needed =
      std::max<double>(options.min_lines, kMinVoteShare * static_cast<double>(most));
  std::vector<Mark> best;
  double lowest = 0;
  for (std::vector<Mark>& level : levels) {
    if (static_cast<double>(level.size()) < needed) continue;
    double mean = 0;
    for (const Mark& m : level) mean += m.point.dot(down) / static_cast<double>(level.size());
    if (mean <= lowest) continue;
    lowest = mean;
    best = std::move(level);
  }
  return best;
}

/// The plane n . p = h of a level, n = down + x e1 + y e2 with e1, e2 orthogonal to down and each
/// other.
struct FloorPlane {
  Eigen::Vector3d n;
  double h = 0;
  Eigen::Matrix3d information;  ///< information of (x, y, h)
};

/// Reweighted least squares (Huber) over the level's marks, n . p = h, over vertical lines, n x d =
/// 0, and over horizontal lines, n . d = 0.
FloorPlane fit_plane(const std::vector<Mark>& level, const std::vector<SharedDirection>& directions,
                     const Eigen::Vector3d& down) {
  const Eigen::Vector3d e1 = down.unitOrthogonal(), e2 = down.cross(e1);
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  // parameters of n, and h
  Eigen::Matrix3d H;
  // Iterations at most. Chosen.
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    H = 1e-9 * Eigen::Matrix3d::Identity();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    const auto add = [&](const Eigen::Vector3d& row, double value, double sigma) {
      const double r = (row.dot(x) - value) / sigma;
      const double w = (round == 0 || std::abs(r) < 2 ? 1 : 2 / std::abs(r)) / (sigma * sigma);
      H += w * row * row.transpose();
      g += w * value * row;
    };
    for (const Mark& m : level)
      add({e1.dot(m.point), e2.dot(m.point), -1}, -down.dot(m.point),
          std::hypot(m.sigma, kUnevenness * down.dot(m.point)));
    const double gate = std::sin(kUpright_deg * kRadPerDeg);
    for (const auto& [d, sigma] : directions) {
      if (d.cross(down).norm() < gate) {
        const double sign = d.dot(down) < 0 ? -1 : 1;
        add({1, 0, 0}, sign * e1.dot(d), sigma);
        add({0, 1, 0}, sign * e2.dot(d), sigma);
      } else if (std::abs(d.dot(down)) < gate) {
        add({e1.dot(d), e2.dot(d), 0}, -down.dot(d), sigma);
      }
    }
    x = H.ldlt().solve(g);
  }
  return {down + x[0] * e1 + x[1] * e2, x[2], H};
}

}  // namespace

FloorFromLines floor_from_lines(const Camera& camera, const SE3& T_ref_cam,
                                const std::vector<PlacedLine>& lines,
                                const FloorFromLinesOptions& options,
                                const std::vector<SharedDirection>& shared) {
  options.check();
  FloorFromLines result;
  const auto directions = directions_of(lines, shared);
  const auto down = vertical(
      directions, T_ref_cam.rotation() * Eigen::Vector3d(Eigen::Vector3d::UnitY()), options);
  if (!down) {
    result.outcome =
        Outcome::failure(Outcome::Code::kTooFewData, "the lines do not determine a vertical");
    return result;
  }
  const std::vector<Mark> floor =
      lowest_level(marks_of(camera, T_ref_cam, lines, *down), *down, options);
  if (static_cast<int>(floor.size()) < options.min_lines) {
    result.outcome = Outcome::failure(Outcome::Code::kNoConsensus,
                                      "no level below the camera has enough support");
    return result;
  }
  const FloorPlane plane = fit_plane(floor, directions, *down);
  result.down_ref = plane.n.normalized();
  result.height = plane.h / plane.n.norm();
  result.sigma_height = std::sqrt(std::max(0.0, plane.information.inverse()(2, 2)));
  for (const Mark& m : floor) result.on_floor.push_back(m.id);
  std::sort(result.on_floor.begin(), result.on_floor.end());
  result.on_floor.erase(std::unique(result.on_floor.begin(), result.on_floor.end()),
                        result.on_floor.end());
  result.outcome = plane.n.allFinite() && std::isfinite(plane.h) && result.height > 0
                       ? Outcome::ok()
                       : Outcome::failure(Outcome::Code::kDegenerate, "no plane fits the level");
  return result;
}

}  // namespace placegraph
