#pragma once
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/segments/segment_matcher.h>

#include <string>
#include <vector>

namespace placegraph::apps {

struct LinesMatchArguments {
  std::vector<std::string> images;        ///< paths of the two images
  std::vector<std::string> segments;      ///< two files of their segments; empty: they are detected
  std::vector<std::string> segments_out;  ///< two files to write the segments to; empty: none
  std::string out;                        ///< file for the matches, `i j` per line
  SegmentDetectorOptions detector;        ///< used if segments are detected
  SegmentMatcherOptions matcher;
  bool force = false;  ///< overwrite the output files
};

struct LinesMatchResult {
  std::string pair;  ///< text that names both images
  std::string out;
  std::vector<LineSegment> a, b;      ///< segments of the two images
  std::vector<SegmentMatch> matches;  ///< matches as indices into `a` and `b`
};

/// Matches the straight edges of two images and writes the matches: `image match-lines`.
/// Throws ArgumentError, FileError, and NoResult if no edges match; then nothing is written.
LinesMatchResult lines_match(const LinesMatchArguments& arguments);

/// One line.
std::string to_text(const LinesMatchResult& result);

}  // namespace placegraph::apps
