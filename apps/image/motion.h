#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "apps/image/motion_models.h"

namespace placegraph::apps {

struct MotionArguments {
  std::string in;              ///< file of matched points, in the form of the model
  std::string calib;           ///< calibration of both views; only 3d3d needs none
  std::string model = "auto";  ///< one of motion_model_names()
  MotionModelOptions options;
  std::uint64_t seed = 1;  ///< seed of the random samples
  std::string out;         ///< file for to_json() of the result; empty: none
  bool force = false;      ///< overwrite `out`
};

struct MotionResult {
  std::string in;
  MotionEstimate estimate;
  double cpu_ms = 0;
  std::optional<std::string>
      no_result;  ///< reason if there is no motion; `estimate` then has the evidence
};

/// Estimates the motion of a camera between two views: `placegraph image motion`.
/// `out` is written also without a result. Throws ArgumentError, FileError.
MotionResult motion(const MotionArguments& arguments);

/// Some lines.
std::string to_text(const MotionResult& result);
std::string to_json(const MotionResult& result);

}  // namespace placegraph::apps
