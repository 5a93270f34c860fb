#include "apps/views/cmd_lines.h"

#include <fmt/format.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/segments/segment_matcher.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/segment_file.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/support/output.h"
#include "apps/views/cmd_lines_track.h"

namespace placegraph::apps {
namespace {

struct DetectArguments {
  std::string image, out;
  bool force = false;
  SegmentDetectorOptions options;
};

void detect(const DetectArguments& arguments) {
  require_free(arguments.out, arguments.force);
  const auto edges = detect_segments(read_image(arguments.image).grey, arguments.options);
  if (edges.empty()) throw NoAnswer(arguments.image + ": no straight edges");
  write_segments(arguments.out, segments_of(edges));
  fmt::print("{}: {} segments, written to {}\n", arguments.image, edges.size(), arguments.out);
}

struct MatchArguments {
  std::vector<std::string> images, segments, segments_out;
  std::string out;
  bool force = false;
  SegmentDetectorOptions detector;
  SegmentMatcherOptions matcher;
};

std::vector<LineSegment> segments_for(const MatchArguments& arguments, std::size_t which,
                                      const Image& image) {
  if (!arguments.segments.empty()) return read_segments(arguments.segments[which]);
  return segments_of(detect_segments(image, arguments.detector));
}

void match(const MatchArguments& arguments) {
  require_free(arguments.out, arguments.force);
  for (const std::string& path : arguments.segments_out) require_free(path, arguments.force);
  const Image image_a = read_image(arguments.images[0]).grey;
  const Image image_b = read_image(arguments.images[1]).grey;
  const std::vector<LineSegment> a = segments_for(arguments, 0, image_a);
  const std::vector<LineSegment> b = segments_for(arguments, 1, image_b);
  const SegmentMatches found = match_segments(image_a, a, image_b, b, arguments.matcher);
  const std::string pair = arguments.images[0] + ", " + arguments.images[1];
  if (!found.outcome) throw NoAnswer(pair + ": " + found.outcome.reason);
  if (found.matches.empty()) throw NoAnswer(pair + ": no segment of one is found in the other");
  if (!arguments.segments_out.empty()) {
    write_segments(arguments.segments_out[0], a);
    write_segments(arguments.segments_out[1], b);
  }
  std::string lines;
  for (const SegmentMatch& match : found.matches) lines += fmt::format("{} {}\n", match.a, match.b);
  write_file(arguments.out, lines);
  fmt::print("{}: {} and {} segments, {} matches, written to {}\n", pair, a.size(), b.size(),
             found.matches.size(), arguments.out);
}

void add_detect(CLI::App& lines) {
  auto arguments = std::make_shared<DetectArguments>();
  CLI::App* command = lines.add_subcommand("detect", "Find the straight edges of an image");
  command->footer("placegraph lines detect image.png -o segments.txt");
  command->add_option("IMAGE", arguments->image, "image")->required();
  command
      ->add_option("-o,--out", arguments->out,
                   "file to write, u1 v1 u2 v2 a line, the brighter side on the right")
      ->required();
  command->add_option("--min-length", arguments->options.min_length_px, "of a segment [px]")
      ->capture_default_str();
  command->add_flag("--force", arguments->force, "overwrite OUT");
  command->callback([arguments] { detect(*arguments); });
}

void add_match(CLI::App& lines) {
  auto arguments = std::make_shared<MatchArguments>();
  MatchArguments& a = *arguments;
  CLI::App* command = lines.add_subcommand(
      "match", "Find the same straight edges in two images, however far apart");
  command->footer("placegraph lines match a.png b.png -o matches.txt");
  auto* images = command->add_option("IMAGES", a.images, "two images")->required()->expected(2);
  command
      ->add_option("-o,--out", a.out,
                   "file to write, `i j` a line: numbers of the segments from 0, in the order of "
                   "--segments or --write-segments")
      ->required();
  // Positions alone do not tell: a mere reflection of a facade explains half of its edges, too.
  const auto take_segments = [&a, images](const std::vector<std::string>& files) {
    require(images->count() > 0,
            "--segments: needs the two images as well, `lines match A.png B.png --segments A.txt "
            "B.txt`: segments are told apart by what surrounds them");
    a.segments = files;
  };
  auto* given = command->add_option_function<std::vector<std::string>>(
      "--segments", take_segments,
      "take these two files of segments of the images, u1 v1 u2 v2 a line");
  given->type_size(2)->expected(1);
  command->add_option("--write-segments", a.segments_out, "two files for the segments")
      ->type_size(2)
      ->expected(1)
      ->excludes(given);
  command->add_option("--min-length", a.detector.min_length_px, "of a detected segment [px]")
      ->capture_default_str()
      ->excludes(given);
  command->add_option("--min-score", a.matcher.min_score, "of a match, from 0 to 1")
      ->capture_default_str();
  command->add_flag("--force", a.force, "overwrite the outputs");
  command->callback([arguments] { match(*arguments); });
}

}  // namespace

void add_lines_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("lines", "Straight edges of images: find, match, follow");
  command->footer("placegraph lines match a.png b.png -o matches.txt");
  command->require_subcommand(1);
  add_detect(*command);
  add_match(*command);
  add_lines_track_command(*command);
}

}  // namespace placegraph::apps
