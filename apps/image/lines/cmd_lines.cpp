#include "apps/image/lines/cmd_lines.h"

#include <placegraph/graph/core/error.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/image/lines/lines_detect.h"
#include "apps/image/lines/lines_match.h"
#include "apps/support/option_texts.h"
#include "apps/support/output.h"

namespace placegraph::apps {
namespace {

void add_detect(CLI::App& image) {
  auto arguments = std::make_shared<LinesDetectArguments>();
  CLI::App* command = image.add_subcommand("lines", "Detect the straight edges of an image");
  command->footer("placegraph image lines image.png -o segments.txt");
  command
      ->add_option("IMAGE", arguments->image, "image")
      ->type_name(kInput)
      ->required();
  command
      ->add_option("-o,--out", arguments->out,
                   "file to write, u1 v1 u2 v2 a line, the brighter side on the right")
      ->type_name(kOutput)
      ->required();
  command->add_option("--min-length", arguments->options.min_length_px, "shortest segment [px]")
      ->capture_default_str();
  command->add_flag("--force", arguments->force, kForceText);
  command->callback([arguments] { print(to_text(lines_detect(*arguments))); });
}

void add_match(CLI::App& image) {
  auto arguments = std::make_shared<LinesMatchArguments>();
  LinesMatchArguments& a = *arguments;
  CLI::App* command =
      image.add_subcommand("match-lines", "Match the straight edges of two images of any baseline");
  command->footer("placegraph image match-lines a.png b.png -o matches.txt");
  auto* images = command->add_option("IMAGES", a.images, "two images");
  images->type_name(kInput)->required()->expected(2);
  command
      ->add_option("-o,--out", a.out,
                   "file to write, `i j` a line: numbers of the segments from 0, in the order of "
                   "--segments or --write-segments")
      ->type_name(kOutput)
      ->required();
  // Positions alone are ambiguous: a mirrored facade explains half of its edges as well.
  const auto take_segments = [&a, images](const std::vector<std::string>& files) {
    require(
        images->count() > 0,
        "--segments: needs the two images as well, `image match-lines A.png B.png --segments A.txt "
        "B.txt`: the images are needed to compare the surroundings of the segments");
    a.segments = files;
  };
  auto* given = command->add_option_function<std::vector<std::string>>(
      "--segments", take_segments,
      "take these two files of segments of the images, u1 v1 u2 v2 a line");
  given->type_name(kInput)->type_size(2)->expected(1);
  command
      ->add_option("--write-segments", a.segments_out, "two files for the segments")
      ->type_name(kOutput)
      ->type_size(2)
      ->expected(1)
      ->excludes(given);
  command->add_option("--min-length", a.detector.min_length_px, "shortest segment [px]")
      ->capture_default_str()
      ->excludes(given);
  command->add_option("--min-score", a.matcher.min_score, "smallest score of a match, from 0 to 1")
      ->capture_default_str();
  command->add_flag("--force", a.force, kForceText);
  command->callback([arguments] { print(to_text(lines_match(*arguments))); });
}

}  // namespace

void add_lines_commands(CLI::App& image) {
  add_detect(image);
  add_match(image);
}

}  // namespace placegraph::apps
