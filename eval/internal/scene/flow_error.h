#pragma once
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <limits>

namespace placegraph {

/// Optical flow against the truth, over the pixels whose true flow is known and stays inside.
struct FlowError {
  std::int64_t pixels = 0;    ///< with truth
  std::int64_t compared = 0;  ///< of those with an estimate
  double coverage = 0;        ///< compared / pixels
  double mean_px = 0;         ///< end-point error (Otte & Nagel 1994) of those compared
  double median_px = 0;
  double share_beyond_3px = 0;
};

/// Length of the true flow that pixels are to have, [min, max) [px].
struct FlowRange {
  double min_px = 0, max_px = std::numeric_limits<double>::infinity();
};

/// Both CV_32FC2 of one size, NaN where unknown; throws ArgumentError otherwise.
FlowError flow_error(const Image& flow, const Image& truth, const FlowRange& range = {});

}  // namespace placegraph
