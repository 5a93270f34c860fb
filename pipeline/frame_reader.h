#pragma once
#include <placegraph/io/datasets/dataset.h>
#include <placegraph/pipeline/learned_images.h>

#include <future>

namespace placegraph {

/// Reads the frames of a sequence masked and without distortion. If it may use a thread, it reads
/// the frame behind the newest one ahead.
class FrameReader {
 public:
  /// `dataset` must outlive the reader; frames from position `end` on are not read ahead.
  FrameReader(const Dataset& dataset, const LearnedImages& images, Sensor sensor, std::size_t end,
              bool ahead);

  /// The frame at any position. Throws FileError as Dataset::frame.
  Frame read(std::size_t index);

 private:
  Frame load(std::size_t index) const;

  const Dataset& dataset_;
  LearnedImages images_;
  Sensor sensor_;
  std::size_t end_;
  bool ahead_;
  std::size_t next_index_ = 0;  // position of `next_`
  std::future<Frame> next_;     // the frame that is read ahead, if any
};

}  // namespace placegraph
