#pragma once
#include <placegraph/io/exports/colmap_model.h>

#include <string>

namespace placegraph {

/// Writes cameras, images and points3D of a model into a folder.
/// Files of the other form there are removed, as are rigs and frames, in which COLMAP has poses of
/// an older model. Throws as to_colmap, and FileError if the folder cannot be written to.
void write_colmap_folder(const std::string& folder, const ColmapModel& model, NumberForm form);

}  // namespace placegraph
