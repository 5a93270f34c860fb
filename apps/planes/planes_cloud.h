#pragma once
#include <placegraph/eval/internal/scene/plane_check.h>
#include <placegraph/frontend/internal/cloud_planes/cloud_planes.h>
#include <placegraph/frontend/internal/cloud_planes/cuboids.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// How planes are found, in the order of CloudPlanesMethod: cuts, ransac, growing.
const std::vector<std::string>& cloud_planes_method_names();

struct PlanesCloudArguments {
  std::string in;     ///< 16-bit depth image, PLY, KITTI's .bin, or text with `x y z` a line [m]
  std::string out;    ///< plane of each pixel as 8-bit PNG, or of each point a line: 0 none
  std::string calib;  ///< of the camera of a depth image
  double depth_scale = 0.001;   ///< metres a step of a depth image; from 1 up: steps a metre
  std::string method = "cuts";  ///< one of cloud_planes_method_names()
  CloudPlanesOptions options;   ///< but the method, which `method` names
  std::string model;            ///< planarity that `train planarity` wrote; empty: the built-in one
  std::string cuboids;          ///< JSON file of boxes and rooms; empty: none are sought
  CuboidOptions cuboid_options;
  std::string truth;              ///< true labels, PNG or a line a point; empty: not known
  std::vector<std::string> same;  ///< "14=5": true label 14 counts as 5
  std::vector<int> none;          ///< true labels that are no plane
  PlaneCheckOptions check;        ///< of the planes against the truth
  bool force = false;             ///< overwrite `out` and `cuboids`
};

struct PlanesCloudResult {
  std::string in, method;
  std::ptrdiff_t points = 0;     ///< that were measured
  std::ptrdiff_t on_planes = 0;  ///< of them
  CloudPlanesResult found;
  std::optional<PlaneCheck> check;             ///< where the truth is known
  std::optional<std::vector<Cuboid>> cuboids;  ///< if they were sought
  double cpu_ms = 0;                           ///< of the planes alone
};

/// `placegraph planes`: labels the points of a cloud by the planes that they lie on, and finds the
/// boxes and rooms that these make. Throws ArgumentError, FileError. No plane is an answer. Warns
/// of more planes than an 8-bit image tells apart.
PlanesCloudResult planes_cloud(const PlanesCloudArguments& arguments);

/// Some lines.
std::string to_text(const PlanesCloudResult& result);
std::string to_json(const PlanesCloudResult& result);

}  // namespace placegraph::apps
