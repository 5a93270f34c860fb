#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/route.h>

#include <cstdint>
#include <string>

#include "apps/results/run_map.h"

namespace placegraph::apps {

struct RouteArguments {
  std::string map;         ///< folder that placegraph run has written, or a map.db
  std::string out, plot;   ///< files to write: JSON, and .png or .svg; empty: none
  PlaceId from, to;        ///< places
  bool backtrack = false;  ///< the way back from `to`
  bool force = false;      ///< overwrite files
};

struct RouteResult {
  Route route;  ///< it has steps
  RunMap map;
};

/// `placegraph route`: the shortest way over the places of a map. Throws ArgumentError, FileError,
/// and NoAnswer where there is no way; then nothing is written.
RouteResult route(const RouteArguments& arguments);

/// A row for each place of the way.
std::string to_text(const RouteResult& result);
/// Relative poses from place to place, and the frame whose view to expect at each.
std::string to_json(const RouteResult& result);

}  // namespace placegraph::apps
