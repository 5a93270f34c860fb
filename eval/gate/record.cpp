#include <fmt/format.h>
#include <placegraph/eval/gate/record.h>
#include <placegraph/eval/uncertainty/run_interval.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace placegraph {
namespace {

void check_figure(const FigureRecord& figure, const std::string& where, std::size_t runs) {
  require(!figure.values.empty(), where + ": has no values");
  require(figure.values.size() == runs,
          fmt::format("{}: {} runs, where the first figure of the sequence has {}", where,
                      figure.values.size(), runs));
  for (const std::optional<double>& value : figure.values) {
    require(!value || std::isfinite(*value), where + ": a value is not finite");
    require(!value || !figure.verdict || *value == 0 || *value == 1,
            where + ": a verdict is neither 0 nor 1");
  }
  require(std::isfinite(figure.noise_floor) && figure.noise_floor >= 0,
          where + ": the noise floor is a number of 0 or more");
  require(!figure.whole || std::isfinite(*figure.whole), where + ": the whole is not finite");
}

std::size_t runs_of(const SequenceRecord& sequence) {
  return sequence.figures.empty() ? 1 : sequence.figures.front().values.size();
}

/// Appends the runs of `more`, or runs without a value if there is none.
void append_runs(const FigureRecord* more, std::size_t runs, FigureRecord& figure) {
  if (more)
    figure.values.insert(figure.values.end(), more->values.begin(), more->values.end());
  else
    figure.values.resize(figure.values.size() + runs);
}

void append_sequence(const SequenceRecord& more, const std::string& name,
                     SequenceRecord& sequence) {
  const std::string difference = difference_of(sequence, more);
  require(difference.empty(), name + ": is no run of the same: " + sequence.name + ": " +
                                  difference);
  if (sequence.options.empty()) sequence.options = more.options;
  const std::size_t before = runs_of(sequence), runs = runs_of(more);
  for (FigureRecord& figure : sequence.figures) {
    const FigureRecord* other = more.find(figure.key);
    require(!other || (other->unit == figure.unit && other->whole == figure.whole &&
                       other->text == figure.text && other->verdict == figure.verdict),
            fmt::format("{}: {}: {} has another unit or whole", name, sequence.name, figure.key));
    append_runs(other, runs, figure);
  }
  for (const FigureRecord& figure : more.figures) {
    if (sequence.find(figure.key)) continue;
    sequence.figures.push_back(figure);
    std::vector<std::optional<double>>& values = sequence.figures.back().values;
    values.insert(values.begin(), before, std::nullopt);
  }
  sequence.failures.insert(sequence.failures.end(), more.failures.begin(), more.failures.end());
}

/// A sequence that the records before or behind have and this one lacks.
void append_nothing(const std::string& name, SequenceRecord& sequence) {
  for (FigureRecord& figure : sequence.figures) append_runs(nullptr, 1, figure);
  sequence.failures.push_back(name + " has no sequence " + sequence.name);
}

void append_programs(const Record& more, Record& record) {
  for (const std::string& program : more.programs)
    if (std::ranges::count(record.programs, program) == 0) record.programs.push_back(program);
}

void append_record(const Record& more, const std::string& name,
                   const std::vector<std::string>& before, Record& record) {
  for (SequenceRecord& sequence : record.sequences)
    if (const SequenceRecord* other = more.find(sequence.name))
      append_sequence(*other, name, sequence);
    else
      append_nothing(name, sequence);
  for (const SequenceRecord& sequence : more.sequences) {
    if (record.find(sequence.name)) continue;
    record.sequences.push_back(sequence);
    for (const std::string& lacking : before) append_nothing(lacking, record.sequences.back());
  }
  append_programs(more, record);
}

}  // namespace

const char* to_string(Better better) {
  switch (better) {
    case Better::kSmaller: return "smaller";
    case Better::kLarger: return "larger";
    case Better::kNearerZero: return "nearer zero";
    case Better::kEqual: break;
  }
  return "equal";
}

std::vector<double> FigureRecord::present() const {
  std::vector<double> all;
  for (const std::optional<double>& value : values)
    if (value) all.push_back(*value);
  std::ranges::sort(all);
  return all;
}

std::optional<double> FigureRecord::mean() const {
  const std::vector<double> all = present();
  if (all.empty()) return std::nullopt;
  // Equal values keep their bits.
  if (all.front() == all.back()) return all.front();
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

const FigureRecord* SequenceRecord::find(const std::string& key) const {
  const auto found = std::ranges::find(figures, key, &FigureRecord::key);
  return found == figures.end() ? nullptr : &*found;
}

const SequenceRecord* Record::find(const std::string& name) const {
  const auto found = std::ranges::find(sequences, name, &SequenceRecord::name);
  return found == sequences.end() ? nullptr : &*found;
}

void Record::check() const {
  std::set<std::string> names;
  for (const SequenceRecord& sequence : sequences) {
    require(!sequence.name.empty(), "a sequence has no name");
    require(names.insert(sequence.name).second, sequence.name + ": a second sequence of that name");
    require(!sequence.reference_s || (std::isfinite(*sequence.reference_s) &&
                                      *sequence.reference_s > 0),
            sequence.name + ": the time of the reference program is positive");
    std::set<std::string> keys;
    for (const FigureRecord& figure : sequence.figures) {
      const std::string where = sequence.name + ": " + figure.key;
      require(!figure.key.empty(), sequence.name + ": a figure has no key");
      require(keys.insert(figure.key).second, where + ": a second figure of that key");
      check_figure(figure, where, runs_of(sequence));
    }
  }
}

Record merged(const std::vector<Record>& records, const std::vector<std::string>& names) {
  require(records.size() == names.size(), "every record has a name");
  require(!records.empty(), "no record is given");
  Record all = records.front();
  for (std::size_t i = 1; i < records.size(); ++i)
    append_record(records[i], names[i],
                  {names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i)}, all);
  if (records.size() == 1) return all;
  for (SequenceRecord& sequence : all.sequences)
    for (FigureRecord& figure : sequence.figures) {
      const std::vector<double> values = figure.present();
      if (!values.empty() && values.front() >= 0) figure.interval = interval_of_runs(values);
    }
  return all;
}

void add_runs(const Record& more, const std::array<std::string, 2>& names, Record& record) {
  for (const SequenceRecord& sequence : more.sequences) {
    const auto found = std::ranges::find(record.sequences, sequence.name, &SequenceRecord::name);
    if (found == record.sequences.end()) {
      record.sequences.push_back(sequence);
      continue;
    }
    const std::vector<Record> both = {{{}, {*found}}, {{}, {sequence}}};
    *found = merged(both, {names.begin(), names.end()}).sequences.front();
  }
  append_programs(more, record);
}

std::string difference_of(const SequenceRecord& a, const SequenceRecord& b) {
  if (a.truth.fingerprint != b.truth.fingerprint)
    return fmt::format("the truth is another one: {} poses over {:.1f} m, and {} over {:.1f} m",
                       a.truth.frames, a.truth.path_m, b.truth.frames, b.truth.path_m);
  // Of a sequence without any result it is not known how its figures would have been made.
  if (a.options.empty() || b.options.empty()) return "";
  const auto value_of = [](const SequenceRecord& sequence, const std::string& key) {
    const auto found = sequence.options.find(key);
    return found == sequence.options.end() ? std::string("not recorded") : found->second;
  };
  std::map<std::string, std::string> both = a.options;
  both.insert(b.options.begin(), b.options.end());
  for (const auto& [key, unused] : both)
    if (value_of(a, key) != value_of(b, key))
      return fmt::format("the options differ: {} is {}, and {}", key, value_of(a, key),
                         value_of(b, key));
  return "";
}

}  // namespace placegraph
