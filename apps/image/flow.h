#pragma once
#include <placegraph/eval/scene/flow_error.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct FlowArguments {
  std::string from, to;               ///< paths of the two images
  std::string method = "dis";         ///< one of flow_method_names()
  std::vector<std::string> settings;  ///< options of the method, "key=value"
  std::string out;                    ///< file for the flow, .flo or .png; empty: none
  std::string drawing;                ///< file for a drawing, PNG; empty: none
  std::string truth;                  ///< true flow to compare with, .flo or .png; empty: none
  bool cues =
      false;  ///< also estimate the cues of the flow, with the following members except `force`
  std::string calib;         ///< calibration of the camera; required
  double dt_s = 0;           ///< time between the images [s]; 0: unit of time is the image step
  std::vector<double> gyro;  ///< angular velocity in the camera's axes [rad/s]; empty: unknown
  std::vector<double>
      rotation;  ///< or the rotation vector between the images [rad]; empty: unknown
  double rotation_sigma =
      1e-3;  ///< standard deviation of the rotation between the images, per axis [rad]
  std::vector<double> normal;  ///< normal of the plane in the first camera; empty: the optical axis
  int cell_px = 16;            ///< side of the square with one vector [px]
  bool force = false;          ///< overwrite `out` and `drawing`
};

struct FlowResult {
  std::string method;
  std::int64_t known = 0;                ///< number of pixels with a displacement
  double cpu_ms = 0;                     ///< CPU time of the flow alone
  std::optional<FlowError> error;        ///< set if the truth is given
  nlohmann::ordered_json cues;           ///< see describe_cues(); null if not requested
  std::optional<std::string> no_result;  ///< reason if cues were requested and the flow allows none
};

/// Estimates the optical flow between two images: `placegraph image flow`.
/// It is written, drawn and compared with the truth on demand. Throws ArgumentError, FileError, and
/// NoResult if no displacement was found.
FlowResult flow(const FlowArguments& arguments);

/// One line, and those of the cues.
std::string to_text(const FlowResult& result);
std::string to_json(const FlowResult& result);

}  // namespace placegraph::apps
