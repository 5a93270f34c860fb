#pragma once
#include <placegraph/io/exports/ply_points.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph {

/// A point of a surface.
struct DensePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< unit normal, towards the cameras
  std::array<std::uint8_t, 3> rgb{};                   ///< red, green, blue
  int pixels = 0;                                      ///< number of depths that it is the mean of
};

/// A surface of triangles, whose corners are counter-clockwise for the side that cameras saw.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> positions;          ///< positions of the vertices
  std::vector<Eigen::Vector3f> normals;            ///< their unit normals
  std::vector<std::array<std::uint8_t, 3>> rgb;    ///< their colours
  std::vector<std::array<std::int32_t, 3>> faces;  ///< the vertices of each triangle
};

/// A PLY file of points: float x y z nx ny nz, uchar red green blue, int pixels.
/// Comments stand in its header, one line each. Throws ArgumentError for a comment with a line end.
std::string to_ply(const std::vector<DensePoint>& points, NumberForm form,
                   const std::vector<std::string>& comments = {});

/// A PLY file of a mesh: vertices with float x y z nx ny nz and uchar red green blue, faces with
/// vertex_indices. Throws ArgumentError as the one of points.
std::string to_ply(const TriangleMesh& mesh, NumberForm form,
                   const std::vector<std::string>& comments = {});

}  // namespace placegraph
