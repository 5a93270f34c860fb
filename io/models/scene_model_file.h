#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a trained scene labelling model from one binary file.
///
/// The file contains "PGSCENE\n", then in 32 bits each, little-endian, the version of the format
/// (2), the number of bytes that follow the header and their CRC-32; then the model (its trees in
/// depth-first order, leaves without their zeros). Throws FileError in one line: another kind of
/// file, another version, truncated, changed bytes, a model with a problem().
SceneModel read_scene_model(const std::string& path);

/// Writes a model in the format that read_scene_model reads.
///
/// The file is replaced as a whole or not at all. Throws FileError if it cannot be written,
/// ArgumentError if the model has a problem().
void write_scene_model(const std::string& path, const SceneModel& model);

}  // namespace placegraph
