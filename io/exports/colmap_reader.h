#pragma once
#include <placegraph/io/exports/colmap_model.h>

#include <string>

namespace placegraph {

/// Which models of cameras are read.
enum class ColmapLenses {
  kPinhole,  ///< PINHOLE and SIMPLE_PINHOLE
  kAny       ///< these, SIMPLE_RADIAL, RADIAL, OPENCV and OPENCV_FISHEYE
};

/// Whether the model in a folder has files .bin or .txt.
NumberForm colmap_form(const std::string& folder);

/// Reads a model from a folder with cameras, images and points3D, .bin or otherwise .txt.
/// All images have one camera, the first one if there are no images; other cameras are kept as they
/// are. Image points without a point are left out. Other files of the folder are not read.
/// Throws FileError, with the line in text, if a file is missing, truncated or malformed, if images
/// have several cameras, one of another model or one that is missing, if cameras share an id, or
/// for an observation of a missing point.
ColmapModel read_colmap(const std::string& folder, ColmapLenses lenses = ColmapLenses::kPinhole);

}  // namespace placegraph
