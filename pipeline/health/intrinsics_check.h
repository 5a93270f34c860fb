#pragma once
#include <placegraph/backend/evidence/intrinsics_evidence.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/measurements/data_note.h>

#include <vector>

namespace placegraph {

void visit_state(auto& archive, IntrinsicsEvidence& evidence) {
  archive(evidence.gradient, evidence.information, evidence.residuals);
}

/// Estimates the errors of the intrinsics from bundle adjustment over windows that share no
/// keyframe. Points show them where the camera turns: on a straight path every focal length fits.
/// Windows differ by more than the noise of their points explains (a rolling shutter, points that
/// move): each has errors of its own.
class IntrinsicsCheck {
 public:
  explicit IntrinsicsCheck(const Calibration& calibration);

  /// Adds the evidence of a window that shares no keyframe with the ones before.
  void add(const WindowState& window);
  void add(const IntrinsicsEvidence& evidence);
  struct Estimate {
    IntrinsicsEvidence::Vector errors;  ///< as IntrinsicsEvidence
    IntrinsicsEvidence::Vector sigmas;  ///< their standard deviations; infinite without a window
    double dispersion = 0;  ///< mean square of the windows' differences in their deviations
  };
  /// The mean over all windows, weighted by their information, and a prior about zero.
  Estimate estimate() const;
  /// Reports the most significant error beyond 2.8 standard deviations, and windows that
  /// contradict each other by twice their deviations.
  std::vector<DataNote> notes() const;
  void visit_state(auto& archive) { archive(windows_); }

 private:
  Camera camera_;
  bool depths_measured_;
  std::vector<IntrinsicsEvidence> windows_;
};

}  // namespace placegraph
