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
  std::string map;                    ///< map.db, or the folder of placegraph run with it
  std::string images;                 ///< a folder of images, or a sequence
  std::string out;                    ///< file of the answers
  std::vector<int> range;             ///< first and last image; empty: all
  std::vector<std::string> settings;  ///< "key=value"
  bool sequence = false;              ///< the images follow each other: evidence is added up
  bool as_json = false;               ///< the answers are written as JSON
  bool force = false;                 ///< overwrite `out`
};

/// How many images were placed, and what became of the others.
struct LocalizeCounts {
  std::size_t images = 0, placed = 0, posed = 0;
  std::map<std::string, std::size_t> refused;       ///< by the stage that decided
  std::map<std::string, std::size_t> without_pose;  ///< placed ones, by the reason
};

struct LocalizeResult {
  std::string out;
  std::int64_t first = 0;             ///< number of the first image
  std::vector<Localization> answers;  ///< one an image
  LocalizeCounts counts;
  std::vector<std::string> notes;  ///< what is odd about the images
  double cpu_ms_an_image = 0;
  std::optional<std::string> no_answer;  ///< no image could be placed
};

/// `placegraph localize`: places images in a saved map and writes where. Progress goes to stderr.
/// Throws ArgumentError, FileError, and NoAnswer where the map has no views to compare with.
LocalizeResult localize(const LocalizeArguments& arguments);

std::string to_text(const LocalizeResult& result);
std::string to_json(const LocalizeResult& result);

}  // namespace placegraph::apps
