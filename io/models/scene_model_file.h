#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A trained labelling in one binary file: "PGSCENE\n", then in 32 bits each, little-endian, the
/// version of the form (1), the bytes that follow the header and their CRC-32; then the model (its
/// trees in the order they are walked, leaves without their zeros). Throws FileError in one line:
/// another kind of file, another version, truncated, changed bytes, a model that is none.
SceneModel read_scene_model(const std::string& path);

/// Writes atomically. Throws FileError; ArgumentError if the model has a problem().
void write_scene_model(const std::string& path, const SceneModel& model);

}  // namespace placegraph
