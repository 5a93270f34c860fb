#pragma once
#include <placegraph/eval/gate/gate_rules.h>
#include <placegraph/eval/gate/record.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// How far tests of a gate may err, and what its messages call the two systems.
struct GateOptions {
  /// Probability that a candidate equal to the baseline is called worse by any of the tests.
  double level = 0.05;
  double power = 0.80;  ///< probability of finding the effect by which runs are counted
  std::string baseline = "baseline", candidate = "candidate";
  /// Throws ArgumentError unless both numbers are between 0 and 1.
  void check() const;
};

/// What a gate says of a figure, the worst first.
enum class Standing {
  kRegressed,  ///< worse than its rule allows, or lost
  kUnjudged,   ///< other truth, other options, or too few runs
  kImproved,   ///< better by more than the rule would allow the other way
  kWithin,     ///< another value, within what the rule allows
  kNew,        ///< the baseline has none
  kReported,       ///< for information
  kSame,       ///< the same to the digit
};
/// The name of a standing, as reports have it.
/// They are "regressed", "cannot be judged", "improved", "within the rule", "new",
/// "for information", "same".
const char* to_string(Standing standing);

/// One figure of one sequence, judged.
struct GateFigure {
  std::string sequence, figure, unit;   ///< `figure` is empty where the whole sequence is meant
  Standing standing = Standing::kSame;
  std::optional<double> before, after;  ///< means over runs
  std::string before_text, after_text;  ///< "1.302", "23 of 24", "yes", "-"
  std::string change;                   ///< "+12.3 %"; empty: none
  double worse_by = 0;  ///< relative worsening, the order of a report; infinite: lost
  std::string rule;     ///< as it was written
  std::string reason;   ///< a plain sentence
  int runs_needed = 0;  ///< of each system, where runs are too few; 0: not known, or enough
};

/// A candidate judged against a baseline.
struct GateResult {
  Standing verdict = Standing::kSame;  ///< kRegressed, kUnjudged, or kSame: all right
  std::vector<GateFigure> figures;     ///< the worst first
  std::string sentence;                ///< the verdict in a line
  std::string baseline, candidate;     ///< their names, with versions of the programs

  /// How many figures stand so.
  int count(Standing standing) const;
  /// 0 all right, 1 regressed, 2 cannot be judged.
  int exit_code() const;
};

/// Judges a candidate by the rules.
///
/// A figure, a sequence or a run that the baseline has and the candidate lacks is regressed, under
/// every rule but `ignore`. Figures of another truth or other options are not judged. The tests of
/// all figures together err with `level` (Holm 1979), so the verdict on one figure depends on how
/// many are tested. The result does not depend on the order of runs, sequences and figures.
/// Throws ArgumentError as Record::check() and GateOptions::check().
[[nodiscard]] GateResult judge(const Record& baseline, const Record& candidate,
                               const GateRules& rules = default_rules(),
                               const GateOptions& options = {});

/// A gate's result for people: the verdict, a table, and sentences.
///
/// Figures that are the same to the digit stand in it only with `everything`.
std::string to_text(const GateResult& result, bool everything = true);

/// All of a gate's result as JSON.
std::string to_json(const GateResult& result);

/// A page for a pull request: what regressed first, the rest folded.
std::string to_markdown(const GateResult& result);

/// JUnit's XML with a test case for each figure.
///
/// It is a failure where the figure regressed, an error where it cannot be judged. Characters that
/// XML does not allow become question marks.
std::string to_junit(const GateResult& result);

}  // namespace placegraph
