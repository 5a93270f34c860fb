#pragma once
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of a pose graph reader: what it rejects and where it reports.
struct PoseGraphReading {
  /// Reject a graph of several components, unless each has a fixed vertex or a measured position:
  /// then all are in one coordinate frame.
  bool connected = false;
  /// Receives a sentence about skipped data (time stamps after vertices); if it is null, such a
  /// file is rejected.
  std::vector<std::string>* remarks = nullptr;
};

}  // namespace placegraph
