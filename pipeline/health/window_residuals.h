#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>
#include <vector>

namespace placegraph {

struct WindowState;

/// Observations of the points in a window, and those that contradict its estimate.
struct WindowResiduals {
  int pixels = 0;      ///< observed pixels
  int odd_pixels = 0;  ///< reprojection errors of more than three standard deviations
  int depths = 0;      ///< measured inverse depths
  int odd_depths = 0;  ///< errors of more than three standard deviations
  void visit_state(auto& archive) { archive(pixels, odd_pixels, depths, odd_depths); }
};

/// Counts the usable observations of all points.
WindowResiduals window_residuals(const WindowState& state);

/// Compares the residuals of windows that share no keyframe with what their noise allows. Points
/// that agree on a wrong motion, depth images of another time or mirrored, right images of another
/// time: they leave residuals that no pose explains.
class ResidualCheck {
 public:
  /// `calibration` shows where inverse depths come from: a depth camera or a second camera.
  explicit ResidualCheck(const Calibration& calibration);

  void add(const WindowResiduals& window) { windows_.push_back(window); }
  /// Reports windows in which more than five per cent of the pixels are odd, and depths that are
  /// odd in more than three per cent (of a stereo pair: six) of all windows' measurements. Some per
  /// mille to three per cent are usual.
  std::vector<DataNote> notes() const;
  void visit_state(auto& archive) { archive(windows_); }

 private:
  std::optional<DataNote> note_of_pixels() const;
  std::optional<DataNote> note_of_depths() const;

  bool depth_camera_;
  std::vector<WindowResiduals> windows_;
};

}  // namespace placegraph
