#include "apps/map/map_import.h"

#include <fmt/format.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/pipeline/exports/colmap_import.h>

#include "apps/support/output.h"

namespace placegraph::apps {

MapImportResult map_import(const MapImportArguments& arguments, const LogSink& log) {
  require_free(arguments.out, arguments.force);
  const StoredMap stored = import_colmap(arguments.colmap, arguments.images, arguments.metric, log);
  write_map(arguments.out, stored);
  MapImportResult result{.out = arguments.out,
                         .keyframes = stored.map.keyframes.size(),
                         .frames = stored.map.frames.size(),
                         .landmarks = stored.map.landmarks.size()};
  for (const Keyframe& keyframe : stored.map.keyframes)
    result.observations += keyframe.observations.size();
  return result;
}

std::string to_text(const MapImportResult& result) {
  return fmt::format("{}: {} keyframes of {} frames, {} landmarks, {} observations\n", result.out,
                     result.keyframes, result.frames, result.landmarks, result.observations);
}

}  // namespace placegraph::apps
