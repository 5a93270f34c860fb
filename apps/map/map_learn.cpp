#include "apps/map/map_learn.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/image_list.h>
#include <placegraph/io/map/map_database.h>

#include <filesystem>

#include "apps/support/image_range.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace fs = std::filesystem;

MapLearnResult map_learn(const MapLearnArguments& arguments) {
  MapLearnerOptions options = arguments.options;
  require_free(arguments.out, arguments.force);
  for (const std::string& setting : arguments.settings)
    set_option(options, setting, option_notes());
  options.check();
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
      images.first, options);
  stored.origin.sequence = fs::absolute(arguments.images).string();
  stored.origin.view_options = dump_options(options.cues);
  write_map(arguments.out, stored);
  return {arguments.out, images.paths.size(), stored.map.place_graph.places.size()};
}

std::string to_text(const MapLearnResult& result) {
  return fmt::format("{} images, {} places, written to {}\n", result.images, result.places,
                     result.out);
}

}  // namespace placegraph::apps
