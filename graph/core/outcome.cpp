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

const char* to_string(DoubtKind kind) {
  switch (kind) {
    case DoubtKind::kChi2Above:
      return "chi2_above";
    case DoubtKind::kChi2Below:
      return "chi2_below";
    case DoubtKind::kNotUnique:
      return "not_unique";
    case DoubtKind::kLoopsNotJudged:
      return "loops_not_judged";
    case DoubtKind::kHeldComponents:
      return "held_components";
    case DoubtKind::kGraphFile:
      return "graph_file";
    case DoubtKind::kTrajectories:
      return "trajectories";
    case DoubtKind::kNotJudged:
      return "not_judged";
    case DoubtKind::kScoreOrder:
      return "score_order";
    case DoubtKind::kHeadings:
      return "headings";
    case DoubtKind::kQueryRefused:
      return "query_refused";
    case DoubtKind::kRecording:
      return "recording";
    case DoubtKind::kRetiredOption:
      return "retired_option";
  }
  return "unknown";
}

}  // namespace placegraph
