#pragma once
#include <placegraph/frontend/internal/features/stereo_matcher.h>
#include <placegraph/frontend/internal/segments/edge_refinement.h>
#include <placegraph/frontend/internal/segments/segment_flow.h>
#include <placegraph/frontend/lines/line_options.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Where the right eye of a rectified pair sees edges of the left one. Disparities of points along
/// a segment, found by correlation of rows, lie on a straight line over its length (the inverse
/// depth of a line is affine along its image); the consensus of the samples places the segment in
/// the right eye, where it is aligned across and measured on the gradient, same polarity. Its ends
/// are those of its support there: only the infinite lines correspond. Nothing for edges that run
/// along the rows (the epipolar lines), are hidden from the right eye, or lie beyond infinity.
/// Images: CV_8UC1 of one size, else ArgumentError.
std::vector<std::optional<EdgeSegment>> match_stereo_segments(
    const Image& left, const Image& right, const std::vector<LineSegment>& segments_left,
    const StereoMatcherOptions& points, const EdgeRefinementOptions& refinement,
    const LineStereoOptions& options);

}  // namespace placegraph
