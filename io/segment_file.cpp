#include <fmt/format.h>
#include <placegraph/io/atomic_file.h>
#include <placegraph/io/segment_file.h>
#include <placegraph/io/text_file.h>

namespace placegraph {

std::vector<LineSegment> read_segments(const std::string& path) {
  TextFile file(path);
  std::vector<LineSegment> segments;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() != 4)
      file.fail("a segment has 4 numbers, u1 v1 u2 v2, not " + std::to_string(fields.size()));
    LineSegment segment;
    segment.start = {file.number(fields[0], "u1"), file.number(fields[1], "v1")};
    segment.end = {file.number(fields[2], "u2"), file.number(fields[3], "v2")};
    if (!(segment.length() > 0)) file.fail("the segment has no length");
    segments.push_back(segment);
  }
  return segments;
}

void write_segments(const std::string& path, const std::vector<LineSegment>& segments) {
  AtomicFile file(path);
  for (const LineSegment& s : segments)
    file.stream() << fmt::format("{:.3f} {:.3f} {:.3f} {:.3f}\n", s.start.x(), s.start.y(),
                                 s.end.x(), s.end.y());
  file.commit();
}

}  // namespace placegraph
