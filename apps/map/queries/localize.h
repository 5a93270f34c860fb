#pragma once
#include <placegraph/pipeline/map/map_localizer.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct LocalizeArguments {
  std::string map;                    ///< map.db, or a folder written by `placegraph run`
  std::string images;                 ///< folder of images, or a sequence
  std::string out;                    ///< file for the results
  std::vector<int> range;             ///< first and last image; empty: all
  std::vector<std::string> settings;  ///< "key=value"
  bool sequence = false;              ///< the images are consecutive: evidence is accumulated
  bool as_json = false;               ///< write the results as JSON
  bool force = false;                 ///< overwrite `out`
};

/// Counts of the images by result.
struct LocalizeCounts {
  std::size_t images = 0, placed = 0, posed = 0;
  std::map<std::string, std::size_t> refused;       ///< rejected images by the stage that decided
  std::map<std::string, std::size_t> without_pose;  ///< placed images without a pose, by reason
};

struct LocalizeResult {
  std::string out;
  std::int64_t first = 0;                   ///< number of the first image
  std::vector<std::string> names;           ///< file names; empty where images are not files
  std::vector<Localization> localizations;  ///< one result per image
  LocalizeCounts counts;
  std::vector<std::string> notes;  ///< remarks on the images
  double cpu_ms_an_image = 0;
  std::optional<std::string> no_result;  ///< reason if no image could be placed
};

/// Localizes images in a saved map and writes the results: `placegraph map localize`.
/// Progress goes to stderr, and a warning about each image that cannot be compared, which is
/// refused. Throws ArgumentError, FileError, and NoResult if the map has no views to compare with.
LocalizeResult localize(const LocalizeArguments& arguments);

std::string to_text(const LocalizeResult& result);
std::string to_json(const LocalizeResult& result);

}  // namespace placegraph::apps
