#pragma once
#include <placegraph/graph/core/ids.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// A place recognizer's claim that an image shows the same place as an older one.
struct LoopPrediction {
  FrameId query;      ///< the image
  FrameId candidate;  ///< the older image
  double score = 0;   ///< larger is surer, comparable over all queries
  std::string stage;  ///< the test that refused it, or "accepted"; empty where it is not known
  int line = 0;       ///< of the file that it was read from; 0 if it was not read
};

}  // namespace placegraph
