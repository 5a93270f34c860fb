#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/gate/figure_judge.h>
#include <placegraph/eval/gate/gate.h>
#include <placegraph/eval/gate/significance.h>
#include <placegraph/eval/uncertainty/run_interval.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace placegraph {
namespace {

using Pairs = std::vector<FigurePair>;

GateFigure of_sequence(const std::string& sequence, const std::string& figure, Standing standing,
                       const std::string& reason) {
  GateFigure one;
  one.sequence = sequence;
  one.figure = figure;
  one.standing = standing;
  one.reason = reason;
  one.before_text = one.after_text = "-";
  if (standing == Standing::kRegressed) one.worse_by = std::numeric_limits<double>::infinity();
  return one;
}

/// A figure over all its sequences: the means of its means.
GateFigure described_over_sequences(const Pairs& pairs) {
  GateFigure figure = described(pairs.front());
  figure.sequence = fmt::format("(all {})", pairs.size());
  double before = 0, after = 0;
  for (const FigurePair& pair : pairs) {
    before += *pair.before.mean() / static_cast<double>(pairs.size());
    after += *pair.after.mean() / static_cast<double>(pairs.size());
  }
  figure.before = before;
  figure.after = after;
  figure.before_text = number_text(before);
  figure.after_text = number_text(after);
  const double worse = worsening(pairs.front().better(), before, after);
  figure.change = before == 0 ? "" : fmt::format("{:+.3g} %", 100 * (after / before - 1));
  figure.worse_by = before == 0 ? worse : worse / std::abs(before);
  return figure;
}

/// A figure whose rule asks for a test that cannot be made.
struct Untested {
  GateTest test;
  FigurePair pair;
  bool too_few;  ///< for too few runs or sequences
};

/// The work of judge(): what belongs together is paired, judged, tested, and put in order.
class Gate {
 public:
  Gate(const Record& baseline, const Record& candidate, const GateRules& rules,
       const GateOptions& options)
      : baseline_(baseline), candidate_(candidate), rules_(rules), options_(options) {}

  GateResult run() {
    for (const SequenceRecord& before : baseline_.sequences) judge_sequence(before);
    for (const SequenceRecord& after : candidate_.sequences)
      if (!std::ranges::count(judged_, after.name))
        add(of_sequence(after.name, "", Standing::kNew, "the baseline has no such sequence"));
    for (const GateRules::Must& must : rules_.musts) check_must(must);
    for (const auto& [unused, pairs] : over_sequences_) judge_over_sequences(pairs);
    decide_tests(tests_, options_, figures_);
    for (const Untested& one : untested_) decide_untested(one, figures_[one.test.figure]);
    return concluded();
  }

 private:
  void add(GateFigure figure) { figures_.push_back(std::move(figure)); }

  /// A sequence or figure that is ignored has no line.
  bool ignored(const std::string& sequence, const std::string& key) const {
    return rules_.rule_of(sequence, key).kind == GateRule::Kind::kIgnore;
  }

  void judge_sequence(const SequenceRecord& before) {
    const std::optional<std::string> name = rules_.sequence_now(before.name);
    if (!name) return;
    const auto all_ignored = [&] {
      return std::ranges::all_of(before.figures, [&](const FigureRecord& figure) {
        return ignored(*name, figure.key);
      });
    };
    const SequenceRecord* after = candidate_.find(*name);
    judged_.push_back(*name);
    if (!after) {
      if (before.figures.empty() || !all_ignored())
        add(of_sequence(*name, "", Standing::kRegressed, "the candidate lacks the sequence"));
      return;
    }
    if (const std::string other = difference_of(before, *after); !other.empty()) {
      if (!all_ignored()) add(of_sequence(*name, "", Standing::kUnjudged, other));
      return;
    }
    judge_figures(before, *after);
  }

  void judge_figures(const SequenceRecord& before, const SequenceRecord& after) {
    std::vector<std::string> known;
    for (const FigureRecord& figure : before.figures) {
      const std::optional<std::string> key = rules_.figure_now(after.name, figure.key);
      if (!key) continue;
      known.push_back(*key);
      if (ignored(after.name, *key)) continue;
      if (const FigureRecord* now = after.find(*key))
        judge_figure({before, after, figure, *now, rules_.rule_of(after.name, *key)});
      else if (figure.mean() || !figure.text.empty())
        add(of_sequence(after.name, *key, Standing::kRegressed, "the candidate lacks the figure"));
    }
    for (const FigureRecord& figure : after.figures)
      if (!std::ranges::count(known, figure.key) && !ignored(after.name, figure.key))
        add(of_sequence(after.name, figure.key, Standing::kNew, "the baseline has no such figure"));
  }

  void judge_figure(const FigurePair& pair) {
    GateFigure figure = described(pair);
    const bool decided = judge_presence(pair, figure);
    if (!decided && pair.rule.kind == GateRule::Kind::kTolerance) judge_by_tolerance(pair, figure);
    add(std::move(figure));
    if (decided || pair.rule.kind != GateRule::Kind::kSignificant) return;
    if (pair.rule.over_sequences) {
      figures_.back().standing = Standing::kReported;
      figures_.back().reason = "judged over all sequences";
      over_sequences_[pair.after.key].push_back(pair);
      return;
    }
    test(figures_.size() - 1, pair, [&pair](GateTest& one) { return test_runs(pair, one); });
  }

  template <class Test>
  void test(std::size_t index, const FigurePair& pair, const Test& fill) {
    GateTest one;
    one.figure = index;
    const Outcome outcome = fill(one);
    if (outcome) {
      tests_.push_back(one);
      return;
    }
    figures_[index].reason = outcome.reason;
    figures_[index].standing = Standing::kUnjudged;
    untested_.push_back({one, pair, outcome.code == Outcome::Code::kTooFewData});
  }

  void judge_over_sequences(const Pairs& pairs) {
    add(described_over_sequences(pairs));
    test(figures_.size() - 1, pairs.front(),
         [&pairs](GateTest& one) { return test_pairs(pairs, one); });
  }

  void decide_untested(const Untested& one, GateFigure& figure) const {
    if (one.pair.rule.otherwise && !one.pair.rule.over_sequences) {
      const std::string why = figure.reason;
      judge_by_tolerance(one.pair, figure);
      if (figure.reason.empty()) figure.reason = why + ", so by its tolerance";
      return;
    }
    if (!one.too_few) return;
    // Where the one lacks runs, the other may know how many are needed.
    figure.runs_needed = kFewestRuns;
    if (!one.pair.rule.over_sequences)
      figure.runs_needed =
          std::max(kFewestRuns, runs_needed_for(one.test, tests_.size() + untested_.size(),
                                                options_));
    figure.reason += fmt::format(": {} {} are needed", figure.runs_needed,
                                 one.pair.rule.over_sequences ? "sequences" : "runs of each");
  }

  void check_must(const GateRules::Must& must) {
    for (const SequenceRecord& sequence : candidate_.sequences)
      for (const FigureRecord& figure : sequence.figures)
        if (fits_pattern(must.sequence, sequence.name) && fits_pattern(must.figure, figure.key) && figure.mean())
          return;
    add(of_sequence(must.sequence, must.figure, Standing::kRegressed,
                    "the rules ask for a figure that the candidate lacks"));
  }

  GateResult concluded();

  const Record &baseline_, &candidate_;
  const GateRules& rules_;
  const GateOptions& options_;
  std::vector<GateFigure> figures_;
  std::vector<std::string> judged_;       ///< sequences of the candidate that have a partner
  std::map<std::string, Pairs> over_sequences_;
  std::vector<GateTest> tests_;
  std::vector<Untested> untested_;
};

std::string name_of(const std::string& name, const Record& record) {
  return record.programs.empty()
             ? name
             : fmt::format("{} ({})", name, fmt::join(record.programs, ", "));
}

std::string sentence_of(const GateResult& result) {
  const int worse = result.count(Standing::kRegressed), open = result.count(Standing::kUnjudged);
  const std::string of = fmt::format("of {} figures", result.figures.size());
  const auto first = [&result] {
    const GateFigure& worst = result.figures.front();
    return fmt::format("{}{}{}: {}", worst.sequence, worst.figure.empty() ? "" : " ",
                       worst.figure, worst.reason);
  };
  if (worse > 0)
    return fmt::format("{} {} {} worse; the worst is {}", worse, of, worse == 1 ? "is" : "are",
                       first());
  if (open > 0) return fmt::format("{} {} cannot be judged; the first is {}", open, of, first());
  return "no figure " + of + " is worse than its rule allows";
}

GateResult Gate::concluded() {
  std::ranges::sort(figures_, [](const GateFigure& a, const GateFigure& b) {
    return std::tuple(a.standing, -a.worse_by, a.sequence, a.figure) <
           std::tuple(b.standing, -b.worse_by, b.sequence, b.figure);
  });
  GateResult result;
  result.figures = std::move(figures_);
  result.baseline = name_of(options_.baseline, baseline_);
  result.candidate = name_of(options_.candidate, candidate_);
  // A gate that has judged nothing lets nothing pass.
  if (result.figures.empty())
    result.figures.push_back(
        of_sequence("-", "", Standing::kUnjudged, "there is no figure to judge"));
  if (result.count(Standing::kRegressed) > 0)
    result.verdict = Standing::kRegressed;
  else if (result.count(Standing::kUnjudged) > 0)
    result.verdict = Standing::kUnjudged;
  result.sentence = sentence_of(result);
  return result;
}

}  // namespace

const char* to_string(Standing standing) {
  switch (standing) {
    case Standing::kRegressed: return "regressed";
    case Standing::kUnjudged: return "cannot be judged";
    case Standing::kImproved: return "improved";
    case Standing::kWithin: return "within the rule";
    case Standing::kNew: return "new";
    case Standing::kReported: return "for information";
    case Standing::kSame: break;
  }
  return "same";
}

void GateOptions::check() const {
  require(level > 0 && level < 1, "the level of the tests is between 0 and 1");
  require(power > 0 && power < 1, "the power of the tests is between 0 and 1");
}

int GateResult::count(Standing standing) const {
  return static_cast<int>(std::ranges::count(figures, standing, &GateFigure::standing));
}

int GateResult::exit_code() const {
  return verdict == Standing::kRegressed ? 1 : verdict == Standing::kUnjudged ? 2 : 0;
}

GateResult judge(const Record& baseline, const Record& candidate, const GateRules& rules,
                 const GateOptions& options) {
  baseline.check();
  candidate.check();
  options.check();
  return Gate(baseline, candidate, rules, options).run();
}

}  // namespace placegraph
