#include "apps/synth/synth.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <charconv>
#include <thread>

#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

void parse_size(const std::string& text, SyntheticOptions& options) {
  const auto x = text.find('x');
  const char *begin = text.data(), *end = begin + text.size();
  const char* middle = x == std::string::npos ? end : begin + x;
  const auto width = std::from_chars(begin, middle, options.width);
  const bool has_width = width.ec == std::errc() && width.ptr == middle && middle != end;
  const auto height = has_width ? std::from_chars(middle + 1, end, options.height) : width;
  require(has_width && height.ec == std::errc() && height.ptr == end && options.width > 0,
          "--size: '" + text + "' is not of the form 1241x376");
}

SyntheticOptions world_options(const SynthArguments& arguments) {
  SyntheticOptions options = arguments.world;
  options.difficulty = synthetic::difficulty_from(arguments.difficulty);
  if (!arguments.size.empty()) parse_size(arguments.size, options);
  require(arguments.threads >= 0, "--threads: must not be negative");
  options.check();
  return options;
}

SequenceWriterOptions writer_options(const SynthArguments& arguments, const SyntheticWorld& world) {
  require(!world.flight_setting() || !(arguments.stereo || arguments.depth || arguments.labels),
          "flight: has one camera; --stereo, --depth and --labels are for other worlds");
  SequenceWriterOptions writer;
  writer.threads = arguments.threads > 0
                       ? arguments.threads
                       : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const SyntheticContents usual = usual_contents(world);
  writer.contents = {.right = arguments.stereo || (!arguments.mono && usual.right),
                     .depth = arguments.depth || usual.depth,
                     .labels = arguments.labels,
                     .planes = arguments.labels,
                     .flow = arguments.flow};
  writer.force = arguments.force;
  require(
      writer.contents.depth || !has_depth_defects(arguments.world.defects),
      "defects of the depth images: " + world.name() + " has none; add --depth, or leave them out");
  return writer;
}

}  // namespace

SynthResult synth(const SynthArguments& arguments) {
  const SyntheticOptions options = world_options(arguments);
  require_free_folder(arguments.out, arguments.force);
  const SyntheticWorld world(options);
  const SequenceWriterOptions writer = writer_options(arguments, world);
  {
    Progress progress("rendering " + world.name(), static_cast<std::int64_t>(world.size()));
    write_world(world, arguments.out, writer,
                [&](std::size_t done) { progress.update(static_cast<std::int64_t>(done)); });
  }
  return {world.name(),
          arguments.difficulty,
          arguments.out,
          world.size(),
          world.ground_truth().path_length(),
          writer.contents.right,
          writer.contents.depth};
}

std::string to_text(const SynthResult& result) {
  const char* sensor = result.stereo ? "stereo" : result.depth ? "rgbd" : "mono";
  return fmt::format("{}: {} frames, {:.0f} m, {} ({}), written to {}\n", result.world,
                     result.frames, result.length_m, sensor, result.difficulty, result.out);
}

}  // namespace placegraph::apps
