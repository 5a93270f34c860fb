#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace placegraph {

/// Reads JSON. Throws FileError if the file cannot be opened or is not valid JSON.
nlohmann::json read_json(const std::string& path);
/// Calls `take` with the JSON of a file that a command writes.
/// Throws FileError, too, for JSON of which `take` throws nlohmann::json::exception or
/// ArgumentError: it says that `command` did not write the file.
void take_json(const std::string& path, const std::string& command,
               const std::function<void(const nlohmann::json&)>& take);

/// {"position_m": [x, y, z], "quaternion_xyzw": [x, y, z, w]}.
nlohmann::json pose_json(const SE3& T);
/// Inverse of pose_json.
/// Throws nlohmann::json::exception for another form, ArgumentError if the numbers are no pose.
SE3 pose_of(const nlohmann::json& pose);

}  // namespace placegraph
