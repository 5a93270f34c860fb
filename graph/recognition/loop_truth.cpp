#include <placegraph/graph/core/error.h>
#include <placegraph/graph/recognition/loop_truth.h>

namespace placegraph {

std::string to_string(LoopProtocol protocol) {
  switch (protocol) {
    case LoopProtocol::kUndecided:
      return "undecided";
    case LoopProtocol::kWithinDrive:
      return "within one drive";
    case LoopProtocol::kQueryDatabase:
      return "queries against a database";
  }
  throw ArgumentError("unknown protocol");
}

}  // namespace placegraph
