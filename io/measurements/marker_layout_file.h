#pragma once
#include <placegraph/graph/measurements/marker_layout.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads markers.yaml.
/// It has `dictionary`, `markers` (a list of `id`, `side_m`, `position` [m], `quaternion` w x y z
/// of T_world_marker, both absent if the pose is unknown) and `beacons` (a list of positions); one
/// of the lists may be absent. Throws FileError with the line for unknown keys, duplicate ids, and
/// values that are impossible for a marker. The detector checks whether the dictionary is
/// supported.
MarkerLayout read_marker_layout(const std::string& path);

/// Writes a layout in that format. Throws FileError.
void write_marker_layout(const std::string& path, const MarkerLayout& layout);

}  // namespace placegraph
