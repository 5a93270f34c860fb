#pragma once
#include <placegraph/graph/core/ids.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A place recognizer's prediction that an image shows the same place as an older image.
struct LoopPrediction {
  FrameId query;      ///< the image
  FrameId candidate;  ///< the older image
  double score = 0;   ///< larger is more certain; comparable over all queries
  std::string stage;  ///< the test that refused it, or "accepted"; empty if unknown
  int line = 0;       ///< line of the file that it was read from; 0 if it was not read
};

}  // namespace placegraph
