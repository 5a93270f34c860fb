#pragma once
#include <placegraph/eval/gate/gate.h>

namespace placegraph {

/// A figure of both systems with its rule.
struct FigurePair {
  const SequenceRecord& before_sequence;
  const SequenceRecord& after_sequence;
  const FigureRecord& before;
  const FigureRecord& after;
  GateRule rule;

  Better better() const { return rule.better.value_or(after.better); }
  /// What the noise of the truth adds to the figure.
  double floor() const;
};

/// By how much `after` is worse than `before`; negative: better.
double worsening(Better better, double before, double after);

/// Texts, values and change of a pair; its standing is not yet decided.
GateFigure described(const FigurePair& pair);

/// Decides what needs no test: figures that are lost, new, of another form, for information, or verdicts.
/// Returns false if the values themselves must be judged.
bool judge_presence(const FigurePair& pair, GateFigure& figure);

/// Decides by the tolerances of the rule.
void judge_by_tolerance(const FigurePair& pair, GateFigure& figure);

/// A number as reports write it: four digits.
std::string number_text(double value);

}  // namespace placegraph
