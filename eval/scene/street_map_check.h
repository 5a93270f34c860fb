#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/scene/labelled_mesh.h>
#include <placegraph/graph/scene/street_map.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// Agreement of the cells of a street map with the true surfaces.
struct StreetMapCheck {
  struct Score {
    std::int64_t cells = 0;    ///< known cells that were judged
    std::int64_t right = 0;    ///< cells with the class of a surface in the cell
    std::int64_t most = 0;     ///< cells with the class of the largest surface in the cell
    std::int64_t nothing = 0;  ///< wrong cells: no surface within the tolerance
    double share() const {
      return cells > 0 ? static_cast<double>(right) / static_cast<double>(cells) : 0;
    }
  };
  Score all;                  ///< every known cell
  Score top;                  ///< the cells of the map's top view
  std::int64_t unjudged = 0;  ///< known cells at surfaces of classes that the map does not have
  /// Confusion matrix over the classes of the map: row: class of the largest surface, column: class
  /// of the cell.
  std::vector<std::int64_t> confusion;
};

/// Compares the known cells of `map` with the surfaces of `truth` that pass through them.
/// `T_truth_map` is not fitted here. If no surface passes through a cell, the nearest one within
/// `tolerance_m` is used. Classes are compared by name.
StreetMapCheck check_street_map(const StreetMap& map, const LabelledMesh& truth,
                                const SE3& T_truth_map, double tolerance_m = 0.5);

}  // namespace placegraph
