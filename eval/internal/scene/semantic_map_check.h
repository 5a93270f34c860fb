#pragma once
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/internal/scene/labelled_mesh.h>
#include <placegraph/graph/scene/semantic_map.h>

#include <cstdint>
#include <vector>

namespace placegraph {

/// How the cells of a semantic map agree with what truly stands there.
struct SemanticMapCheck {
  struct Score {
    std::int64_t cells = 0;    ///< known and judged
    std::int64_t right = 0;    ///< of a class that stands in the cell
    std::int64_t most = 0;     ///< of the class that has most surface in it
    std::int64_t nothing = 0;  ///< nothing stands within the tolerance: wrong
    double share() const {
      return cells > 0 ? static_cast<double>(right) / static_cast<double>(cells) : 0;
    }
  };
  Score all;                  ///< every known cell
  Score top;                  ///< the cells of the map's top view
  std::int64_t unjudged = 0;  ///< known cells where something stands that the map has no class for
  /// By the class that has most surface, row, and the cell's; classes of the map.
  std::vector<std::int64_t> confusion;
};

/// Holds the known cells of `map` against the surfaces of `truth`, which passes through a cell or
/// not; `T_truth_map` is not fitted here. Where no surface passes through a cell, the nearest
/// within `tolerance_m` stands for it. Classes are compared by name.
SemanticMapCheck check_semantic_map(const SemanticMap& map, const LabelledMesh& truth,
                                    const SE3& T_truth_map, double tolerance_m = 0.5);

}  // namespace placegraph
