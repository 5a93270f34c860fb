#pragma once
#include <placegraph/graph/geometry/line_segment.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads line segments of an image as text, `u1 v1 u2 v2` [px] per line.
/// They are separated by blanks or tabs, `#` before a comment. Throws FileError "file:line: ..." if
/// a line is anything else or its segment has no length: the number of a line is the segment's, so
/// that none can be skipped.
std::vector<LineSegment> read_segments(const std::string& path);

/// The same from the first four columns of a table: further columns are not read.
std::vector<LineSegment> read_segment_columns(const std::string& path);

/// Writes segments with three decimals of a pixel. Throws FileError.
void write_segments(const std::string& path, const std::vector<LineSegment>& segments);

}  // namespace placegraph
