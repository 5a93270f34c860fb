#pragma once
#include <placegraph/frontend/segments/segment_detector.h>

#include <string>
#include <vector>

namespace placegraph::apps {

struct LinesDetectArguments {
  std::string image;
  std::string out;  ///< file for the segments, `u1 v1 u2 v2` per line [px]
  SegmentDetectorOptions options;
  bool force = false;  ///< overwrite `out`
};

struct LinesDetectResult {
  std::string image, out;
  std::vector<LineSegment> segments;  ///< as written, the brighter side on the right
};

/// Detects the straight edges of an image and writes them: `placegraph image lines`.
/// Throws ArgumentError, FileError, and NoResult if there are none; then nothing is written.
LinesDetectResult lines_detect(const LinesDetectArguments& arguments);

/// One line.
std::string to_text(const LinesDetectResult& result);

}  // namespace placegraph::apps
