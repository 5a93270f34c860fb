#pragma once
#include <placegraph/frontend/cloud_planes/super_points.h>

#include <vector>

namespace placegraph {

/// Group of super-points with its best fitting plane.
struct PlanarSegment {
  std::vector<int> cells;  ///< ascending
  PlaneSums sums;
  FittedPlane plane;
};

PlanarSegment make_segment(std::vector<int> cells, const SuperPoints& cloud, const FitModel& model);

/// Contacts of each cell, as indices of `cloud.contacts`.
std::vector<std::vector<int>> contacts_of_cells(const SuperPoints& cloud);

/// Whether one plane fits all cells of a segment: all points together, and each cell by itself.
bool is_one_plane(const PlanarSegment& segment, const SuperPoints& cloud, const FitModel& model);

/// Cuts the planar super-points into segments.
///
/// Parts connected by affinities exp(-dissimilarity / 8) are divided at their best normalized cut
/// as long as they are not planar, the cut is below `max_cut` and it follows a line where the
/// surface bends more than elsewhere. A surface with uniform curvature stays in one piece.
std::vector<PlanarSegment> cut_into_segments(const SuperPoints& cloud, const FitModel& model,
                                             double max_cut);

/// Merges segments whose points are on one plane, the larger ones first.
///
/// The condition is that the increase in cost of one plane for both is within the noise and the
/// allowed deviation. They need not touch.
std::vector<PlanarSegment> merge_coplanar(std::vector<PlanarSegment> segments,
                                          const SuperPoints& cloud, const FitModel& model);

}  // namespace placegraph
