#pragma once
#include <placegraph/frontend/cloud_planes/planar_segments.h>
#include <placegraph/frontend/cloud_planes/planarity_model.h>

#include <vector>

namespace placegraph {

/// Computes the features of a segment.
///
/// Residuals relative to noise and flatness, their distribution and their decrease with a curved
/// surface, the spread of points and normals, and the border: whether the surface continues beyond
/// it at a small angle, as that of a slice of a curved surface. `contacts`: the result of
/// `contacts_of_cells`.
PlanarityFeatures planarity_features(const PlanarSegment& segment, const CloudPoints& points,
                                     const SuperPoints& cloud,
                                     const std::vector<std::vector<int>>& contacts);

}  // namespace placegraph
