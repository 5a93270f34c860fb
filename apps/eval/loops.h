#pragma once
#include <placegraph/eval/internal/loops/reliability.h>
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/io/measurements/loop_file.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct LoopsArguments {
  std::vector<std::string> predictions;  ///< files of what systems found
  std::vector<std::string> names;        ///< of the systems; empty: the names of their files
  std::vector<LoopFileFormat> formats = {LoopFileFormat::kScores};  ///< one for all, or one each
  std::string truth;              ///< ground truth: matches of every query; or
  std::string poses;           ///< ground truth: one true pose per image
  RevisitOptions revisit;      ///< with `poses`; its age is the next member's
  std::optional<int> min_age;  ///< images by which a candidate must be older
  int tolerance = 0;           ///< images by which a candidate may miss a true match
  std::string csv, plot;       ///< files to write; empty: none
  bool force = false;          ///< overwrite them
};

/// How one system did.
struct LoopJudgement {
  std::string name, path;
  LoopBenchmark benchmark;
  std::optional<Reliability> reliability;  ///< where scores are probabilities
};

struct LoopsResult {
  std::string protocol;  ///< what counted as a match, in words
  std::vector<LoopJudgement> systems;
};

/// `placegraph loops`: judges what place recognizers found, and writes the files asked for. Throws
/// ArgumentError, FileError.
LoopsResult loops(const LoopsArguments& arguments);

/// A table, one row per system, with remarks below it.
std::string to_text(const LoopsResult& result);
std::string to_json(const LoopsResult& result);

}  // namespace placegraph::apps
