#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/map.h>
#include <placegraph/graph/scene/floor_plan.h>

#include <optional>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

class Dataset;

/// Writes floor_plan.json, floor_plan.svg and floor_plan.png into a folder.
/// `map` is the one that it was made of, `log` takes a warning where no PNG can be made. Throws
/// FileError.
void write_floor_plan(const std::string& folder, const FloorPlan& plan, const Map& map,
                      const std::string& title, const LogSink& log = {});

/// Share of the outlines of all rooms along which walls were observed, at most 1.
/// 0 without rooms.
double walled_share(const FloorPlan& plan);

/// A warning if most of the outlines of the rooms are not walls that were observed.
std::optional<std::string> doubt_of(const FloorPlan& plan);

/// Members of result.json for a floor plan, JSON.
/// These are counts and, if the sequence's folder has the true plan (floorplan.json) and true
/// poses, its errors: by the first pose ("origin") and after the alignment of the trajectory
/// ("se3").
std::string floor_plan_json(const FloorPlan& plan, const Map& map, const Dataset& dataset,
                            const std::string& sequence);

/// Writes the labels of the places into a saved map. Throws FileError.
void save_labels(const std::string& map_file, const PlaceGraph& places);

}  // namespace placegraph
