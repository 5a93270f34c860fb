#pragma once
#include <placegraph/graph/recognition/loop_prediction.h>
#include <placegraph/graph/recognition/loop_truth.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Formats of a file with the loop closures that a place recognizer proposes.
enum class LoopFileFormat {
  kScores,  ///< a line `query candidate score [stage]` per proposal
  /// iBoW-LCD's output (Garcia-Fidalgo & Ortiz 2018), one line per image with seven columns: the
  /// window of matched images (both 0: nothing proposed), the matched image, whether it is
  /// consistent over time, the inliers of the epipolar geometry, words known, seconds.
  kIbow,
  /// loops.csv of a run: comma-separated columns named in the first line, of which `query`,
  /// `match`, `stage` and `probability` (the score) are read.
  kRun,
};

/// Reads the loop closures that a place recognizer proposes.
///
/// The score of iBoW-LCD is its number of inliers; lines with none are skipped, because no geometry
/// was found. Blank lines and comments (#) are skipped in `kScores`. Throws FileError with the
/// line: columns missing, not a number, negative images, a duplicate pair.
std::vector<LoopPrediction> read_loop_predictions(const std::string& path, LoopFileFormat format);

/// Writes `query candidate score` lines; the file is replaced as a whole. Throws FileError.
void write_loop_predictions(const std::string& path,
                            const std::vector<LoopPrediction>& predictions);

/// Formats of a file with the true loop closures of a sequence.
enum class LoopTruthFormat {
  kRanges,  ///< `q first last m1 m2 ...`: the candidates of q, both ends included, and its matches
  kLists,   ///< `q m1 m2 ...`; images that are not listed have no match
  kMatrix,  ///< a square of 0 and 1, row q and column m, blanks or commas between them
};

/// True loop closures as read from a file.
struct LoopTruthFile {
  LoopTruthFormat format = LoopTruthFormat::kRanges;  ///< the recognized format
  LoopTruth truth;                                    ///< min_age is 0
};

/// Reads true loop closures in any of the three formats.
///
/// The format is recognized from the lines: `-` (no match) or matches inside the range mean ranges,
/// as many lines as columns of 0 and 1 a matrix, ascending images lists. Throws FileError with the
/// line: another format, an image listed twice, matches outside their range, more than 1e9 images.
LoopTruthFile read_loop_truth(const std::string& path);

}  // namespace placegraph
