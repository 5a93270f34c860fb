#include "apps/synth/cmd_synth.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/synthetic/writers/flight_writer.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <memory>
#include <thread>

#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

struct SynthArguments {
  SyntheticOptions world;
  SequenceWriterOptions writer;
  std::string out, difficulty = "standard", size;
  bool stereo = false, mono = false;
  int threads = 0;
};

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

void run(SynthArguments arguments) {
  SyntheticOptions& options = arguments.world;
  options.difficulty = synthetic::difficulty_from(arguments.difficulty);
  if (!arguments.size.empty()) parse_size(arguments.size, options);
  require(arguments.threads >= 0, "--threads: must not be negative");
  options.check();
  require_free_folder(arguments.out, arguments.writer.force);

  SequenceWriterOptions& writer = arguments.writer;
  writer.threads = arguments.threads > 0
                       ? arguments.threads
                       : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const SyntheticWorld world(options);
  const bool flies = world.hover() != nullptr;
  require(!flies || !(arguments.stereo || writer.contents.depth || writer.contents.labels),
          "hover: has one eye, --stereo, --depth and --labels are for other worlds");
  writer.contents.right = arguments.stereo || (!arguments.mono && !world.is_indoor());
  writer.contents.depth = writer.contents.depth || world.is_indoor();
  {
    Progress progress("rendering " + world.name(), static_cast<std::int64_t>(world.size()));
    const auto write = flies ? write_flight : write_sequence;
    write(world, arguments.out, writer,
          [&](std::size_t done) { progress.update(static_cast<std::int64_t>(done)); });
  }
  const Trajectory truth = world.ground_truth();
  double length_m = 0;
  for (std::size_t i = 1; i < truth.size(); ++i)
    length_m += (truth.poses[i].T_world_body->translation() -
                 truth.poses[i - 1].T_world_body->translation())
                    .norm();
  fmt::print("{}: {} frames, {:.0f} m, {} ({}), written to {}\n", world.name(), world.size(),
             length_m, writer.contents.right ? "stereo" : "mono", arguments.difficulty,
             arguments.out);
}

}  // namespace

void add_synth_command(CLI::App& app) {
  auto arguments = std::make_shared<SynthArguments>();
  SynthArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("synth", "Render a sequence with exact ground truth");
  command->footer("placegraph synth town-loop --out out/town-loop --difficulty standard");
  command
      ->add_option(
          "WORLD", a.world.world,
          "town-loop, repeated-blocks, corridor-loop, warehouse, hover, or a KITTI pose file")
      ->required();
  command->add_option("--out", a.out, "folder to write, in KITTI's layout; hover in EuRoC's")
      ->required();
  command->add_option("--difficulty", a.difficulty, "clean, standard or hard")
      ->capture_default_str();
  command->add_option("--frames", a.world.frames, "at most this many; 0 = all")
      ->capture_default_str();
  command->add_option("--duration", a.world.duration_s, "hover: seconds of flight; 0 = 120")
      ->capture_default_str();
  auto* stereo = command->add_flag("--stereo", a.stereo, "both eyes (default outdoors)");
  command->add_flag("--mono", a.mono, "the left eye only")->excludes(stereo);
  command->add_flag("--depth", a.writer.contents.depth, "depth_0 (always written indoors)");
  command->add_flag("--labels", a.writer.contents.labels, "class and plane of every pixel");
  command->add_flag("--flow", a.writer.contents.flow, "exact optical flow to the next frame");
  command->add_option("--seed", a.world.seed, "another seed, another town, another flight")
      ->capture_default_str();
  command->add_option("--threads", a.threads, "frames at a time; 0 = all processors")
      ->capture_default_str();
  command->add_option("--size", a.size, "image size, as in 1241x376");
  command->add_flag("--force", a.writer.force, "replace what is in the folder");
  command->callback([arguments] {
    arguments->writer.contents.planes = arguments->writer.contents.labels;
    run(*arguments);
  });
}

}  // namespace placegraph::apps
