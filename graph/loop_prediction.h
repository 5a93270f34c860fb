#pragma once
#include <placegraph/graph/core/ids.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// What a place recognizer says of one image: that it shows what an older one showed.
struct LoopPrediction {
  FrameId query;
  FrameId candidate;
  double score = 0;   ///< larger is surer, comparable over all queries
  std::string stage;  ///< that rejected it, or "accepted", where the recognizer says so
  int line = 0;       ///< of the file it was read from
};

}  // namespace placegraph
