#pragma once
#include <placegraph/frontend/cloud_planes/super_points.h>

#include <vector>

namespace placegraph {

/// Planes and the labels of points: label k of `labels` is planes[k], -1 is none.
struct PlaneLabels {
  std::vector<FittedPlane> planes;
  std::vector<int> labels;  ///< label of each point
  std::vector<PlaneSums> sums;
};

/// Extends the labels from the points of the fits to other points near the planes.
///
/// A point gets a label if it is less than `sigmas` standard deviations from the plane, connected
/// with its points and not on a piece of surface of another orientation; where two planes meet,
/// each point gets the nearer one. The planes are fitted again to their points.
void spread_labels(const CloudPoints& points, const SuperPoints& cloud, double sigmas,
                   PlaneLabels& result);

/// Drops connected pieces of a label with fewer than `min_piece` points, and labels with fewer than
/// `min_points` left. `keep`, if given, receives the former number of each remaining plane.
void drop_small(const CloudPoints& points, int min_piece, int min_points, PlaneLabels& result,
                std::vector<int>* keep = nullptr);

/// Removes the points from labels for which less than the share `least` of the neighbours have the
/// same label: slices of points that fill a volume.
void drop_porous(const CloudPoints& points, double least, PlaneLabels& result);

/// Fits every plane to the points with its label; planes without points are not changed.
void refit(const CloudPoints& points, PlaneLabels& result);

}  // namespace placegraph
