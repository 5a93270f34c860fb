#pragma once
#include <placegraph/frontend/internal/cloud_planes/super_points.h>

#include <vector>

namespace placegraph {

/// A plane and what lies on it: label k of `labels` is planes[k], -1 is none.
struct PlaneLabels {
  std::vector<FittedPlane> planes;
  std::vector<int> labels;  ///< of each point
  std::vector<PlaneSums> sums;
};

/// Spreads labels from the points that planes were fitted to over all that are less than `sigmas`
/// deviations off, hang together with the plane and are on no piece of surface that faces
/// elsewhere; where two planes meet, each point takes the nearer. Planes are fitted anew to what
/// they got.
void spread_labels(const CloudPoints& points, const SuperPoints& cloud, double sigmas,
                   PlaneLabels& result);

/// Drops connected pieces of a label with fewer than `min_piece` points, and labels left with fewer
/// than `min_points`. `keep`, if given, receives for each plane left its former number.
void drop_small(const CloudPoints& points, int min_piece, int min_points, PlaneLabels& result,
                std::vector<int>* keep = nullptr);

/// Takes the points from labels of whose neighbours less than `least` have the same label: a slice
/// of points that fill a volume.
void drop_porous(const CloudPoints& points, double least, PlaneLabels& result);

/// Fits every plane to the points with its label; those that have none keep theirs.
void refit(const CloudPoints& points, PlaneLabels& result);

}  // namespace placegraph
