#pragma once
#include <placegraph/io/map/stored_map.h>
#include <placegraph/pipeline/internal/dense/depth_sources.h>

namespace placegraph::apps {

/// The images of the keyframes of a component, undistorted as the run did, and their calibration.
/// Throws FileError if the sequence is no longer there, ArgumentError if it lacks a frame or the
/// sensor of the run.
PosedImages posed_images(const StoredMap& stored, const MapGeometry& geometry);

}  // namespace placegraph::apps
