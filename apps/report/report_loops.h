#pragma once
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/reliability.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/recognition/loop_truth.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

/// A place recognizer whose loops were judged.
struct LoopsPageSystem {
  std::string name;
  std::string file;  ///< its predictions; a map.db beside them has thumbnails
  LoopBenchmark benchmark;
  std::optional<Reliability> reliability;  ///< where scores are probabilities
};

/// What a page of judged loops shows.
struct LoopsPage {
  std::string protocol;             ///< definition of a true match, as text
  LoopTruth truth;                  ///< true matches, for the loops that were missed
  std::optional<Trajectory> poses;  ///< true poses, one per image; nothing: no scene
  std::string poses_file;           ///< their file; a sequence in its folder has thumbnails
  std::vector<LoopsPageSystem> systems;
};

/// A judged loop of a page.
struct PageLoop {
  FrameId query, match;
  double score = 0;     ///< not a number for a missed one
  int rank = 0;         ///< rank of the first true candidate; 0: none
  std::string verdict;  ///< "right", "wrong" or "missed"
  std::string reason;   ///< test that decided, or why nothing was proposed; may be empty
};

/// The best candidate of every query, right or wrong, and for a query with a true match and no
/// candidate the middle one of its true matches, as missed; by query.
std::vector<PageLoop> page_loops(const LoopBenchmark& benchmark, const LoopTruth& truth);

/// Writes a page with every system as a run: its loops on the true poses, its figures, and the
/// precision-recall curves of all. `program`: name and version of the program.
/// Throws FileError if it cannot be written.
void write_loops_page(const std::string& file, const LoopsPage& page, const std::string& program);

}  // namespace placegraph::apps
