#pragma once
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/eval/loops/reliability.h>
#include <placegraph/io/measurements/loop_file.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct LoopsArguments {
  std::vector<std::string> predictions;  ///< files of predictions, one per system
  std::vector<std::string> names;        ///< names of the systems; empty: the names of their files
  std::vector<LoopFileFormat> formats = {
      LoopFileFormat::kScores};  ///< formats of the files: one for all, or one each
  std::string truth;             ///< ground truth: matches of every query; or
  std::string poses;             ///< ground truth: one true pose per image
  RevisitOptions revisit;        ///< only with `poses`; `min_age` below replaces its age
  std::optional<int> min_age;    ///< smallest age of a candidate, in images
  int tolerance = 0;             ///< largest distance from a true match, in images
  std::string csv, plot;         ///< files to write; empty: none
  std::string report;            ///< page that the caller writes; empty: none
  bool force = false;            ///< overwrite them
};

/// Evaluation of one system.
struct LoopJudgement {
  std::string name, path;
  LoopBenchmark benchmark;
  std::optional<Reliability> reliability;  ///< where scores are probabilities
};

struct LoopsResult {
  std::string protocol;  ///< definition of a true match, as text
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
