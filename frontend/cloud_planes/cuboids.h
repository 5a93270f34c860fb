#pragma once
#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/graph/geometry/se3.h>

#include <array>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Side from which a cuboid is seen.
enum class CuboidKind {
  kBox,   ///< observed from outside: its faces meet at convex edges
  kRoom,  ///< observed from inside: walls, floor and ceiling that meet at concave edges
};

/// Options of find_cuboids.
struct CuboidOptions {
  /// Maximum deviation of the angle between two faces from a right one.
  double max_off_right_deg = 3;
  /// Maximum distance of two faces from their common edge, as a share of the depth.
  double gap = 0.05;
  double overlap = 0.3;  ///< minimum overlap at the edge, as a share of the shorter face along it
  int min_box_faces = 2;
  int min_room_faces = 3;
  void check() const;
};
void visit(OptionVisitor& field, CuboidOptions& options);

/// Visible part of a box or a room.
struct Cuboid {
  CuboidKind kind = CuboidKind::kBox;
  SE3 T_sensor_cuboid;                             ///< origin at the centre, axes along edges
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< half the side lengths [m]
  /// Planes of its sides -x, +x, -y, +y, -z, +z, as indices of the planes found; -1: the side is
  /// not visible, and the cuboid ends where the adjacent faces do.
  std::array<int, 6> faces{-1, -1, -1, -1, -1, -1};
  int points = 0;  ///< number of points of its faces
};

/// Finds cuboids among the planes of a cloud that was taken from the origin.
///
/// Two planes belong together if they are at right angles, touch along a common edge and are wholly
/// on one side of each other, behind for a box, in front for a room; connected planes that fit one
/// frame become one cuboid. A plane is a side of at most one box and one room. The cuboid with the
/// most points comes first. Throws ArgumentError if labels and points do not agree, or the cloud
/// was not taken from the origin: then the visible side of a plane is unknown.
[[nodiscard]] std::vector<Cuboid> find_cuboids(const PointCloud& cloud,
                                               const CloudPlanesResult& planes,
                                               const CuboidOptions& options);

}  // namespace placegraph
