#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/exports/map_export.h>

#include <string>

namespace placegraph {

/// Writes the occupancy grid of a component of a map, BASE.pgm and BASE.yaml, with cells of a
/// side [m]; `floor_plan` makes the floor plan whose walls are added; empty: none are.
/// Warns if there is no floor plan. Throws NoResult if the map is not metric, ArgumentError if the
/// cells are too many or walls of another component than the main one are wanted, FileError.
void write_occupancy(const std::string& base, const StoredMap& stored, int component, double cell_m,
                     const FloorPlanner& floor_plan, const LogSink& log_sink = {});

}  // namespace placegraph
