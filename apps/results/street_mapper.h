#pragma once
#include <placegraph/pipeline/results/street_map_files.h>

#include <string>

namespace placegraph::apps {

/// Paths of the models for street labelling; empty: the installed ones.
struct StreetMapModelPaths {
  std::string urban, surfaces;
};

/// Checks models and options before any work.
/// Throws FileError if a model is missing or invalid, with the command that makes it, and
/// ArgumentError.
void check_street_map_models(const StreetMapperOptions& options, const StreetMapModelPaths& models);

/// make_street_mapper() with models from files and progress on stderr.
/// Throws FileError if a model is missing.
StreetMapper street_mapper_of(const Map& map, const Calibration& calibration,
                              const Dataset& dataset, Sensor sensor, double lens_k1,
                              const StreetMapperOptions& options,
                              const StreetMapModelPaths& models);

}  // namespace placegraph::apps
