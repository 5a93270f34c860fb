#pragma once
#include <placegraph/frontend/internal/cloud_planes/cloud_planes.h>
#include <placegraph/graph/geometry/se3.h>

#include <array>
#include <vector>

namespace placegraph {

enum class CuboidKind {
  kBox,   ///< seen from outside: its faces meet at convex edges
  kRoom,  ///< seen from within: walls, floor and ceiling that meet at concave ones
};

struct CuboidOptions {
  double max_off_right_deg = 3;  ///< deviation of the angle between two faces from a right one
  double gap = 0.05;             ///< faces come this near to their common edge, share of the depth
  double overlap = 0.3;          ///< of them there, share of the shorter face along the edge
  int min_box_faces = 2;
  int min_room_faces = 3;
  void check() const;
};
void visit(OptionVisitor& field, CuboidOptions& options);

/// A box or a room, as far as it is seen.
struct Cuboid {
  CuboidKind kind = CuboidKind::kBox;
  SE3 T_sensor_cuboid;                             ///< origin in the middle, axes along edges
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< half its sides [m]
  /// The planes that its sides -x, +x, -y, +y, -z, +z are, indices into the planes found; -1: side
  /// not seen, there the cuboid ends where the faces beside it do.
  std::array<int, 6> faces{-1, -1, -1, -1, -1, -1};
  int points = 0;  ///< of its faces
};

/// Cuboids among the planes of a cloud that was taken from the origin: planes at right angles that
/// touch along a common edge and lie wholly on one side of each other, behind for a box, before for
/// a room; those that hang together this way and fit one frame become one. A plane is a side of one
/// box and of one room at most. The most points first. Throws ArgumentError if labels and points do
/// not fit, or the cloud was not taken from the origin: then nobody knows which side of a plane is
/// seen.
[[nodiscard]] std::vector<Cuboid> find_cuboids(const PointCloud& cloud,
                                               const CloudPlanesResult& planes,
                                               const CuboidOptions& options);

}  // namespace placegraph
