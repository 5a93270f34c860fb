#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/scene/floor_plan.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/exports/export_summary.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What the path of a form names.
enum class MapExportTarget {
  kFile,    ///< the file
  kFolder,  ///< a folder of several files
  kImage    ///< a picture and its description, without their extensions .pgm and .yaml
};

/// File form of a map or of a part of it.
struct MapExportForm {
  std::string flag;                                 ///< flag of the command line
  std::string what;                                 ///< description of the content
  MapExportTarget target = MapExportTarget::kFile;  ///< what its path names
};

/// All forms.
std::vector<MapExportForm> map_export_forms();

/// Makes the floor plan of a saved map from the images of its sequence.
using FloorPlanner = std::function<FloorPlan(const StoredMap& stored)>;

/// What is written of a map, and where.
struct MapExportArguments {
  std::string map;  ///< map.db, or a folder written by `placegraph run`
  std::vector<std::string>
      paths;  ///< one path per form, in the order of map_export_forms(); empty: none
  /// Component whose trajectory and geometry are written; nothing: the main one.
  std::optional<int> component;
  bool ascii = false;          ///< numbers as text, of the forms that have both
  double resolution_m = 0.05;  ///< side of a cell of an occupancy grid
  bool walls = false;          ///< an occupancy grid with the walls of the floor plan
  /// Makes the floor plan for `walls`, as plan_of_map() of placegraph::elements does; empty: none,
  /// and `walls` is rejected.
  FloorPlanner floor_plan;
  std::optional<double> voxel;  ///< side of the voxels of cloud and mesh; nothing: see docs
  bool force = false;           ///< overwrite existing files
};

/// What was written.
struct MapExportResult {
  std::vector<std::string> written;     ///< paths of the written forms, as in the arguments
  std::optional<ColmapSummary> colmap;  ///< figures of the model for COLMAP, if it was written
  std::optional<DenseSummary> dense;    ///< figures of cloud and mesh, if one was written
};

/// Receivers of what an export says while it works; each may be empty.
struct MapExportMessages {
  LogSink log = {};              ///< receiver of warnings
  ExportProgress progress = {};  ///< receiver of the progress of dense clouds and meshes
};

/// Writes parts of a saved map as separate files, as `placegraph map export` does.
///
/// Throws ArgumentError if nothing is to be written, a file exists, has an unknown extension or
/// would overwrite another one; FileError; and NoResult if a form needs poses or a metric map and
/// the map is another.
MapExportResult map_export(const MapExportArguments& arguments,
                           const MapExportMessages& messages = {});
/// The same for a map that was read; MapExportArguments::map is its name in messages.
MapExportResult map_export(const StoredMap& stored, const MapExportArguments& arguments,
                           const MapExportMessages& messages = {});

/// A line for COLMAP's model, and one for cloud and mesh; empty without them.
std::string to_text(const MapExportResult& result);

}  // namespace placegraph
