#pragma once
#include <placegraph/io/exports/surface_ply.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph {

/// A scene of points, lines and surfaces for 3D viewers, in coordinates with x right, y down, z
/// forward.
struct GltfScene {
  /// Points of one colour each.
  struct Points {
    std::vector<Eigen::Vector3d> positions;            ///< positions
    std::vector<std::array<std::uint8_t, 3>> colours;  ///< red, green, blue of each
  };
  /// Lines of one colour.
  struct Lines {
    std::string name;                                   ///< name of the lines in the viewer
    std::array<double, 3> rgb{};                        ///< red, green, blue, in [0, 1]
    std::vector<std::vector<Eigen::Vector3d>> strips;   ///< polylines of two points or more
    std::vector<std::array<Eigen::Vector3d, 2>> pairs;  ///< single lines
  };
  std::string title;         ///< name of the scene
  Points points;             ///< points; may be empty
  std::vector<Lines> lines;  ///< lines; those without a strip and a pair are left out
  TriangleMesh surface;      ///< a surface; may be empty
};

/// Whether the numbers of a glTF file stand in the same file as bytes or as text.
enum class GltfForm {
  kGlb,  ///< binary container, .glb
  kGltf  ///< JSON with the bytes in base64, .gltf
};

/// A glTF 2.0 file of a scene, which it shows with y up. Positions are float.
/// Throws ArgumentError if there are not as many colours as points.
std::string to_gltf(const GltfScene& scene, GltfForm form);

}  // namespace placegraph
