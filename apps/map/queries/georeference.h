#pragma once
#include <placegraph/backend/georeference/georeference.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

struct GeoreferenceArguments {
  std::string graph, gps, out;  ///< map, GPS fixes (OXTS), and folder for the results
  std::string times;            ///< file of times of a .g2o graph's nodes; empty: none
  std::string lever_arm;        ///< antenna, "x,y,z" [m] or "estimate"; empty: 0
  std::string origin;           ///< "latitude,longitude,height" [deg, m]; empty: from the fixes
  std::string clock_offset;     ///< seconds or "estimate"; empty: 0
  std::vector<std::string> settings;  ///< "key=value"
  bool force = false;                 ///< write into a folder that is not empty
};

struct GeoreferenceReport {
  std::string out;                 ///< folder of the results
  GeoreferenceResult result;       ///< result with outcome ok
  nlohmann::ordered_json summary;  ///< content of georeference.json
};

/// Places a map on the earth and writes the results: `placegraph map georeference`.
/// Throws ArgumentError, FileError, and NoResult if the fixes do not determine the position of the
/// map.
GeoreferenceReport georeference(const GeoreferenceArguments& arguments);

std::string to_text(const GeoreferenceReport& report);
/// Content of georeference.json.
std::string to_json(const GeoreferenceReport& report);

}  // namespace placegraph::apps
