#pragma once
#include <placegraph/eval/uncertainty/confidence_interval.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The direction in which a figure is good.
enum class Better {
  kSmaller,     ///< errors
  kLarger,      ///< coverage, recall
  kNearerZero,  ///< a drift or bias, of either sign
  kEqual,       ///< any change is worse: a target, a count that must hold
};
/// "smaller", "larger", "nearer zero", "equal".
const char* to_string(Better better);

/// One figure of a sequence with its value in every run.
struct FigureRecord {
  std::string key;                           ///< "ate_rmse_m"; unique in its sequence
  std::string unit;                          ///< "m", "%"; empty: none
  Better better = Better::kSmaller;          ///< a rule may say otherwise
  std::vector<std::optional<double>> values;  ///< one for each run; nothing: the run has none
  bool verdict = false;                      ///< the values are 0 (no) or 1 (yes)
  std::optional<double> whole;               ///< the values are counts out of so many
  std::string text;       ///< what stands around the number; another text is another figure
  double noise_floor = 0;  ///< what the noise of the truth adds, in the unit of the figure
  ConfidenceInterval interval;       ///< of its expectation, where the runs or the drive allow one

  /// The values that there are, by size: a figure does not depend on the order of the runs.
  std::vector<double> present() const;
  /// Their mean; nothing if there are none.
  std::optional<double> mean() const;
};

/// The true trajectory by which a sequence was judged.
struct TruthRecord {
  std::string fingerprint;  ///< of its poses, see truth_fingerprint(); empty: not a trajectory
  int frames = 0;           ///< posed frames
  double path_m = 0;        ///< length of its path
};

/// The figures of one sequence.
struct SequenceRecord {
  std::string name;                            ///< unique in its record
  TruthRecord truth;                         ///< what it was judged by
  /// How the figures were made: "align" -> "se3". Empty if no run has a result.
  std::map<std::string, std::string> options;
  std::optional<double> reference_s;  ///< CPU time of a fixed program in the same sitting
  std::vector<std::string> failures;  ///< a line for each run without a result: which, and why
  std::vector<FigureRecord> figures;  ///< in the order of the report

  /// The figure of that key, or nullptr.
  const FigureRecord* find(const std::string& key) const;
};

/// Results of a system: figures of every sequence and how they were made.
struct Record {
  std::vector<std::string> programs;  ///< versions that made the figures, each once
  std::vector<SequenceRecord> sequences;

  /// The sequence of that name, or nullptr.
  const SequenceRecord* find(const std::string& name) const;
  /// Throws ArgumentError for names and keys that are empty or stand twice, figures without values
  /// or of different numbers of runs in a sequence, and numbers that are not finite.
  void check() const;
};

/// Records of several runs of one system as one, run behind run.
///
/// `names` are those of the records, for messages. A sequence or figure that a record lacks is a
/// run without a value, and a failure says so. Throws ArgumentError if records differ in truth,
/// options, unit or whole of what both have: they are not runs of the same thing.
[[nodiscard]] Record merged(const std::vector<Record>& records,
                            const std::vector<std::string>& names);

/// Adds runs of a system to its record.
///
/// Those of a sequence that the record has stand behind its runs, other sequences behind its own.
/// `names` of the record and of what is added are for messages. Throws ArgumentError as merged().
void add_runs(const Record& more, const std::array<std::string, 2>& names, Record& record);

/// Why two sequences' figures may not be compared; empty if they may.
/// They may not with another truth, and with other options if both have some.
std::string difference_of(const SequenceRecord& a, const SequenceRecord& b);

/// The version of the format that to_json() writes.
inline constexpr int kRecordVersion = 1;

/// A record as JSON, a line for each figure, so that a diff shows what changed.
/// Throws as Record::check().
std::string to_json(const Record& record);

/// Reads what to_json() writes; `source` is the file's name in messages.
///
/// Throws FileError, one line with the place, for text that is no JSON, another format or version,
/// an unknown or repeated key, a value of another type, and what Record::check() refuses.
[[nodiscard]] Record parse_record(const std::string& text, const std::string& source);

}  // namespace placegraph
