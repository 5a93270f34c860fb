#pragma once
#include <placegraph/io/exports/gltf_scene.h>
#include <placegraph/io/map/stored_map.h>

#include <string>

namespace placegraph {

/// Trajectory, landmarks and pyramids of the keyframes' views of a component of a map, as glTF.
std::string map_gltf(const StoredMap& stored, int component, GltfForm form);

}  // namespace placegraph
