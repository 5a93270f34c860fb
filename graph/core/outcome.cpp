#include <placegraph/graph/core/outcome.h>

namespace placegraph {

const char* to_string(Outcome::Code code) {
  switch (code) {
    case Outcome::Code::kOk:
      return "ok";
    case Outcome::Code::kTooFewData:
      return "too few data";
    case Outcome::Code::kNoConsensus:
      return "no consensus";
    case Outcome::Code::kDegenerate:
      return "degenerate";
    case Outcome::Code::kNotConverged:
      return "not converged";
    case Outcome::Code::kInconsistent:
      return "inconsistent";
    case Outcome::Code::kNotAttempted:
      return "not attempted";
  }
  return "unknown";
}

}  // namespace placegraph
