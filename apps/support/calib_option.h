#pragma once
#include <CLI/App.hpp>
#include <string>

namespace placegraph::apps {

/// Description of the argument of `--calib`.
inline constexpr const char* kCalibFile =
    "one line fx fy cx cy width height [px], or a calibration.yaml";

/// Adds `--calib FILE`.
CLI::Option* add_calib_option(CLI::App& command, std::string& path, const std::string& doc);

}  // namespace placegraph::apps
