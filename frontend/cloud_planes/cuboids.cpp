#include <placegraph/frontend/cloud_planes/cuboids.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/quantile.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace placegraph {
namespace {

/// Share of points that may be on the wrong side, or beyond an end: labels are wrong at some edges.
constexpr double kStray = 0.05;

/// A plane with some of its points.
struct Face {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< towards the sensor
  double offset = 0;                                  ///< height = normal . X + offset
  std::vector<Eigen::Vector3d> points;
  int count = 0;     ///< number of all its points
  double depth = 0;  ///< mean distance of the points [m]

  double height(const Eigen::Vector3d& X) const { return normal.dot(X) + offset; }
};

std::vector<Face> faces_of(const PointCloud& cloud, const CloudPlanesResult& found) {
  // Points of a face: the cost. Chosen.
  constexpr int kMostPoints = 2000;
  std::vector<Face> faces(found.planes.size());
  for (std::size_t k = 0; k < faces.size(); ++k) {
    faces[k].normal = -found.planes[k].plane.normal;
    faces[k].offset = found.planes[k].plane.distance_m;
  }
  std::vector<int> seen(faces.size());
  const auto counts = [&](std::size_t i) {
    return found.labels[i] > 0 && cloud.points[i].allFinite();
  };
  for (std::size_t i = 0; i < found.labels.size(); ++i) {
    require(found.labels[i] <= static_cast<int>(faces.size()),
            "find_cuboids: a label without a plane: " + std::to_string(found.labels[i]));
    if (counts(i)) ++faces[static_cast<std::size_t>(found.labels[i]) - 1].count;
  }
  for (std::size_t i = 0; i < found.labels.size(); ++i) {
    if (!counts(i)) continue;
    const auto k = static_cast<std::size_t>(found.labels[i]) - 1;
    if (seen[k]++ % (1 + faces[k].count / kMostPoints) == 0)
      faces[k].points.push_back(cloud.points[i]);
  }
  for (Face& face : faces) {
    for (const Eigen::Vector3d& X : face.points) face.depth += X.norm();
    if (!face.points.empty()) face.depth /= static_cast<double>(face.points.size());
  }
  return faces;
}

/// Position of two faces relative to each other.
struct Relation {
  bool right = false, opposite = false;  ///< relation of their normals
  bool behind = false, before = false;   ///< each is wholly behind the other, or in front of it
  double edge = 0;                       ///< overlap of both at a common edge [m], 0 without one
};

/// Part of a face near the plane of another, along the edge between them.
struct EdgeSide {
  bool there = false;
  double low = 0, high = 0;  ///< [m]
  double length = 0;         ///< length of the whole face along the edge [m]
};

EdgeSide edge_side(const Face& face, const Face& other, const Eigen::Vector3d& along, double gap) {
  std::vector<double> near, all;
  for (const Eigen::Vector3d& X : face.points) {
    all.push_back(along.dot(X));
    if (std::abs(other.height(X)) < gap * X.norm()) near.push_back(all.back());
  }
  // Points with quantiles. Chosen.
  constexpr std::size_t kFewest = 5;
  if (near.size() < kFewest) return {};
  return {true, quantile_of(near, kStray), quantile_of(near, 1 - kStray),
          quantile_of(all, 1 - kStray) - quantile_of(all, kStray)};
}

Relation relation_of(const Face& a, const Face& b, const CloudNoise& noise,
                     const CuboidOptions& options) {
  Relation relation;
  const double cosine = a.normal.dot(b.normal),
               off = std::sin(options.max_off_right_deg * kRadPerDeg);
  relation.right = std::abs(cosine) < off;
  relation.opposite = cosine < -std::cos(options.max_off_right_deg * kRadPerDeg);
  if ((!relation.right && !relation.opposite) || a.points.empty() || b.points.empty())
    return relation;
  std::vector<double> heights_a, heights_b;
  for (const Eigen::Vector3d& X : a.points) heights_a.push_back(b.height(X));
  for (const Eigen::Vector3d& X : b.points) heights_b.push_back(a.height(X));
  constexpr double kSigmas = 4, kBend = 0.01;  // planes of real objects bend
  const double depth = std::max(a.depth, b.depth);
  const double slack = kSigmas * noise.sigma(depth) + kBend * depth;
  relation.behind =
      quantile_of(heights_a, 1 - kStray) < slack && quantile_of(heights_b, 1 - kStray) < slack;
  relation.before =
      quantile_of(heights_a, kStray) > -slack && quantile_of(heights_b, kStray) > -slack;
  if (!relation.right) return relation;
  const Eigen::Vector3d along = a.normal.cross(b.normal).normalized();
  const EdgeSide of_a = edge_side(a, b, along, options.gap);
  const EdgeSide of_b = edge_side(b, a, along, options.gap);
  if (!of_a.there || !of_b.there) return relation;
  const double common = std::min(of_a.high, of_b.high) - std::max(of_a.low, of_b.low);
  if (common > options.overlap * std::min(of_a.length, of_b.length)) relation.edge = common;
  return relation;
}

/// Connected faces by edges of one kind, the longest edges first.
std::vector<std::vector<int>> groups_of(const std::vector<std::vector<Relation>>& relations,
                                        CuboidKind kind) {
  const int n = static_cast<int>(relations.size());
  const auto at = [&](int a, int b) -> const Relation& {
    return relations[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  };
  const auto agree = [&](int a, int b) {
    const Relation& r = at(a, b);
    return kind == CuboidKind::kBox ? r.right && r.behind : (r.right || r.opposite) && r.before;
  };
  std::vector<std::pair<int, int>> edges;
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      if (agree(a, b) && at(a, b).edge > 0) edges.emplace_back(a, b);
  std::stable_sort(edges.begin(), edges.end(), [&](const auto& e, const auto& f) {
    return at(e.first, e.second).edge > at(f.first, f.second).edge;
  });
  std::vector<std::vector<int>> groups(static_cast<std::size_t>(n));
  std::vector<int> of(static_cast<std::size_t>(n));
  std::iota(of.begin(), of.end(), 0);
  for (int a = 0; a < n; ++a) groups[static_cast<std::size_t>(a)] = {a};
  for (const auto& [a, b] : edges) {
    const int into = of[static_cast<std::size_t>(a)], from = of[static_cast<std::size_t>(b)];
    auto &kept = groups[static_cast<std::size_t>(into)],
         &joined = groups[static_cast<std::size_t>(from)];
    if (into == from) continue;
    const bool fit = std::all_of(kept.begin(), kept.end(), [&](int i) {
      return std::all_of(joined.begin(), joined.end(), [&](int j) { return agree(i, j); });
    });
    if (!fit) continue;
    for (const int j : joined) of[static_cast<std::size_t>(j)] = into;
    kept.insert(kept.end(), joined.begin(), joined.end());
    joined.clear();
  }
  return groups;
}

/// Rotation with axes nearest to the normals, each weighted by the number of points of its face;
/// the first two axes are those of the largest face and of the next that is not parallel to it.
SO3 frame_of(const std::vector<Face>& faces, const std::vector<int>& members) {
  const auto face = [&](int k) -> const Face& { return faces[static_cast<std::size_t>(k)]; };
  const Eigen::Vector3d first = face(members.front()).normal;
  Eigen::Matrix3d axes;
  axes.col(0) = first;
  for (const int k : members) {
    if (std::abs(face(k).normal.dot(first)) > 0.5) continue;
    axes.col(1) = (face(k).normal - first * first.dot(face(k).normal)).normalized();
    break;
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const int k : members) {
    Eigen::Index axis = 0;
    const Eigen::Vector3d along = axes.transpose() * face(k).normal;
    along.cwiseAbs().maxCoeff(&axis);
    const Eigen::Vector3d ideal = Eigen::Vector3d::Unit(axis) * (along[axis] > 0 ? 1 : -1);
    sum += face(k).count * face(k).normal * ideal.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if (U.determinant() * svd.matrixV().determinant() < 0) U.col(2) = -U.col(2);
  return SO3::from_matrix(U * svd.matrixV().transpose());
}

/// Nothing if the faces determine no extent, or two of them are one side.
std::optional<Cuboid> cuboid_of(const std::vector<Face>& faces, const std::vector<int>& members,
                                CuboidKind kind) {
  Cuboid cuboid;
  cuboid.kind = kind;
  const SO3 R = frame_of(faces, members);
  Eigen::Vector3d low, high;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d along = R.matrix().col(axis);
    std::vector<double> beside;
    std::optional<double> side[2];
    for (const int k : members) {
      const Face& face = faces[static_cast<std::size_t>(k)];
      std::vector<double> places;
      for (const Eigen::Vector3d& X : face.points) places.push_back(along.dot(X));
      const double rotated = along.dot(face.normal);
      if (std::abs(rotated) < 0.5) {
        beside.insert(beside.end(), places.begin(), places.end());
        continue;
      }
      const bool upper = (rotated > 0) == (kind == CuboidKind::kBox);
      if (side[upper]) return std::nullopt;
      side[upper] =
          std::accumulate(places.begin(), places.end(), 0.0) / static_cast<double>(places.size());
      cuboid.faces[static_cast<std::size_t>(2 * axis + upper)] = k;
    }
    if (beside.empty()) return std::nullopt;
    // Quantile of an end without a face. Chosen.
    constexpr double kEnd = 0.01;
    low[axis] = side[0] ? *side[0] : quantile_of(beside, kEnd);
    high[axis] = side[1] ? *side[1] : quantile_of(beside, 1 - kEnd);
    if (!(low[axis] < high[axis])) return std::nullopt;
  }
  for (const int k : members) cuboid.points += faces[static_cast<std::size_t>(k)].count;
  cuboid.half = 0.5 * (high - low);
  cuboid.T_sensor_cuboid = SE3(R, R * Eigen::Vector3d(0.5 * (low + high)));
  return cuboid;
}

}  // namespace

void CuboidOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, CuboidOptions& options) {
  field("max_off_right_deg", options.max_off_right_deg,
        "maximum deviation of the angle between two faces from a right one", {0.01, 10});
  field("gap", options.gap,
        "maximum distance of two faces from their common edge, share of the depth", {1e-4, 1});
  field("overlap", options.overlap,
        "minimum overlap at the edge, share of the shorter face along it", {0, 0.99});
  field("min_box_faces", options.min_box_faces, "minimum number of faces of a box", {2, 3});
  field("min_room_faces", options.min_room_faces, "minimum number of faces of a room", {2, 6});
}

std::vector<Cuboid> find_cuboids(const PointCloud& cloud, const CloudPlanesResult& planes,
                                 const CuboidOptions& options) {
  options.check();
  require(planes.labels.size() == cloud.points.size(),
          "find_cuboids: needs a label for each point");
  require(planes.from_origin, "find_cuboids: the cloud was not taken from the origin");
  const std::vector<Face> faces = faces_of(cloud, planes);
  std::vector<std::vector<Relation>> relations(faces.size(), std::vector<Relation>(faces.size()));
  for (std::size_t a = 0; a < faces.size(); ++a)
    for (std::size_t b = a + 1; b < faces.size(); ++b)
      relations[a][b] = relations[b][a] = relation_of(faces[a], faces[b], planes.noise, options);
  std::vector<Cuboid> cuboids;
  for (const auto& [kind, least] : {std::pair{CuboidKind::kBox, options.min_box_faces},
                                    std::pair{CuboidKind::kRoom, options.min_room_faces}})
    for (std::vector<int>& members : groups_of(relations, kind)) {
      if (static_cast<int>(members.size()) < least) continue;
      std::sort(members.begin(), members.end());  // planes are sorted, the largest first
      if (auto cuboid = cuboid_of(faces, members, kind)) cuboids.push_back(*cuboid);
    }
  std::stable_sort(cuboids.begin(), cuboids.end(),
                   [](const Cuboid& a, const Cuboid& b) { return a.points > b.points; });
  return cuboids;
}

}  // namespace placegraph
