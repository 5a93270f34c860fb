#pragma once
#include <placegraph/frontend/internal/segments/segment_detector.h>

#include <string>
#include <vector>

namespace placegraph::apps {

struct LinesDetectArguments {
  std::string image;
  std::string out;  ///< file of the segments, `u1 v1 u2 v2` a line [px]
  SegmentDetectorOptions options;
  bool force = false;  ///< overwrite `out`
};

struct LinesDetectResult {
  std::string image, out;
  std::vector<LineSegment> segments;  ///< as written, the brighter side on the right
};

/// `placegraph lines detect`: finds the straight edges of an image and writes them. Throws
/// ArgumentError, FileError, and NoAnswer where there are none; then nothing is written.
LinesDetectResult lines_detect(const LinesDetectArguments& arguments);

/// One line.
std::string to_text(const LinesDetectResult& result);

}  // namespace placegraph::apps
