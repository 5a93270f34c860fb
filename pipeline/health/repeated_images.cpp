#include <fmt/format.h>
#include <placegraph/pipeline/health/repeated_images.h>

#include <cstring>

namespace placegraph {
namespace {

bool same_bytes(const Image& a, const Image& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  const std::size_t row_bytes = a.cols * a.elemSize();
  for (int row = 0; row < a.rows; ++row)
    if (std::memcmp(a.ptr(row), b.ptr(row), row_bytes) != 0) return false;
  return true;
}

}  // namespace

void RepeatedImages::add(const Frame& frame) {
  ++frames_;
  if (!last_.empty() && same_bytes(last_, frame.image)) {
    ++repeated_;
    if (!first_) first_ = frame.id;
  }
  last_ = frame.image;
}

std::optional<DataNote> RepeatedImages::note() const {
  // Repeated images that are not reported. Chosen by the faults of group "fixed"
  // (tests/faults/README.md).
  constexpr int kFew = 2;
  if (repeated_ <= kFew) return std::nullopt;
  return DataNote{
      fmt::format("{} of {} images repeat the one before them, the first of them is that of frame "
                  "{}",
                  repeated_, frames_, first_->value()),
      false, NoteCause::kRepeatedFrames, "remove the copies: their time stamps cannot be right"};
}

}  // namespace placegraph
