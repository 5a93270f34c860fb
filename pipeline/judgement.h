#pragma once
#include <placegraph/graph/measurements/data_note.h>
#include <placegraph/pipeline/run.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How far the result of a run can be trusted.
enum class Verdict {
  kGood,      ///< nothing contradicts the result
  kDoubtful,  ///< a finding limits what the result can be used for
  kFailed     ///< too few frames have a pose
};
const char* to_string(Verdict verdict);

/// Judgement of a run by its own evidence, without ground truth.
struct Judgement {
  Verdict verdict = Verdict::kGood;
  bool metric = false;             ///< whether lengths are in metres, as far as the run can tell
  std::string why_metric;          ///< what gives the map its scale, or why it has none
  std::vector<DataNote> findings;  ///< what is in doubt, each with its cause and what to try next
};

/// Judges a run by its map, by the notes of its frames (RunResult::notes) and by `notes` on its
/// data and options. `min_posed` is the share of frames in [0, 1] that must have a pose.
Judgement judge(const RunResult& run, const std::vector<DataNote>& notes, double min_posed);

}  // namespace placegraph
