#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/route.h>

#include <cstdint>
#include <string>

#include <placegraph/pipeline/results/run_map.h>

namespace placegraph::apps {

struct RouteArguments {
  std::string map;         ///< map.db, or a folder written by `placegraph run`
  std::string out, plot;   ///< files for the path: JSON, and .png or .svg; empty: none
  PlaceId from, to;        ///< first and last place of the path
  bool backtrack = false;  ///< return the path back from `to`
  bool force = false;      ///< overwrite existing files
};

struct RouteResult {
  Route route;  ///< route with at least one step
  RunMap map;
};

/// Finds the shortest path over the places of a map: `placegraph map route`.
/// Throws ArgumentError, FileError, and NoResult if there is no path; then nothing is written.
RouteResult route(const RouteArguments& arguments);

/// A table with one row per place of the path.
std::string to_text(const RouteResult& result);
/// Relative poses from place to place, and the keyframe that shows the view at each.
std::string to_json(const RouteResult& result);

}  // namespace placegraph::apps
