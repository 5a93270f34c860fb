#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/pipeline/internal/run_mask.h>

#include <opencv2/core.hpp>

namespace placegraph {

RunMask::RunMask(const std::string& path, const Camera& camera) {
  if (path.empty()) return;
  mask_ = read_image(path).grey;
  require_size(path, mask_, camera.width, camera.height);
  if (cv::countNonZero(mask_) == 0)
    throw FileError(path, "masks the whole image: all pixels are 0");
}

void RunMask::apply(Frame& frame) const {
  if (mask_.empty()) return;
  frame.mask = frame.mask.empty() ? mask_ : Image(frame.mask & mask_);
}

}  // namespace placegraph
