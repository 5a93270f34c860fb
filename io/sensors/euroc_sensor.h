#pragma once
// Inside io only, as yaml_document.h.
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/io/config/yaml_document.h>

namespace placegraph {

/// Reads T_BS of a sensor.yaml in EuRoC's format: T_body_sensor. Throws FileError with the line.
SE3 read_T_body_sensor(const YamlDocument& yaml);

/// The same pose as lines of a sensor.yaml.
std::string T_body_sensor_yaml(const SE3& T_body_sensor);

}  // namespace placegraph
