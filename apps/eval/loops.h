#pragma once
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/eval/loops/reliability.h>
#include <placegraph/io/loops/image_set.h>
#include <placegraph/io/loops/loop_file.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct LoopsArguments {
  std::vector<std::string> predictions;  ///< files of predictions, one per system
  std::vector<std::string> names;        ///< names of the systems; empty: the names of their files
  std::vector<LoopFileFormat> formats = {
      LoopFileFormat::kScores};  ///< formats of the files: one for all, or one each
  std::string scores_of_top_k;   ///< scores of the candidates of a search; empty: their order
  std::optional<ScoreKind> scores;  ///< what scores are; nothing: as the file says, else similarities
  std::string truth;                ///< ground truth: matches of every query; or
  std::string poses;                ///< ground truth: one true pose or position per image; or
  std::string queries, database;    ///< ground truth: where the images of two sets were taken
  bool within = false;              ///< candidates are older images of the queries' own drive
  RevisitOptions revisit;  ///< only with poses and positions; `min_age` below replaces its age
  std::optional<int> min_age;    ///< smallest age of a candidate, in images
  int tolerance = 0;             ///< largest distance from a true match, in images
  std::string csv, plot, curve;  ///< files to write; empty: none
  std::string report;            ///< page that the caller writes; empty: none
  bool force = false;            ///< overwrite them
};

/// Evaluation of one system.
struct LoopJudgement {
  std::string name, path;
  std::string form;  ///< what was read
  LoopBenchmark benchmark;
  std::optional<Reliability> reliability;  ///< where scores are probabilities
};

struct LoopsResult {
  std::string protocol;  ///< candidates of a query and definition of a true match, as text
  std::vector<LoopJudgement> systems;
  LoopTruth truth;                  ///< the true matches
  std::optional<Trajectory> poses;  ///< the true poses, where these are the ground truth
};

/// Evaluates place recognizers and writes the requested files: `placegraph eval loops`.
/// Throws ArgumentError, FileError.
LoopsResult loops(const LoopsArguments& arguments);

/// A table, one row per system, with remarks below it.
std::string to_text(const LoopsResult& result);
std::string to_json(const LoopsResult& result);

}  // namespace placegraph::apps
