#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/internal/health/focal_evidence.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Estimates the error of the focal length from bundle adjustment over windows that share no
/// keyframe. Points show it where the camera turns: on a straight path every focal length fits.
/// Windows differ by more than the noise of their points explains (a rolling shutter, points that
/// move): each has an error of its own, of two per cent or what their dispersion shows.
class FocalCheck {
 public:
  explicit FocalCheck(const Calibration& calibration);

  /// Adds the evidence of a window that shares no keyframe with the ones before.
  void add(const WindowState& window);
  void add(const FocalEvidence& evidence);
  struct Estimate {
    double error = 0;  ///< relative error of the calibration's focal length: f (1 + error) fits
    double sigma = 0;  ///< its standard deviation; infinite without a window
  };
  /// The weighted mean over all windows.
  Estimate estimate() const;
  /// Reports an error beyond three and a half standard deviations, with one per cent for what
  /// biases every window in the same way.
  std::optional<DataNote> note() const;

 private:
  FocalEvidence sum() const;

  Camera camera_;
  bool depths_measured_;
  std::vector<FocalEvidence> windows_;
};

}  // namespace placegraph
