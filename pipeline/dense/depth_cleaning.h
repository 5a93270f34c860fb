#pragma once
#include <placegraph/pipeline/dense/keyframe_depth.h>

namespace placegraph {

/// Removes depths whose standard deviation is more than this share of them.
void limit_uncertainty(KeyframeDepth& depth, double most_share);

/// Removes depths beside a depth edge, which mix both of its surfaces.
/// On a plane the inverse depth is linear in the pixel, however slanted the plane is: an edge is
/// where its second difference in a row or column exceeds three standard deviations and a share
/// `bend` of it.
void remove_edges(KeyframeDepth& depth, double bend);

/// Fits planes to the inverse depths around the pixels, which gives the normals.
/// Depths with less than half of the window of `radius_px` around them, and surfaces that the
/// viewing ray meets at less than `least_cosine` to the normal, are removed.
void estimate_normals(KeyframeDepth& depth, int radius_px, double least_cosine);

}  // namespace placegraph
