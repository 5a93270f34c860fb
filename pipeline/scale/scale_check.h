#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Compares the scale that the ground gives with that of the map during a run. Where the points
/// carry the scale well and the plane is the ground, both agree to a few hundredths.
class ScaleCheck {
 public:
  /// Adds a comparison at a frame: the logarithm of a length by the ground over that by the points.
  void add(FrameId frame, double log_factor);
  /// Reports that the two differ by more than a fifth in two comparisons and 3 % of all, or by more
  /// than 6 % in half of at least five comparisons.
  std::optional<DataNote> note() const;
  void visit_state(auto& archive) { archive(compared_); }

 private:
  struct Compared {
    FrameId frame;
    double log_factor;
    void visit_state(auto& archive) { archive(frame, log_factor); }
  };
  std::vector<Compared> compared_;
};

}  // namespace placegraph
