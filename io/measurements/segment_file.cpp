#include <fmt/format.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/measurements/segment_file.h>

#include <cmath>

namespace placegraph {

namespace {

std::vector<LineSegment> read(const std::string& path, bool further_columns) {
  constexpr double kMaxPixel = 1e6;  // larger than any image
  TextFile file(path);
  std::vector<LineSegment> segments;
  std::string_view line;
  std::vector<std::string_view> fields;
  constexpr const char* kNames[] = {"u1", "v1", "u2", "v2"};
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() < 4 || (fields.size() > 4 && !further_columns))
      file.fail("a segment has 4 numbers, u1 v1 u2 v2, not " + std::to_string(fields.size()));
    double px[4];
    for (std::size_t i = 0; i < 4; ++i) {
      px[i] = file.number(fields[i], kNames[i]);
      if (std::abs(px[i]) > kMaxPixel)
        file.fail(std::string(kNames[i]) + ": " + in_quotes(fields[i]) + " is not a pixel");
    }
    const LineSegment segment{{px[0], px[1]}, {px[2], px[3]}};
    if (!(segment.length() > 0)) file.fail("the segment has no length");
    segments.push_back(segment);
  }
  return segments;
}

}  // namespace

std::vector<LineSegment> read_segments(const std::string& path) { return read(path, false); }

std::vector<LineSegment> read_segment_columns(const std::string& path) { return read(path, true); }

void write_segments(const std::string& path, const std::vector<LineSegment>& segments) {
  AtomicFile file(path);
  for (const LineSegment& s : segments)
    file.stream() << fmt::format("{:.3f} {:.3f} {:.3f} {:.3f}\n", s.start.x(), s.start.y(),
                                 s.end.x(), s.end.y());
  file.commit();
}

}  // namespace placegraph
