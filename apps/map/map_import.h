#pragma once
#include <placegraph/graph/core/log.h>

#include <cstddef>
#include <string>

namespace placegraph::apps {

struct MapImportArguments {
  std::string colmap;   ///< folder of a COLMAP model
  std::string images;   ///< the sequence of its images
  std::string out;      ///< file for the map
  bool metric = false;  ///< lengths of the model are metres
  bool force = false;   ///< overwrite an existing file
};

struct MapImportResult {
  std::string out;
  std::size_t keyframes = 0, frames = 0, landmarks = 0, observations = 0;
};

/// Makes a map of the model of another program: `placegraph map import`.
/// `log` takes what import_colmap says. Throws as import_colmap.
MapImportResult map_import(const MapImportArguments& arguments, const LogSink& log = {});

/// One line.
std::string to_text(const MapImportResult& result);

}  // namespace placegraph::apps
