#include "apps/map/map_learn.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/pipeline/map/map_learner.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/map/image_range.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;

struct MapLearnArguments {
  std::string images, out;
  std::vector<int> range;
  std::vector<std::string> settings;
  MapLearnerOptions options;
  bool force = false;
};

void learn(MapLearnArguments arguments) {
  require_free(arguments.out, arguments.force);
  for (const std::string& setting : arguments.settings) set_option(arguments.options, setting);
  arguments.options.check();
  const ImageRange images = images_of(arguments.images, arguments.range);
  const bool colour = !read_frame(images, 0).colour.empty();
  Progress progress("learning", static_cast<std::int64_t>(images.paths.size()), "images");
  StoredMap stored = learn_map(
      images.paths.size(),
      [&](std::size_t i) {
        const Frame frame = read_frame(images, i);
        if (colour && frame.colour.empty())
          throw FileError(images.paths[i], "is grey, and the images before it have colour");
        progress.update(static_cast<std::int64_t>(i) + 1);
        return colour ? frame.colour : frame.image;
      },
      images.first, arguments.options);
  stored.origin.sequence = fs::absolute(arguments.images).string();
  stored.origin.view_options = dump_options(arguments.options.cues);
  write_map(arguments.out, stored);
  fmt::print("{} images, {} places, written to {}\n", images.paths.size(),
             stored.map.place_graph.places.size(), arguments.out);
}

}  // namespace

void add_map_learn_command(CLI::App& map) {
  auto arguments = std::make_shared<MapLearnArguments>();
  MapLearnArguments& a = *arguments;
  CLI::App* command =
      map.add_subcommand("learn", "A map of how places look, from images without a camera.");
  command->footer("placegraph map learn places/corridor --range 0 110 --out corridor.db");
  command->add_option("IMAGES", a.images, "a folder of images in the order they were taken")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("--out", a.out, "the map to write")->required();
  command->add_option("--range", a.range, "first and last image")->expected(2);
  command->add_option("--set", a.settings, "one option, key=value; may be repeated")
      ->type_size(1)
      ->allow_extra_args(false);
  command->add_flag("--force", a.force, "overwrite files");
  command->callback([arguments] { learn(*arguments); });
}

}  // namespace placegraph::apps
