#pragma once
#include <placegraph/eval/gate/record.h>

#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// By what a figure of a candidate is judged.
struct GateRule {
  /// How it is judged.
  enum class Kind {
    kTolerance,    ///< worse by more than a tolerance
    kSignificant,  ///< worse by more than the scatter of the runs, or of the sequences, explains
    kInfo,         ///< reported, never worse
    kTime,         ///< reported, beside the ratio to the reference programs of the two sittings
    kIgnore,       ///< not even reported
  };
  Kind kind = Kind::kTolerance;
  std::optional<Better> better;       ///< in place of the record's
  double relative = 0, absolute = 0;  ///< tolerances: the larger of the two is allowed
  double floor = 0;                   ///< no difference up to this counts, however significant
  double find = 0;         ///< kSignificant: relative effect that the runs must be able to find
  bool otherwise = false;  ///< kSignificant: the tolerances hold where there are too few runs
  bool over_sequences = false;  ///< kSignificant: in pairs over the sequences, not over runs
  bool whole_may_change = false;  ///< counts of another whole are compared by their shares
  std::string text;               ///< as it was written
};

/// The rules of a gate. `*` of a pattern stands for anything, all else for itself.
struct GateRules {
  struct Line {
    std::string sequence, figure;  ///< patterns
    GateRule rule;
  };
  struct Must {
    std::string sequence, figure;  ///< patterns: some figure of the candidate fits
  };
  struct Rename {
    std::string sequence;               ///< pattern of the older name
    std::optional<std::string> figure;  ///< pattern of the older key; nothing: of a sequence
    std::string name;                   ///< the new one, or "(gone)"
  };
  std::vector<Line> lines;
  std::vector<Must> musts;
  std::vector<Rename> renames;

  /// The rule of the first line that fits; without one, what gets worse at all is worse.
  GateRule rule_of(const std::string& sequence, const std::string& figure) const;
  /// The present name of a sequence or figure of a baseline; nothing if it is known to be gone.
  std::optional<std::string> sequence_now(const std::string& name) const;
  std::optional<std::string> figure_now(const std::string& sequence, const std::string& key) const;
};

/// Whether a name fits a pattern.
bool fits_pattern(const std::string& pattern, const std::string& name);

/// Reads rules, a line each: `SEQUENCE | FIGURE | RULE` and others.
///
/// docs/evaluation.md lists them. Lines that begin with # are comments. Throws FileError, which
/// names `source` and the line.
[[nodiscard]] GateRules parse_rules(const std::string& text, const std::string& source);

/// The rules of a gate that is given none: those of docs/evaluation.md.
const GateRules& default_rules();
/// Their text.
const std::string& default_rules_text();

}  // namespace placegraph
