#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a reader of pose graphs refuses, and what it reports.
struct PoseGraphReading {
  /// Refuse a graph of several components, unless each has a fixed vertex or a measured position:
  /// then all are in one coordinate frame.
  bool connected = false;
  /// Receives a sentence for what was skipped (time stamps behind vertices); where it is null, such
  /// a file is refused.
  std::vector<std::string>* remarks = nullptr;
};

}  // namespace placegraph
