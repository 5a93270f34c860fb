#include "apps/lines/cmd_lines.h"

#include <placegraph/graph/core/error.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/lines/cmd_lines_track.h"
#include "apps/lines/lines_detect.h"
#include "apps/lines/lines_match.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

void add_detect(CLI::App& lines) {
  auto arguments = std::make_shared<LinesDetectArguments>();
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
  command->callback([arguments] { print(to_text(lines_detect(*arguments))); });
}

void add_match(CLI::App& lines) {
  auto arguments = std::make_shared<LinesMatchArguments>();
  LinesMatchArguments& a = *arguments;
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
  command->callback([arguments] { print(to_text(lines_match(*arguments))); });
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
