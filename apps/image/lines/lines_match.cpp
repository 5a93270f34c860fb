#include "apps/image/lines/lines_match.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/segment_file.h>

#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

void check(const LinesMatchArguments& arguments) {
  require(arguments.images.size() == 2, "IMAGES: two are needed");
  for (const auto& [files, option] : {std::pair(&arguments.segments, "--segments"),
                                      std::pair(&arguments.segments_out, "--write-segments")})
    require(files->empty() || files->size() == 2, std::string(option) + ": two files are needed");
}

std::vector<LineSegment> segments_for(const LinesMatchArguments& arguments, std::size_t which,
                                      const Image& image) {
  if (!arguments.segments.empty()) return read_segments(arguments.segments[which]);
  return segments_of(detect_segments(image, arguments.detector));
}

}  // namespace

LinesMatchResult lines_match(const LinesMatchArguments& arguments) {
  check(arguments);
  require_free(arguments.out, arguments.force);
  for (const std::string& path : arguments.segments_out) require_free(path, arguments.force);
  LinesMatchResult result;
  result.pair = arguments.images[0] + ", " + arguments.images[1];
  result.out = arguments.out;
  const Image image_a = read_image(arguments.images[0]).grey;
  const Image image_b = read_image(arguments.images[1]).grey;
  result.a = segments_for(arguments, 0, image_a);
  result.b = segments_for(arguments, 1, image_b);
  const SegmentMatches found =
      match_segments(image_a, result.a, image_b, result.b, arguments.matcher);
  if (!found.outcome) throw NoResult(result.pair + ": " + found.outcome.reason);
  if (found.matches.empty())
    throw NoResult(result.pair + ": no segment of one is found in the other");
  result.matches = found.matches;
  if (!arguments.segments_out.empty()) {
    write_segments(arguments.segments_out[0], result.a);
    write_segments(arguments.segments_out[1], result.b);
  }
  std::string lines;
  for (const SegmentMatch& match : result.matches)
    lines += fmt::format("{} {}\n", match.a, match.b);
  write_file(arguments.out, lines);
  return result;
}

std::string to_text(const LinesMatchResult& result) {
  return fmt::format("{}: {} and {} segments, {} matches, written to {}\n", result.pair,
                     result.a.size(), result.b.size(), result.matches.size(), result.out);
}

}  // namespace placegraph::apps
