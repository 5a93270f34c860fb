#include <placegraph/frontend/lines/line_feature.h>
#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/line_descriptor/descriptor.hpp>

namespace placegraph {
namespace {

/// Maximum Hamming distance of the descriptors [bits of 256]. Chosen; as for points of a loop.
constexpr int kMaxLineDistance = 60;
/// Maximum distance of a segment from its predicted line. Chosen.
constexpr double kLineGate_px = 9;
/// Maximum angle between a segment and its predicted line. Chosen.
constexpr double kMaxLineAngle_deg = 8;
/// Minimum share of the shorter segment that the other covers. Chosen.
constexpr double kMinLineOverlap = 0.3;

using Eigen::Vector2d;
using Eigen::Vector3d;

cv::line_descriptor::KeyLine key_line_of(const LineSegment& segment, int number) {
  cv::line_descriptor::KeyLine key;
  key.class_id = number;
  key.octave = 0;
  key.startPointX = key.sPointInOctaveX = static_cast<float>(segment.start.x());
  key.startPointY = key.sPointInOctaveY = static_cast<float>(segment.start.y());
  key.endPointX = key.ePointInOctaveX = static_cast<float>(segment.end.x());
  key.endPointY = key.ePointInOctaveY = static_cast<float>(segment.end.y());
  const Vector2d along = segment.vector(), middle = segment.middle();
  key.angle = static_cast<float>(std::atan2(along.y(), along.x()));
  key.lineLength = static_cast<float>(along.norm());
  key.numOfPixels = static_cast<int>(std::lround(along.cwiseAbs().maxCoeff())) + 1;
  key.pt = cv::Point2f(static_cast<float>(middle.x()), static_cast<float>(middle.y()));
  key.size = static_cast<float>(std::abs(along.x() * along.y()));
  key.response = key.lineLength;
  return key;
}

/// Projection of b's part of a line into a's image; nothing if an end has no image there.
std::optional<LineSegment> expected_in(const Camera& camera, const SE3& T_a_b,
                                       const LineFeature& seen_by_b) {
  std::array<Vector2d, 2> ends;
  int k = 0;
  for (const Vector2d& px : {seen_by_b.segment.start, seen_by_b.segment.end}) {
    const auto ray = camera.unproject(px);
    const auto depth = depth_on_line(camera, SE3(), *seen_by_b.line_cam, px);
    if (!ray || !depth || !(*depth > 0)) return std::nullopt;
    const auto seen = camera.project(T_a_b * Vector3d(*depth * *ray));
    if (!seen) return std::nullopt;
    ends[static_cast<std::size_t>(k++)] = *seen;
  }
  const LineSegment segment{ends[0], ends[1]};
  if (!(segment.length() > 1)) return std::nullopt;
  return segment;
}

bool lies_along(const LineSegment& seen, const LineSegment& expected) {
  // Both segments have a polarity: the same edge has the same direction.
  if (seen.direction().dot(expected.direction()) < std::cos(deg_to_rad(kMaxLineAngle_deg)))
    return false;
  if (std::abs(expected.offset_of(seen.middle())) > kLineGate_px) return false;
  const double from = expected.position_of(seen.start), to = expected.position_of(seen.end);
  const double common =
      std::min(std::max(from, to), expected.length()) - std::max(std::min(from, to), 0.0);
  return common >= kMinLineOverlap * std::min(seen.length(), expected.length());
}

}  // namespace

std::vector<BinaryDescriptor> describe_segments(const Image& image,
                                                const std::vector<LineSegment>& segments) {
  require(image.type() == CV_8UC1, "describe_segments: CV_8UC1 needed");
  if (segments.empty()) return {};
  std::vector<cv::line_descriptor::KeyLine> lines;
  for (const LineSegment& segment : segments) {
    const auto inside = [&](const Vector2d& px) {
      return px.x() >= -0.5 && px.y() >= -0.5 && px.x() <= image.cols - 0.5 &&
             px.y() <= image.rows - 0.5;
    };
    require(inside(segment.start) && inside(segment.end) && segment.length() > 0,
            "describe_segments: a segment lies outside the image or has no length");
    lines.push_back(key_line_of(segment, static_cast<int>(lines.size())));
  }
  cv::Mat rows;
  cv::line_descriptor::BinaryDescriptor::createBinaryDescriptor()->compute(image, lines, rows);
  require(rows.rows == static_cast<int>(segments.size()) && rows.cols == 32,
          "describe_segments: not every segment got a descriptor");
  std::vector<BinaryDescriptor> descriptors(segments.size());
  for (int i = 0; i < rows.rows; ++i)
    std::memcpy(descriptors[static_cast<std::size_t>(i)].data(), rows.ptr(i), 32);
  return descriptors;
}

std::vector<LineFeatureMatch> match_lines_guided(const Camera& camera,
                                                 const std::vector<LineFeature>& a,
                                                 const std::vector<LineFeature>& b,
                                                 const SE3& T_b_a) {
  const SE3 T_a_b = T_b_a.inverse();
  struct Best {
    int b = -1, distance = 0;
  };
  std::vector<Best> best_of(a.size());
  for (std::size_t j = 0; j < b.size(); ++j) {
    if (!b[j].line_cam) continue;
    const auto expected = expected_in(camera, T_a_b, b[j]);
    if (!expected) continue;
    int best = -1, least = kMaxLineDistance + 1;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!lies_along(a[i].segment, *expected)) continue;
      const int distance = hamming_distance(a[i].descriptor, b[j].descriptor);
      if (distance < least) {
        best = static_cast<int>(i);
        least = distance;
      }
    }
    if (best < 0) continue;
    Best& held = best_of[static_cast<std::size_t>(best)];
    if (held.b < 0 || least < held.distance) held = {static_cast<int>(j), least};
  }
  std::vector<LineFeatureMatch> matches;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (best_of[i].b >= 0) matches.push_back({static_cast<int>(i), best_of[i].b});
  return matches;
}

}  // namespace placegraph
