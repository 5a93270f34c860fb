#pragma once
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/reliability.h>
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/recognition/loop_truth.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A place recognizer whose loops were judged.
struct LoopsPageSystem {
  std::string name;                        ///< name of the recognizer
  std::string file;                        ///< its predictions; a map.db beside them has thumbnails
  LoopBenchmark benchmark;                 ///< what they are worth
  std::optional<Reliability> reliability;  ///< where scores are probabilities
};

/// What a page of judged loops shows.
struct LoopsPage {
  std::string protocol;                  ///< definition of a true match, as text
  LoopTruth truth;                       ///< true matches, for the loops that were missed
  std::optional<Trajectory> poses;       ///< true poses, one per image; nothing: no scene
  std::string poses_file;                ///< their file; a sequence in its folder has thumbnails
  std::vector<LoopsPageSystem> systems;  ///< the recognizers, each a run of the page
};

/// The curve of precision over recall of a system.
struct NamedPrecisionRecall {
  std::string name;       ///< name of the system
  PrecisionRecall curve;  ///< its figures
};

/// Curves of precision over recall, SVG; `protocol`: how predictions were judged.
/// Throws ArgumentError if there is no curve.
std::string precision_recall_picture(const std::string& protocol,
                                     const std::vector<NamedPrecisionRecall>& systems);

/// Writes a page of judged loops, as `placegraph eval loops --report` does.
///
/// Every system is a run: its loops on the true poses, its figures, and the precision-recall curves
/// of all. `program`: name and version of the program. `log` takes a warning where there are no
/// images. Throws FileError if the page cannot be written.
void write_loops_page(const std::string& file, const LoopsPage& page, const std::string& program,
                      const LogSink& log = {});

}  // namespace placegraph
