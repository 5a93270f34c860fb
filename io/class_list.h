#pragma once
#include <placegraph/graph/scene_model.h>

#include <string>
#include <vector>

namespace placegraph {

/// The classes of a labelled set, a line each: number in the label images, name, and sky, ground,
/// vertical or object (- where it is void and not scored); # begins a comment. Throws FileError
/// with the line: another form, a number beyond 254, a number or name twice; or if no class is
/// scored.
std::vector<SceneClass> read_class_list(const std::string& path);

}  // namespace placegraph
