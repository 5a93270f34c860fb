#include <fmt/format.h>
#include <placegraph/eval/gate/figure_judge.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

constexpr double kLost = std::numeric_limits<double>::infinity();

std::string value_text(const FigureRecord& figure) {
  const std::optional<double> mean = figure.mean();
  if (!mean) return "-";
  if (figure.verdict && (*mean == 0 || *mean == 1)) return *mean == 1 ? "yes" : "no";
  const std::string number = number_text(*mean);
  return figure.whole ? fmt::format("{} of {}", number, number_text(*figure.whole)) : number;
}

/// The text of a figure with its value in it.
std::string form_text(const FigureRecord& figure) {
  std::string text = figure.text.empty() ? "{}" : figure.text;
  const std::size_t place = text.find("{}");
  return place == std::string::npos ? text : text.replace(place, 2, value_text(figure));
}

std::string change_text(double before, double after) {
  const double difference = after - before;
  if (difference == 0) return "0";
  if (before == 0) return fmt::format("{:+.4g}", difference);
  return fmt::format("{:+.3g} %", 100 * difference / std::abs(before));
}

void decide(Standing standing, const std::string& reason, GateFigure& figure) {
  figure.standing = standing;
  figure.reason = reason;
}

void decide_lost(const std::string& reason, GateFigure& figure) {
  decide(Standing::kRegressed, reason, figure);
  figure.worse_by = kLost;
}

/// Share of the runs that have no value.
double failed_share(const FigureRecord& figure) {
  return 1 - static_cast<double>(figure.present().size()) /
                 static_cast<double>(figure.values.size());
}

void decide_failed_runs(const FigurePair& pair, GateFigure& figure) {
  const std::size_t runs = pair.after.values.size(), present = pair.after.present().size();
  std::string reason = present == 0 ? "no figure any more"
                                    : fmt::format("{} of {} runs have no figure", runs - present,
                                                  runs);
  if (!pair.after_sequence.failures.empty()) reason += ": " + pair.after_sequence.failures.front();
  decide_lost(reason, figure);
}

void decide_form(const FigurePair& pair, bool reported, GateFigure& figure) {
  figure.before_text = form_text(pair.before);
  figure.after_text = form_text(pair.after);
  figure.change.clear();
  decide(reported ? Standing::kReported : Standing::kRegressed, "of another form", figure);
  figure.worse_by = reported ? 0 : kLost;
}

void decide_verdicts(const FigurePair& pair, GateFigure& figure) {
  const double before = *pair.before.mean(), after = *pair.after.mean();
  if (after < before) {
    decide(Standing::kRegressed, "the target is missed that was met", figure);
    figure.worse_by = before - after;
  } else {
    decide(after > before ? Standing::kImproved : Standing::kSame,
           after > before ? "the target is met that was missed" : "", figure);
  }
}

/// A time is reported beside its ratio to the reference programs of the two sittings.
std::string time_text(const FigurePair& pair, double before, double after) {
  const auto &a = pair.before_sequence.reference_s, &b = pair.after_sequence.reference_s;
  if (pair.rule.kind != GateRule::Kind::kTime || !a || !b || before == 0) return "";
  return fmt::format(" ({:+.3g} % by the reference runs)",
                     100 * ((after / *b) / (before / *a) - 1));
}

/// Runs that err to both sides do not cancel.
double mean_magnitude(const FigureRecord& figure) {
  double sum = 0;
  const std::vector<double> values = figure.present();
  for (const double value : values) sum += std::abs(value);
  return sum / static_cast<double>(values.size());
}

/// The values that are compared: shares, where the whole has changed.
std::pair<double, double> compared_values(const FigurePair& pair) {
  const bool magnitudes = pair.better() == Better::kNearerZero;
  const double before = magnitudes ? mean_magnitude(pair.before) : *pair.before.mean(),
               after = magnitudes ? mean_magnitude(pair.after) : *pair.after.mean();
  if (pair.before.whole == pair.after.whole) return {before, after};
  const auto share = [](double value, std::optional<double> whole) {
    return whole.value_or(0) == 0 ? 0 : value / *whole;
  };
  return {share(before, pair.before.whole), share(after, pair.after.whole)};
}

}  // namespace

double FigurePair::floor() const {
  return std::max({rule.floor, before.noise_floor, after.noise_floor});
}

std::string number_text(double value) { return fmt::format("{:.4g}", value); }

double worsening(Better better, double before, double after) {
  switch (better) {
    case Better::kSmaller: return after - before;
    case Better::kLarger: return before - after;
    case Better::kNearerZero: return std::abs(after) - std::abs(before);
    case Better::kEqual: break;
  }
  return std::abs(after - before);
}

GateFigure described(const FigurePair& pair) {
  GateFigure figure;
  figure.sequence = pair.after_sequence.name;
  figure.figure = pair.after.key;
  figure.unit = pair.after.unit;
  figure.before = pair.before.mean();
  figure.after = pair.after.mean();
  figure.before_text = value_text(pair.before);
  figure.after_text = value_text(pair.after);
  figure.rule = pair.rule.text;
  if (figure.before && figure.after) {
    figure.change = change_text(*figure.before, *figure.after) +
                    time_text(pair, *figure.before, *figure.after);
    const double worse = worsening(pair.better(), *figure.before, *figure.after);
    figure.worse_by = *figure.before == 0 ? worse : worse / std::abs(*figure.before);
  }
  return figure;
}

bool judge_presence(const FigurePair& pair, GateFigure& figure) {
  const bool reported = pair.rule.kind == GateRule::Kind::kInfo ||
                    pair.rule.kind == GateRule::Kind::kTime;
  const bool one_form =
      pair.before.text == pair.after.text && pair.before.verdict == pair.after.verdict;
  if (!figure.before && !figure.after && one_form) {
    decide(Standing::kSame, "", figure);
  } else if (!figure.before && figure.after) {
    decide(Standing::kNew, "no figure before", figure);
  } else if (figure.before && !figure.after) {
    decide_failed_runs(pair, figure);
  } else if (!one_form) {
    decide_form(pair, reported, figure);
  } else if (failed_share(pair.after) > failed_share(pair.before)) {
    decide_failed_runs(pair, figure);
  } else if (pair.before.verdict) {
    decide_verdicts(pair, figure);
  } else if (reported) {
    decide(figure.before == figure.after ? Standing::kSame : Standing::kReported, "", figure);
  } else if (pair.before.whole != pair.after.whole && !pair.rule.whole_may_change) {
    decide_lost("of another whole: a count out of another number is another figure", figure);
  } else {
    return false;
  }
  return true;
}

void judge_by_tolerance(const FigurePair& pair, GateFigure& figure) {
  const auto [before, after] = compared_values(pair);
  const bool shares = pair.before.whole != pair.after.whole;
  const double absolute = shares ? 0 : std::max(pair.rule.absolute, pair.floor());
  const double allowed = std::max(pair.rule.relative * std::abs(before), absolute);
  // Digits of a decimal fraction cannot hold the bound exactly.
  const double room =
      allowed + 1e-9 * std::max({std::abs(before), std::abs(after), pair.rule.absolute});
  const double worse = worsening(pair.better(), before, after);
  const std::string unit = figure.unit.empty() ? "" : " " + figure.unit;
  const auto reported = [&](const char* word) {
    return fmt::format("{} to {}{}: {} by {}, and {} is allowed", figure.before_text,
                       figure.after_text, unit, word, number_text(std::abs(worse)),
                       number_text(allowed));
  };
  if (before == after && figure.before == figure.after && !shares)
    decide(Standing::kSame, "", figure);
  else if (worse > room)
    decide(Standing::kRegressed, reported("worse"), figure);
  else if (worse < -room)
    decide(Standing::kImproved, "", figure);
  else if (worse > std::max(pair.rule.relative * std::abs(before), pair.rule.absolute))
    decide(Standing::kWithin,
           fmt::format("the difference is within the noise of the truth, {}{}",
                       number_text(pair.floor()), unit),
           figure);
  else
    decide(Standing::kWithin, "", figure);
}

}  // namespace placegraph
