#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <limits>

namespace [[gnu::visibility("default")]] placegraph {

/// Error of optical flow over the pixels whose true flow is known and stays inside the image.
struct FlowError {
  std::int64_t pixels = 0;    ///< number of pixels with ground truth
  std::int64_t compared = 0;  ///< number of these with an estimate
  double coverage = 0;        ///< compared / pixels
  double mean_px = 0;         ///< mean end-point error (Otte & Nagel 1994) of the compared pixels
  double median_px = 0;
  double share_beyond_3px = 0;
};

/// Interval of the length of the true flow of the compared pixels, [min, max) [px].
struct FlowRange {
  double min_px = 0, max_px = std::numeric_limits<double>::infinity();
};

/// Compares two flow images, CV_32FC2 of one size, NaN where unknown.
/// Throws ArgumentError for others.
FlowError flow_error(const Image& flow, const Image& truth, const FlowRange& range = {});

}  // namespace placegraph
