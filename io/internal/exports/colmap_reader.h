#pragma once
#include <placegraph/io/internal/exports/colmap_model.h>

#include <string>

namespace placegraph {

/// Reads a model of one camera without distortion (PINHOLE or SIMPLE_PINHOLE) from a folder with
/// cameras, images and points3D, .bin or otherwise .txt. Image points without a point are left out.
/// Throws FileError, with the line in text, if a file is missing, truncated or malformed, if there
/// is another number or model of cameras, or an observation of a missing point.
ColmapModel read_colmap(const std::string& folder);

}  // namespace placegraph
