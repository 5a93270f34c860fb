#pragma once
#include <placegraph/graph/recognition/loop_prediction.h>
#include <placegraph/graph/recognition/loop_truth.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct ImageSet;

/// Formats of a file with the loop closures that a place recognizer proposes.
enum class LoopFileFormat {
  /// A line `query candidate score [stage]` per proposal, or a `.npy` matrix of three columns.
  kScores,
  /// iBoW-LCD's output (Garcia-Fidalgo & Ortiz 2018), one line per image with seven columns: the
  /// window of matched images (both 0: nothing proposed), the matched image, whether it is
  /// consistent over time, the inliers of the epipolar geometry, words known, seconds.
  kIbow,
  /// loops.csv of a run: comma-separated columns named in the first line, of which `query`,
  /// `match`, `stage` and `probability` (the score) are read.
  kRun,
  /// The candidates of a query per row, the best first, as FAISS returns them; -1: none.
  kTopK,
  /// A matrix of scores, a row per query and a column per candidate; nan: none.
  kMatrix,
};

/// How a file of predictions is read.
struct LoopFileOptions {
  LoopFileFormat format = LoopFileFormat::kScores;  ///< format of the file
  std::string scores_of_top_k;           ///< with kTopK: a file of the same shape with the scores
  const ImageSet* queries = nullptr;     ///< images whose names stand for queries; may be null
  const ImageSet* candidates = nullptr;  ///< images whose names stand for candidates; may be null
};

/// Predictions as read from a file.
struct LoopPredictionFile {
  std::vector<LoopPrediction> predictions;  ///< in the order of the file
  /// What the file says that its scores are, by the name of their column; nothing if it does not.
  std::optional<ScoreKind> scores;
  std::string form;  ///< what was read: "lines of query, candidate and score" and so on
};

/// Reads the loop closures that a place recognizer proposes.
///
/// Tables of kScores have blanks, tabs, commas or semicolons, and may have a header, which is obeyed:
/// `query`, `candidate`, `score` or `distance`, `stage` and their usual other names; other columns
/// are passed over. Numbers may be written as by numpy. With names of images a query or candidate is
/// a name, its path or its end; without scores the order of lines is that of certainty. The score of
/// iBoW-LCD is its number of inliers; lines with none are skipped, because no geometry was found.
/// Throws FileError with the line: columns missing, not a number, negative images, unknown names, a
/// pair that stands twice.
LoopPredictionFile read_loop_prediction_file(const std::string& path,
                                             const LoopFileOptions& options);
/// The predictions of a file alone.
/// Throws FileError as read_loop_prediction_file.
std::vector<LoopPrediction> read_loop_predictions(const std::string& path, LoopFileFormat format);

/// Predictions of a search, whose row q has the best candidates of query q in their order.
///
/// -1 stands for none. Both are matrices row by row, of `columns` columns; without scores the order gives them: -1 for
/// the first, -2 for the second. Throws ArgumentError: sizes, a candidate that is no image, a score
/// that is not finite, a candidate twice.
std::vector<LoopPrediction> predictions_of_search(const std::vector<std::int64_t>& candidates,
                                                  const std::vector<double>& scores,
                                                  std::size_t columns);
/// Predictions of a matrix of scores, row by row, of `columns` columns; nan: none.
/// Throws ArgumentError: sizes, an infinite score.
std::vector<LoopPrediction> predictions_of_matrix(const std::vector<double>& scores,
                                                  std::size_t columns);

/// Writes `query candidate score` lines; the file is replaced as a whole. Throws FileError.
void write_loop_predictions(const std::string& path,
                            const std::vector<LoopPrediction>& predictions);

/// Formats of a file with the true loop closures of a sequence.
enum class LoopTruthFormat {
  kRanges,  ///< `q first last m1 m2 ...`: the candidates of q, both ends included, and its matches
  kLists,   ///< `q m1 m2 ...`; images that are not listed have no match
  kMatrix,  ///< a matrix of 0 and 1, row q and column m, as text or `.npy`
};

/// True loop closures as read from a file.
struct LoopTruthFile {
  LoopTruthFormat format = LoopTruthFormat::kRanges;  ///< the recognized format
  /// min_age is 0. The protocol is kQueryDatabase for a matrix with another number of columns than of
  /// rows and for ranges that do not end before their queries, kWithinDrive for other ranges, else
  /// kUndecided.
  LoopTruth truth;
  std::string form;  ///< what was read: "a matrix of 30 x 40 matches" and so on
};

/// Reads true loop closures in any of the three formats.
///
/// The format is recognized from the lines: `-` (no match) or matches inside the range mean ranges,
/// rows of equal length of 0 and 1 a matrix, ascending images lists. Blanks, tabs, commas or
/// semicolons separate the fields, and a header of a matrix is passed over. Throws FileError with the
/// line: another format, an image listed twice, matches outside their range, more than 1e9 images.
LoopTruthFile read_loop_truth(const std::string& path);

}  // namespace placegraph
