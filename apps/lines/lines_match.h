#pragma once
#include <placegraph/frontend/internal/segments/segment_detector.h>
#include <placegraph/frontend/internal/segments/segment_matcher.h>

#include <string>
#include <vector>

namespace placegraph::apps {

struct LinesMatchArguments {
  std::vector<std::string> images;        ///< two
  std::vector<std::string> segments;      ///< two files of their segments; empty: detected
  std::vector<std::string> segments_out;  ///< two files to write the segments to; empty: none
  std::string out;                        ///< file of the matches, `i j` a line
  SegmentDetectorOptions detector;        ///< where segments are detected
  SegmentMatcherOptions matcher;
  bool force = false;  ///< overwrite what is written
};

struct LinesMatchResult {
  std::string pair;  ///< both images, for people
  std::string out;
  std::vector<LineSegment> a, b;      ///< segments of the images
  std::vector<SegmentMatch> matches;  ///< indices into both
};

/// `placegraph lines match`: finds the same straight edges in two images and writes which they are.
/// Throws ArgumentError, FileError, and NoAnswer where nothing joins the images; then nothing is
/// written.
LinesMatchResult lines_match(const LinesMatchArguments& arguments);

/// One line.
std::string to_text(const LinesMatchResult& result);

}  // namespace placegraph::apps
