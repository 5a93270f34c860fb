#pragma once
#include <placegraph/backend/georeference/georeference.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace placegraph::apps {

struct GeoreferenceArguments {
  std::string graph, gps, out;  ///< map, fixes (OXTS), and folder of the results
  std::string times;            ///< times of a .g2o graph's nodes; empty: none
  std::string lever_arm;        ///< "x,y,z" [m], "estimate", or empty: 0
  std::string origin;           ///< "latitude,longitude,height" [deg, m], or empty: of the fixes
  std::string clock_offset;     ///< seconds, "estimate", or empty: 0
  std::vector<std::string> settings;  ///< "key=value"
  bool force = false;                 ///< write into a folder that is not empty
};

struct GeoreferenceReport {
  std::string out;                 ///< the folder of the results
  GeoreferenceResult result;       ///< its outcome is ok
  nlohmann::ordered_json summary;  ///< what georeference.json in it says
};

/// `placegraph georeference`: puts a map onto the earth and writes the results into their folder.
/// Throws ArgumentError, FileError, and NoAnswer where the fixes do not place the map.
GeoreferenceReport georeference(const GeoreferenceArguments& arguments);

std::string to_text(const GeoreferenceReport& report);
/// georeference.json.
std::string to_json(const GeoreferenceReport& report);

}  // namespace placegraph::apps
