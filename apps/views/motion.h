#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "apps/views/motion_models.h"

namespace placegraph::apps {

struct MotionArguments {
  std::string in;              ///< file of matched points, of the form that the model needs
  std::string calib;           ///< of the camera of both views; only 3d3d needs none
  std::string model = "auto";  ///< one of motion_model_names()
  MotionModelOptions options;
  std::uint64_t seed = 1;  ///< of the random samples
  std::string out;         ///< where to_json() of the result is written; empty: nowhere
  bool force = false;      ///< overwrite `out`
};

struct MotionResult {
  std::string in;
  MotionEstimate answer;
  double cpu_ms = 0;
  std::optional<std::string> no_answer;  ///< why there is no motion; `answer` is evidence then
};

/// `placegraph motion`: how a camera moved between two views of matched points. Throws
/// ArgumentError, FileError. `out` is written also where there is no motion.
MotionResult motion(const MotionArguments& arguments);

/// Some lines.
std::string to_text(const MotionResult& result);
std::string to_json(const MotionResult& result);

}  // namespace placegraph::apps
