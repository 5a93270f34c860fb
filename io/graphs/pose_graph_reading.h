#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct PoseGraphReading {
  /// Refuse a graph that falls into components, unless each has a fixed vertex: then all stand in
  /// one frame.
  bool connected = false;
  /// Takes what was passed over, a sentence each, for the caller to tell; without it that is
  /// refused.
  std::vector<std::string>* remarks = nullptr;
};

}  // namespace placegraph
