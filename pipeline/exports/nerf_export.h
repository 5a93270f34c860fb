#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/io/map/stored_map.h>

#include <string>

namespace placegraph {

/// The transforms.json of the keyframes of a component of a map, for a file at `path`, from whose
/// folder the paths of the images are; `undistorted`: as KeyframeImagePaths. Throws FileError if
/// the sequence is no longer there.
std::string nerf_transforms(const std::string& path, const StoredMap& stored, int component,
                            const std::string& undistorted = "", const LogSink& log_sink = {});

}  // namespace placegraph
