#include <placegraph/pipeline/frame_reader.h>

namespace placegraph {

FrameReader::FrameReader(const Dataset& dataset, const LearnedImages& images, Sensor sensor,
                         std::size_t end, bool ahead)
    : dataset_(dataset), images_(images), sensor_(sensor), end_(end), ahead_(ahead) {}

Frame FrameReader::read(std::size_t index) {
  std::future<Frame> ready = std::move(next_);
  Frame frame = ready.valid() && next_index_ == index ? ready.get() : load(index);
  if (ahead_ && index + 1 < end_) {
    next_index_ = index + 1;
    next_ = std::async(std::launch::async, [this, index] { return load(index + 1); });
  }
  return frame;
}

Frame FrameReader::load(std::size_t index) const {
  Frame frame = dataset_.frame(index, sensor_);
  images_.apply(frame);
  return frame;
}

}  // namespace placegraph
