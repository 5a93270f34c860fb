#include "apps/results/street_mapper.h"

#include <placegraph/io/datasets/dataset.h>

#include <optional>

#include "apps/shipped/scene_models.h"
#include "apps/support/progress.h"

namespace placegraph::apps {
namespace {

StreetMapModels load_street_map_models(const StreetMapModelPaths& models) {
  SceneModel urban = load_scene_model(SceneModel::Kind::kUrban, models.urban);
  return {std::move(urban), load_scene_model(SceneModel::Kind::kSurfaces, models.surfaces)};
}

}  // namespace

void check_street_map_models(const StreetMapperOptions& options,
                             const StreetMapModelPaths& models) {
  StreetMapper::check(options, load_street_map_models(models).urban);
}

StreetMapper street_mapper_of(const Map& map, const Calibration& calibration,
                              const Dataset& dataset, Sensor sensor, double lens_k1,
                              const StreetMapperOptions& options,
                              const StreetMapModelPaths& models) {
  std::optional<Progress> progress;
  return make_street_mapper(map, calibration, dataset, sensor, lens_k1, options,
                            load_street_map_models(models),
                            [&](std::size_t done, std::size_t total) {
                              if (!progress)
                                progress.emplace("labelling " + dataset.name(),
                                                 static_cast<std::int64_t>(total), "keyframes");
                              progress->update(static_cast<std::int64_t>(done));
                            });
}

}  // namespace placegraph::apps
