#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads the classes of a labelled set.
/// One per line: number in the label images, name, and sky, ground, vertical or object (- if the
/// class is void and not scored); # begins a comment. Several numbers may belong to one class.
/// Throws FileError with the line: another format, a number beyond 254, a duplicate number, a name
/// twice with different surfaces; or if no class is scored.
std::vector<SceneClass> read_class_list(const std::string& path);

}  // namespace placegraph
