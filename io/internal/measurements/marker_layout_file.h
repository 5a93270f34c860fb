#pragma once
#include <placegraph/graph/internal/measurements/marker_layout.h>

#include <string>

namespace placegraph {

/// Reads markers.yaml: `dictionary`, `markers` (a list of `id`, `side_m`, `position` [m],
/// `quaternion` w x y z of T_world_marker, both absent where its place is not known) and `beacons`
/// (a list of positions); the lists may be absent, not both. Throws FileError with the line for
/// unknown keys, ids that come twice, and values that no marker has. Whether the dictionary is
/// known is the detector's question.
MarkerLayout read_marker_layout(const std::string& path);

/// Writes that form. Throws FileError.
void write_marker_layout(const std::string& path, const MarkerLayout& layout);

}  // namespace placegraph
