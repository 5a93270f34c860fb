#pragma once
#include <placegraph/eval/internal/scene/flow_error.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct FlowArguments {
  std::string from, to;               ///< the two images
  std::string method = "dis";         ///< one of flow_method_names()
  std::vector<std::string> settings;  ///< "key=value", of the method
  std::string out;                    ///< where the flow is written, .flo or .png; empty: nowhere
  std::string drawing;                ///< PNG of the flow; empty: none
  std::string truth;                  ///< true flow to compare with, .flo or .png; empty: none
  bool cues = false;  ///< also what the flow tells at once; all below but `force` is for that
  std::string calib;  ///< of the camera; needed
  double dt_s = 0;    ///< time between the images [s]; 0: times are counted in images
  std::vector<double> gyro;  ///< three turn rates [rad/s] in the camera's axes; empty: not known
  std::vector<double> turn;  ///< or the rotation vector from image to image [rad]; empty
  double rotation_sigma = 1e-3;  ///< of either, from image to image, an axis [rad]
  std::vector<double> normal;    ///< to the plane, in the first camera; empty: the optical axis
  int cell_px = 16;              ///< one vector in a square of so many pixels a side
  bool force = false;            ///< overwrite `out` and `drawing`
};

struct FlowResult {
  std::string method;
  std::int64_t known = 0;                ///< pixels with a displacement
  double cpu_ms = 0;                     ///< of the flow alone
  std::optional<FlowError> error;        ///< where the truth is given
  nlohmann::ordered_json cues;           ///< see describe_cues(); null where not asked for
  std::optional<std::string> no_answer;  ///< cues were asked for, and the flow tells none: why
};

/// `placegraph flow`: optical flow between two images, written, drawn and compared with the truth.
/// Throws ArgumentError, FileError, and NoAnswer where no displacement was found.
FlowResult flow(const FlowArguments& arguments);

/// One line, and those of the cues.
std::string to_text(const FlowResult& result);
std::string to_json(const FlowResult& result);

}  // namespace placegraph::apps
