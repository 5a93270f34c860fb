#pragma once
#include <placegraph/graph/loop_prediction.h>
#include <placegraph/graph/loop_truth.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How a file says what a place recognizer found.
enum class LoopFileFormat {
  kScores,  ///< `query candidate score [stage]` a line
  /// iBoW-LCD's output (Garcia-Fidalgo & Ortiz 2018), one line per image with seven columns: the
  /// window of matched images (both 0: nothing proposed), the matched image, whether it is
  /// consistent over time, the inliers of the epipolar geometry, words known, seconds.
  kIbow,
  /// loops.csv of a run: comma-separated columns named in the first line, of which `query`,
  /// `match`, `stage` and `probability` (the score) are read.
  kRun,
};

/// Hypotheses of a recognizer. Of iBoW's the score is the number of inliers, and those without any
/// are none: their geometry was never found. Blank lines and `#` begin no prediction in `kScores`.
/// Throws FileError with the line: columns missing, no number, negative images, one pair said
/// twice.
std::vector<LoopPrediction> read_loop_predictions(const std::string& path, LoopFileFormat format);

/// Writes `query candidate score` lines, atomically. Throws FileError.
void write_loop_predictions(const std::string& path,
                            const std::vector<LoopPrediction>& predictions);

enum class LoopTruthFormat {
  kRanges,  ///< `q first last m1 m2 ...`: the candidates of q, both ends included, and its matches
  kLists,   ///< `q m1 m2 ...`; images that are not listed have no match
  kMatrix,  ///< a square of 0 and 1, row q and column m, blanks or commas between them
};

struct LoopTruthFile {
  LoopTruthFormat format = LoopTruthFormat::kRanges;
  LoopTruth truth;  ///< min_age is 0
};

/// Ground truth in any of the three forms, told apart by what the lines hold: `-` (no match) or
/// matches inside the range make ranges, as many lines as columns of 0 and 1 a matrix, ascending
/// images lists. Throws FileError with the line: another form, an image listed twice, matches
/// outside their range, more than 1e9 images.
LoopTruthFile read_loop_truth(const std::string& path);

}  // namespace placegraph
