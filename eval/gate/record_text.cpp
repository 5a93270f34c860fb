#include <fmt/format.h>
#include <placegraph/eval/gate/record.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>

namespace placegraph {
namespace {

using RecordJson = nlohmann::ordered_json;

constexpr const char* kFormat = "placegraph record";
constexpr Better kAllBetter[] = {Better::kSmaller, Better::kLarger, Better::kNearerZero,
                                 Better::kEqual};

/// A value of the file and where it stands: "sequences[0].figures[2].unit".
class RecordPart {
 public:
  RecordPart(const RecordJson& value, std::string source, std::string path)
      : value_(value), source_(std::move(source)), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw FileError(source_, path_.empty() ? message : path_ + ": " + message);
  }
  void expect_keys(std::initializer_list<const char*> known) const {
    if (!value_.is_object()) fail("is no object");
    for (const auto& [key, unused] : value_.items())
      if (std::ranges::find(known, key) == known.end()) fail("unknown key '" + key + "'");
  }
  bool has(const std::string& key) const { return value_.contains(key); }
  RecordPart at(const std::string& key) const {
    if (!has(key)) fail("has no '" + key + "'");
    return {value_.at(key), source_, path_.empty() ? key : path_ + "." + key};
  }
  std::vector<RecordPart> items() const {
    if (!value_.is_array()) fail("is no list");
    std::vector<RecordPart> all;
    for (std::size_t i = 0; i < value_.size(); ++i)
      all.emplace_back(value_[i], source_, fmt::format("{}[{}]", path_, i));
    return all;
  }
  double number() const {
    if (!value_.is_number()) fail("is no number");
    const double number = value_.get<double>();
    if (!std::isfinite(number)) fail("is not finite");
    return number;
  }
  int count() const {
    const double value = number();
    if (value < 0 || value > 2e9 || value != std::floor(value)) fail("is no count");
    return static_cast<int>(value);
  }
  std::string text() const {
    if (!value_.is_string()) fail("is no text");
    return value_.get<std::string>();
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> all;
    for (const RecordPart& item : items()) all.push_back(item.text());
    return all;
  }
  std::map<std::string, std::string> table() const {
    if (!value_.is_object()) fail("is no object");
    std::map<std::string, std::string> all;
    for (const auto& [key, unused] : value_.items()) all[key] = at(key).text();
    return all;
  }
  const RecordJson& json() const { return value_; }

 private:
  const RecordJson& value_;
  std::string source_, path_;
};

RecordJson interval_json(const ConfidenceInterval& interval) {
  if (!interval.outcome) return {{"reason", interval.outcome.reason}};
  return {{"low", interval.low},
          {"high", interval.high},
          {"level", interval.level},
          {"of", interval.of}};
}

ConfidenceInterval read_interval(const RecordPart& part, double estimate) {
  part.expect_keys({"low", "high", "level", "of", "reason"});
  ConfidenceInterval interval;
  interval.estimate = estimate;
  if (part.has("reason")) {
    interval.outcome = Outcome::failure(Outcome::Code::kTooFewData, part.at("reason").text());
    return interval;
  }
  interval.outcome = Outcome::ok();
  interval.low = part.at("low").number();
  interval.high = part.at("high").number();
  interval.level = part.at("level").number();
  interval.of = part.at("of").text();
  if (!(interval.low <= interval.high) || !(interval.level > 0 && interval.level < 1))
    part.fail("is no interval");
  return interval;
}

RecordJson figure_json(const FigureRecord& figure) {
  RecordJson json = {{"key", figure.key}, {"unit", figure.unit}};
  json["better"] = to_string(figure.better);
  json["values"] = RecordJson::array();
  for (const std::optional<double>& value : figure.values)
    if (!value)
      json["values"].push_back(nullptr);
    else if (figure.verdict)
      json["values"].push_back(*value == 1);
    else
      json["values"].push_back(*value);
  if (figure.whole) json["whole"] = *figure.whole;
  if (!figure.text.empty()) json["text"] = figure.text;
  if (figure.noise_floor > 0) json["noise_floor"] = figure.noise_floor;
  if (figure.interval.outcome || !figure.interval.outcome.reason.empty())
    json["interval"] = interval_json(figure.interval);
  return json;
}

FigureRecord read_figure(const RecordPart& part) {
  part.expect_keys({"key", "unit", "better", "values", "whole", "text", "noise_floor", "interval"});
  FigureRecord figure;
  figure.key = part.at("key").text();
  if (part.has("unit")) figure.unit = part.at("unit").text();
  const std::string better = part.at("better").text();
  const auto* found = std::ranges::find_if(
      kAllBetter, [&better](Better one) { return to_string(one) == better; });
  if (found == std::end(kAllBetter))
    part.at("better").fail("'" + better + "' is none of smaller, larger, nearer zero, equal");
  figure.better = *found;
  for (const RecordPart& value : part.at("values").items()) {
    const bool verdict = value.json().is_boolean();
    if (verdict) {
      figure.verdict = true;
      figure.values.emplace_back(value.json().get<bool>() ? 1 : 0);
    } else if (value.json().is_null()) {
      figure.values.emplace_back();
    } else {
      if (figure.verdict) value.fail("is no verdict, and those before are");
      figure.values.emplace_back(value.number());
    }
  }
  if (part.has("whole")) figure.whole = part.at("whole").number();
  if (part.has("text")) figure.text = part.at("text").text();
  if (part.has("noise_floor")) figure.noise_floor = part.at("noise_floor").number();
  if (part.has("interval"))
    figure.interval = read_interval(part.at("interval"), figure.mean().value_or(0));
  return figure;
}

/// Everything of a sequence but its figures.
RecordJson sequence_json(const SequenceRecord& sequence) {
  RecordJson json = {{"name", sequence.name}};
  if (!sequence.truth.fingerprint.empty())
    json["truth"] = {{"fingerprint", sequence.truth.fingerprint},
                     {"frames", sequence.truth.frames},
                     {"path_m", sequence.truth.path_m}};
  if (!sequence.options.empty()) json["options"] = sequence.options;
  if (sequence.reference_s) json["reference_s"] = *sequence.reference_s;
  if (!sequence.failures.empty()) json["failures"] = sequence.failures;
  return json;
}

SequenceRecord read_sequence(const RecordPart& part) {
  part.expect_keys({"name", "truth", "options", "reference_s", "failures", "figures"});
  SequenceRecord sequence;
  sequence.name = part.at("name").text();
  if (part.has("truth")) {
    const RecordPart truth = part.at("truth");
    truth.expect_keys({"fingerprint", "frames", "path_m"});
    sequence.truth = {truth.at("fingerprint").text(), truth.at("frames").count(),
                      truth.at("path_m").number()};
  }
  if (part.has("options")) sequence.options = part.at("options").table();
  if (part.has("reference_s")) sequence.reference_s = part.at("reference_s").number();
  if (part.has("failures")) sequence.failures = part.at("failures").texts();
  for (const RecordPart& figure : part.at("figures").items())
    sequence.figures.push_back(read_figure(figure));
  return sequence;
}

RecordJson parse_json(const std::string& text, const std::string& source) {
  using Event = RecordJson::parse_event_t;
  std::vector<std::set<std::string>> open;
  const auto unique = [&](int /*depth*/, Event event, RecordJson& parsed) {
    if (event == Event::object_start) open.emplace_back();
    if (event == Event::object_end) open.pop_back();
    if (event == Event::key && !open.back().insert(parsed.get<std::string>()).second)
      throw FileError(source, "key '" + parsed.get<std::string>() + "' stands twice in an object");
    return true;
  };
  try {
    return RecordJson::parse(text, unique);
  } catch (const RecordJson::exception& error) {
    // The library's own number of the error is of no use to who reads it.
    const std::string what = error.what();
    const std::size_t end = what.find("] ");
    throw FileError(source, end == std::string::npos ? what : what.substr(end + 2));
  }
}

std::string dumped(const RecordJson& json) {
  return json.dump(-1, ' ', false, RecordJson::error_handler_t::replace);
}

}  // namespace

std::string to_json(const Record& record) {
  record.check();
  std::string text = fmt::format("{{\"format\": \"{}\", \"version\": {},\n \"programs\": {},\n",
                                 kFormat, kRecordVersion, dumped(record.programs));
  text += " \"sequences\": [";
  for (std::size_t i = 0; i < record.sequences.size(); ++i) {
    std::string head = dumped(sequence_json(record.sequences[i]));
    head.pop_back();
    text += (i == 0 ? "\n  " : ",\n  ") + head + ",\n   \"figures\": [";
    const std::vector<FigureRecord>& figures = record.sequences[i].figures;
    for (std::size_t k = 0; k < figures.size(); ++k)
      text += (k == 0 ? "\n    " : ",\n    ") + dumped(figure_json(figures[k]));
    text += "]}";
  }
  return text + "]}\n";
}

Record parse_record(const std::string& text, const std::string& source) {
  const RecordJson json = parse_json(text, source);
  const RecordPart part(json, source, "");
  if (!json.is_object() || !part.has("format") || json.at("format") != kFormat)
    part.fail("is no record of `placegraph eval record`");
  const int version = part.at("version").count();
  if (version != kRecordVersion)
    part.fail(fmt::format("version: {} of the format of records; this program reads {}", version,
                          kRecordVersion));
  part.expect_keys({"format", "version", "programs", "sequences"});
  Record record;
  record.programs = part.at("programs").texts();
  for (const RecordPart& sequence : part.at("sequences").items())
    record.sequences.push_back(read_sequence(sequence));
  try {
    record.check();
  } catch (const ArgumentError& error) {
    throw FileError(source, error.what());
  }
  return record;
}

}  // namespace placegraph
