#pragma once
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>
#include <vector>

namespace placegraph {

/// Finds rows of steps whose rotations the images contradict. A step alone may be blurred, or may
/// show something that moves; a row of them is posed by a wrong map, and what follows has another
/// scale.
class ContradictedSteps {
 public:
  /// Adds a frame, and whether the images contradict its rotation since the previous one.
  void add(FrameId frame, bool contradicted);
  /// The first frame of the row that the newest frame continues, once it is long enough.
  std::optional<FrameId> row() const;
  /// The first frame whose pose the row contradicts, in a map that begins with frame `begin`: that
  /// of the row, or `begin` if the row is at least as long as what comes before it, as nothing
  /// supports such a beginning.
  std::optional<FrameId> contradicted_from(FrameId begin) const;
  /// Ends the row: the next frame is posed by another map.
  void end_row();
  std::optional<DataNote> note() const;
  void visit_state(auto& archive) { archive(row_, found_); }

 private:
  // Steps in a row that are reported (docs/datasets.md). Chosen by the faults of group "fixed"
  // (tests/faults/README.md).
  static constexpr int kSteps = 3;
  struct Row {
    FrameId first, last;
    int steps = 0;
    void visit_state(auto& archive) { archive(first, last, steps); }
  };
  std::optional<Row> row_;  // that of the newest frame
  std::vector<Row> found_;  // rows that have ended and are long enough
};

}  // namespace placegraph
