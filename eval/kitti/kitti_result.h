#pragma once
#include <placegraph/eval/association/frame_pair.h>
#include <placegraph/eval/errors/kitti_segments.h>
#include <placegraph/graph/core/outcome.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Mean errors of the segments of one length or about one speed, as KITTI's devkit has them.
struct KittiRow {
  double at = 0;              ///< length [m], or speed [m/s]
  int segments = 0;           ///< number of segments in the mean, three or more
  double t_percent = 0;       ///< mean error in translation [%]
  double r_deg_per_100m = 0;  ///< mean error in rotation
};

/// The figures of the devkit over the segments of one sequence or of several.
struct KittiFigures {
  Outcome outcome;                  ///< kTooFewData if there is no segment
  int segments = 0;                 ///< number of segments
  double t_rel_percent = 0;         ///< mean over all segments; only if outcome
  double r_rel_deg_per_100m = 0;    ///< likewise
  std::vector<KittiRow> by_length;  ///< lengths that three segments have or more
  std::vector<KittiRow> by_speed;   ///< speeds likewise; their intervals overlap
};

/// What is wrong with a submission, or what seems so.
struct KittiFault {
  std::string file;  ///< path of the file, which may be the one that is missing
  int line = 0;      ///< the first line that has the fault, from 1; 0: the file as a whole
  std::string text;  ///< one readable line
};

/// The text "file:line: text" of a fault, as messages have it.
std::string to_string(const KittiFault& fault);

/// One sequence of a submission.
struct KittiSequence {
  std::string name;        ///< "00"
  std::string file;        ///< path of the estimate; empty if it is missing
  bool has_truth = false;  ///< false: only the form was checked
  bool faulty = false;     ///< a fault is one of the estimate of this sequence
  int frames = 0;          ///< frames of the sequence, 0 if they are not known
  double path_m = 0;       ///< length of the true path
  KittiFigures figures;    ///< kNotAttempted without truth, and where the estimate has a fault
  std::vector<SegmentError> segments;  ///< those of the figures
  std::vector<FramePair> pairs;        ///< true and estimated poses T_world_cam of every frame
};

/// The submission of one system: estimates of the camera's poses in several sequences.
struct KittiSystem {
  std::string name;                      ///< of the system, for tables and legends
  std::vector<KittiSequence> sequences;  ///< by their names
  std::vector<KittiFault> faults;        ///< none: the submission is sound
  std::vector<KittiFault> warnings;      ///< what seems wrong but is not against the form
  /// Figures over the segments of all sequences that have a truth, as the benchmark ranks by them.
  /// kInconsistent if one of them has no figures of its own for a fault: no mean leaves it out.
  KittiFigures mean;
};

/// Several systems, judged on the same sequences.
struct KittiBenchmark {
  std::vector<KittiSystem> systems;  ///< in the order they were given

  /// Number of faults of all submissions.
  std::size_t faults() const;
};

}  // namespace placegraph
