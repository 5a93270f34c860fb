#include <placegraph/frontend/segments/edge_refinement.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/segments/segment_merging.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

std::vector<LineSegment> find_pieces(const Image& image) {
  const auto lsd = cv::createLineSegmentDetector(cv::LSD_REFINE_STD);
  std::vector<cv::Vec4f> found;
  lsd->detect(image, found);
  std::vector<LineSegment> pieces;
  for (const cv::Vec4f& s : found) pieces.push_back({{s[0], s[1]}, {s[2], s[3]}});
  return pieces;
}

bool on_border(const LineSegment& segment, const Image& image, double border_px) {
  const Eigen::Vector2d low = segment.start.cwiseMax(segment.end);
  const Eigen::Vector2d high =
      Eigen::Vector2d(image.cols - 1, image.rows - 1) - segment.start.cwiseMin(segment.end);
  return std::min(low.minCoeff(), high.minCoeff()) < border_px;
}

}  // namespace

std::vector<EdgeSegment> detect_segments(const Image& image,
                                         const SegmentDetectorOptions& options) {
  options.check();
  require(!image.empty() && image.type() == CV_8UC1, "detect_segments: grey image needed");
  const EdgeRefiner refiner(image);
  std::vector<EdgeSegment> edges;
  for (const LineSegment& piece : merge_segments(find_pieces(image))) {
    if (piece.length() < options.min_length_px || on_border(piece, image, options.border_px))
      continue;
    if (auto edge = refiner.refine(piece))
      if (edge->segment.length() >= options.min_length_px) edges.push_back(*edge);
  }
  std::stable_sort(edges.begin(), edges.end(), [](const EdgeSegment& x, const EdgeSegment& y) {
    return x.segment.length() > y.segment.length();
  });
  return edges;
}

std::vector<LineSegment> segments_of(const std::vector<EdgeSegment>& edges) {
  std::vector<LineSegment> segments;
  for (const EdgeSegment& edge : edges) segments.push_back(edge.segment);
  return segments;
}

}  // namespace placegraph
