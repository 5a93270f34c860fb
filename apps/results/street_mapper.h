#pragma once
#include <placegraph/pipeline/results/semantic_map_files.h>

#include <string>

namespace placegraph::apps {

/// Paths of the models for street labelling; empty: the installed ones.
struct UrbanModelPaths {
  std::string urban, surfaces;
};

/// Checks models and options before any work.
/// Throws FileError if a model is missing or invalid, with the command that makes it, and
/// ArgumentError.
void check_urban_models(const UrbanMapperOptions& options, const UrbanModelPaths& models);

/// urban_mapper_of() with models from files and progress on stderr.
/// Throws FileError if a model is missing.
UrbanMapper street_mapper_of(const Map& map, const Calibration& calibration, const Dataset& dataset,
                             Sensor sensor, double lens_k1, const UrbanMapperOptions& options,
                             const UrbanModelPaths& models);

}  // namespace placegraph::apps
