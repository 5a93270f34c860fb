#pragma once
#include <placegraph/frontend/lines/line_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/geometry/line3.h>
#include <placegraph/graph/geometry/line_segment.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/measurements/landmark.h>

#include <optional>
#include <vector>

namespace placegraph {

/// A straight edge of a keyframe with its descriptor and, if known, its line in the camera frame.
struct LineFeature {
  LineSegment segment;
  BinaryDescriptor descriptor{};
  std::optional<Line3> line_cam;
};

/// Line band descriptors, 256 bits, of segments of a grey image (Zhang & Koch 2013, by OpenCV).
///
/// Throws ArgumentError if the image is not CV_8UC1 or a segment is outside it or has no length.
std::vector<BinaryDescriptor> describe_segments(const Image& image,
                                                const std::vector<LineSegment>& segments);

/// A match of two line features.
struct LineFeatureMatch {
  int a = 0, b = 0;  ///< indices into the two lists
};

/// Matches segments of a to lines of b near their projection, given the approximate pose T_b_a.
///
/// A match is the segment with the most similar descriptor near the projection of b's line,
/// parallel to it, and overlapping with the part that b observes. Each segment of a has at most one
/// partner; ascending in a.
std::vector<LineFeatureMatch> match_lines_guided(const Camera& camera,
                                                 const std::vector<LineFeature>& a,
                                                 const std::vector<LineFeature>& b,
                                                 const SE3& T_b_a);

}  // namespace placegraph
