#pragma once
// Inside io only.
#include <placegraph/io/calibration/foreign_calibration.h>
#include <placegraph/io/config/yaml_document.h>

namespace placegraph {

/// Kalibr's camchain: cam0 and, if requested and present, cam1 as its right camera (T_cn_cnm1).
/// Throws FileError with the line.
ForeignCalibration read_kalibr(const YamlDocument& yaml, bool with_right);

}  // namespace placegraph
