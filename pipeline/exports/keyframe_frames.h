#pragma once
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/dense/depth_sources.h>

#include <cstddef>
#include <string>

namespace placegraph {

/// The images of the keyframes of a component, undistorted as the run did, and their calibration.
/// Throws FileError if the sequence is no longer there, ArgumentError if it lacks a frame or the
/// sensor of the run.
PosedImages posed_images(const StoredMap& stored, const MapGeometry& geometry);

/// Writes the images of the keyframes into a folder, undistorted as the run did, under the names of
/// KeyframeImagePaths. Throws as posed_images, and FileError; then the folder has none of them.
/// Returns their number.
std::size_t write_undistorted(const std::string& folder, const StoredMap& stored, int component);

}  // namespace placegraph
