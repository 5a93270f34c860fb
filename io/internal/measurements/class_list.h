#pragma once
#include <placegraph/graph/scene/scene_model.h>

#include <string>
#include <vector>

namespace placegraph {

/// The classes of a labelled set, a line each: number in the label images, name, and sky, ground,
/// vertical or object (- where it is void and not scored); # begins a comment. Several numbers may
/// be of one class. Throws FileError with the line: another form, a number beyond 254, a number
/// twice, a name twice with different surfaces; or if no class is scored.
std::vector<SceneClass> read_class_list(const std::string& path);

}  // namespace placegraph
