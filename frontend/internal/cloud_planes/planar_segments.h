#pragma once
#include <placegraph/frontend/internal/cloud_planes/super_points.h>

#include <vector>

namespace placegraph {

/// Super-points taken together, with the one plane that suits all of them best.
struct PlanarSegment {
  std::vector<int> cells;  ///< ascending
  PlaneSums sums;
  FittedPlane plane;
};

PlanarSegment make_segment(std::vector<int> cells, const SuperPoints& cloud, const FitModel& model);

/// Contacts of each cell, as numbers of `cloud.contacts`.
std::vector<std::vector<int>> contacts_of_cells(const SuperPoints& cloud);

/// Whether one plane does for all cells of a segment: all points together, and each cell by itself.
bool is_one_plane(const PlanarSegment& segment, const SuperPoints& cloud, const FitModel& model);

/// Cuts the planar super-points into segments: parts that hang together by affinities
/// exp(-dissimilarity / 8) are halved at their best normalized cut for as long as they are no
/// plane, the cut is below `max_cut` and it runs where the surface bends more than elsewhere. A
/// surface that is curved everywhere alike stays in one piece.
std::vector<PlanarSegment> cut_into_segments(const SuperPoints& cloud, const FitModel& model,
                                             double max_cut);

/// Takes segments together, the larger ones first, whose points have one plane: what one plane for
/// both costs either is what noise and bending allow. They need not touch.
std::vector<PlanarSegment> merge_coplanar(std::vector<PlanarSegment> segments,
                                          const SuperPoints& cloud, const FitModel& model);

}  // namespace placegraph
