#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/io/exports/ply_points.h>
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/exports/export_summary.h>

#include <cstddef>
#include <string>

namespace placegraph {

/// Adjusts a component of a map and writes cameras, images and points3D into a folder.
/// Files of the other form there are removed. `undistorted`: as KeyframeImagePaths. Throws
/// FileError if the sequence or the folder cannot be used, NoResult if no point is left.
ColmapSummary write_colmap(const std::string& folder, const StoredMap& stored, int component,
                           NumberForm form, const std::string& undistorted = "",
                           const LogSink& log_sink = {});

}  // namespace placegraph
