#pragma once
#include <placegraph/graph/geometry/camera.h>

#include <CLI/App.hpp>
#include <string>

namespace placegraph::apps {

/// What `--calib` of these commands takes, for their help.
inline constexpr const char* kCalibFile =
    "one line fx fy cx cy width height [px], or a calibration.yaml";

/// Adds `--calib FILE`; `former`, a name that it had, is taken still and left out of the help.
CLI::Option* add_calib_option(CLI::App& command, std::string& path, const std::string& doc,
                              const std::string& former = "");

/// The camera of a calibration.yaml, or of one line `fx fy cx cy width height` in a file that ends
/// otherwise. Throws FileError.
Camera read_calib(const std::string& path);

/// The same where what is measured must come from images without distortion: `what` needs that.
Camera read_calib_without_distortion(const std::string& path, const std::string& what);

}  // namespace placegraph::apps
