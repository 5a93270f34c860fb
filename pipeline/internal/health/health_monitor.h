#pragma once
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/internal/health/repeated_images.h>

#include <vector>

namespace placegraph {

/// Collects evidence against the images, the calibration and the estimated motion during a run.
/// Each kind of evidence is a class of its own with add() and note().
class HealthMonitor {
 public:
  /// Adds a frame after it has been processed.
  void add(const Frame& frame);
  /// What is in doubt so far.
  std::vector<DataNote> notes() const;

 private:
  RepeatedImages repeated_;
};

}  // namespace placegraph
