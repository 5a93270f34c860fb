#include "apps/image/lines/lines_detect.h"

#include <fmt/format.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/segment_file.h>

#include "apps/support/output.h"

namespace placegraph::apps {

LinesDetectResult lines_detect(const LinesDetectArguments& arguments) {
  require_free(arguments.out, arguments.force);
  LinesDetectResult result{arguments.image, arguments.out, {}};
  result.segments =
      segments_of(detect_segments(read_image(arguments.image).grey, arguments.options));
  if (result.segments.empty()) throw NoResult(arguments.image + ": no straight edges");
  write_segments(arguments.out, result.segments);
  return result;
}

std::string to_text(const LinesDetectResult& result) {
  return fmt::format("{}: {} segments, written to {}\n", result.image, result.segments.size(),
                     result.out);
}

}  // namespace placegraph::apps
