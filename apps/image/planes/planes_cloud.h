#pragma once
#include <placegraph/eval/scene/plane_check.h>
#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/frontend/cloud_planes/cuboids.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// Names of the methods, in the order of CloudPlanesMethod: cuts, ransac, growing.
const std::vector<std::string>& cloud_planes_method_names();

struct PlanesCloudArguments {
  std::string in;    ///< 16-bit depth image, PLY, KITTI's .bin, or text with `x y z` per line [m]
  std::string out;   ///< planes of the pixels as PNG, or number of each point's, one a line: 0 none
  bool ids = false;  ///< the PNG has the numbers in 8 or 16 bits, not colours with a legend
  std::string calib;            ///< calibration of the camera of a depth image
  double depth_scale = 0.001;   ///< metres per step of a depth image; from 1 up: steps per metre
  std::string method = "cuts";  ///< one of cloud_planes_method_names()
  CloudPlanesOptions options;   ///< the method is set by `method`
  std::string model;            ///< file written by `train planarity`; empty: the built-in model
  std::string cuboids;          ///< JSON file for boxes and rooms; empty: no search
  CuboidOptions cuboid_options;
  std::string truth;              ///< true labels, PNG or one line per point; empty: unknown
  std::vector<std::string> same;  ///< true labels to merge: with "14=5", label 14 counts as 5
  std::vector<int> none;          ///< true labels that are not planes
  PlaneCheckOptions check;        ///< thresholds of the comparison with the truth
  bool force = false;             ///< overwrite `out` and `cuboids`
};

struct PlanesCloudResult {
  std::string in, method;
  std::ptrdiff_t points = 0;     ///< measured points
  std::ptrdiff_t on_planes = 0;  ///< measured points on planes
  CloudPlanesResult found;
  std::optional<PlaneCheck> check;             ///< set if the truth is known
  std::optional<std::vector<Cuboid>> cuboids;  ///< set if they were searched
  double cpu_ms = 0;                           ///< time of the plane search alone
};

/// Labels the points of a cloud by their planes: `placegraph image planes`.
/// On demand finds boxes and rooms of orthogonal planes. Throws ArgumentError, FileError. A cloud
/// without planes is a valid result.
PlanesCloudResult planes_cloud(const PlanesCloudArguments& arguments);

/// Some lines.
std::string to_text(const PlanesCloudResult& result);
std::string to_json(const PlanesCloudResult& result);

}  // namespace placegraph::apps
