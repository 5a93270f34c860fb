#pragma once
#include <cstddef>

namespace placegraph {

/// When a run saves its map. What the run has learned is saved whole each time, so that with every
/// place the work would grow with the square of the run's length. A save is due once a
/// five-hundredth of the frames is new: the work stays in proportion to the length.
class SaveSchedule {
 public:
  /// `frames`: number of frames of the run until now.
  bool due(std::size_t frames) const { return kShare * (frames - saved_) >= frames; }
  void saved(std::size_t frames) { saved_ = frames; }

 private:
  // The five-hundredth above. Chosen.
  static constexpr std::size_t kShare = 500;
  std::size_t saved_ = 0;  // frames that are saved
};

}  // namespace placegraph
