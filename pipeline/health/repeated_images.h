#pragma once
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/measurements/data_note.h>

#include <optional>

namespace placegraph {

/// Counts consecutive images that are equal to the byte: a sensor never takes the same image twice,
/// so they were copied, and their stamps cannot be right.
class RepeatedImages {
 public:
  void add(const Frame& frame);
  /// The next image is compared with that of this frame, which has been counted before.
  void go_on_after(const Frame& frame) { last_ = frame.image; }
  /// Reports more than a few repeated images.
  std::optional<DataNote> note() const;
  void visit_state(auto& archive) { archive(frames_, repeated_, first_); }

 private:
  Image last_;
  int frames_ = 0, repeated_ = 0;
  std::optional<FrameId> first_;  // the first one that repeats its predecessor
};

}  // namespace placegraph
