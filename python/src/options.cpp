#include "python/src/options.h"

#include <fmt/format.h>
#include <placegraph/backend/incremental/incremental_options.h>
#include <placegraph/backend/pose_graph/pose_graph_options.h>
#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/map/map_options.h>
#include <placegraph/pipeline/run.h>

#include <functional>

#include "python/src/values/value_class.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// Finds one field by its path.
class FieldVisitor : public OptionVisitor {
 public:
  explicit FieldVisitor(std::string path) : path_(std::move(path)) {}
  bool found() const { return found_; }

 protected:
  /// Whether this is the field.
  bool at(const char* key) {
    (void)take_marks();
    std::string path = prefix_ + key;
    if (path != path_) return false;
    found_ = true;
    return true;
  }
  void begin_group(const char* key, const char*) override {
    (void)take_marks();
    lengths_.push_back(prefix_.size());
    prefix_ += std::string(key) + ".";
  }
  void end_group() override {
    prefix_.resize(lengths_.back());
    lengths_.pop_back();
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_, prefix_;
  std::vector<std::size_t> lengths_;
  bool found_ = false;
};

class Fetcher : public FieldVisitor {
 public:
  using FieldVisitor::FieldVisitor;
  nb::object value = nb::none();

  void operator()(const char* key, bool& field, const char*) override { take(key, field); }
  void operator()(const char* key, int& field, const char*, Range) override { take(key, field); }
  void operator()(const char* key, std::uint64_t& field, const char*) override { take(key, field); }
  void operator()(const char* key, double& field, const char*, Range) override { take(key, field); }
  void operator()(const char* key, std::string& field, const char*) override { take(key, field); }
  void operator()(const char* key, std::vector<double>& field, const char*, Range) override {
    take(key, field);
  }

 private:
  template <class Field>
  void take(const char* key, const Field& field) {
    if (at(key)) value = nb::cast(field);
  }
  void choice_index(const char* key, int& index, const std::vector<std::string>& names,
                    const char*) override {
    if (at(key)) value = nb::cast(names.at(static_cast<std::size_t>(index)));
  }
};

class Assigner : public FieldVisitor {
 public:
  Assigner(std::string path, nb::handle value) : FieldVisitor(std::move(path)), value_(value) {}

  void operator()(const char* key, bool& field, const char*) override {
    if (!at(key)) return;
    if (!nb::isinstance<nb::bool_>(value_)) refuse("True or False");
    field = nb::cast<bool>(value_);
  }
  void operator()(const char* key, int& field, const char*, Range range) override {
    if (!at(key)) return;
    field = whole<int>("an integer");
    check(field, range);
  }
  void operator()(const char* key, std::uint64_t& field, const char*) override {
    if (at(key)) field = whole<std::uint64_t>("an integer that is not negative");
  }
  void operator()(const char* key, double& field, const char*, Range range) override {
    if (!at(key)) return;
    field = number(value_);
    check(field, range);
  }
  void operator()(const char* key, std::string& field, const char*) override {
    if (!at(key)) return;
    if (!nb::try_cast<std::string>(value_, field)) refuse("a text");
  }
  void operator()(const char* key, std::vector<double>& field, const char*, Range range) override {
    if (!at(key)) return;
    std::vector<double> values;
    if (!nb::try_cast<std::vector<double>>(value_, values)) refuse("a list of numbers");
    for (const double each : values) check(each, range);
    field = values;
  }

 private:
  void choice_index(const char* key, int& index, const std::vector<std::string>& names,
                    const char*) override {
    if (!at(key)) return;
    std::string name;
    if (nb::try_cast<std::string>(value_, name))
      for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) {
          index = static_cast<int>(i);
          return;
        }
    std::string all;
    for (const std::string& each : names) all += (all.empty() ? "'" : ", '") + each + "'";
    refuse("one of " + all);
  }
  template <class Integer>
  Integer whole(const char* what) {
    Integer result{};
    if (nb::isinstance<nb::bool_>(value_) || !nb::try_cast<Integer>(value_, result)) refuse(what);
    return result;
  }
  double number(nb::handle value) {
    double result = 0;
    if (nb::isinstance<nb::bool_>(value) || !nb::try_cast<double>(value, result))
      refuse("a number");
    return result;
  }
  void check(double value, Range range) {
    if (!(value >= range.min && value <= range.max))
      throw ArgumentError(
          fmt::format("{}: {} outside [{}, {}]", path(), value, range.min, range.max));
  }
  [[noreturn]] void refuse(const std::string& wanted) {
    throw ArgumentError(
        fmt::format("{}: {} is needed, not {}", path(), wanted, nb::repr(value_).c_str()));
  }

  nb::handle value_;
};

template <class Options>
void bind(nb::module_& m, const char* name, const char* doc) {
  using Set = OptionSetOf<Options>;
  nb::class_<Set, OptionSet>(m, name, doc).def(nb::init<>(), "The defaults.");
}

}  // namespace

nb::object fetch_option(const std::string& path, const std::function<void(OptionVisitor&)>& visit) {
  Fetcher fetcher(path);
  visit(fetcher);
  if (!fetcher.found()) throw ArgumentError(path + ": no such option");
  return fetcher.value;
}

void assign_option(const std::string& path, nb::handle value,
                   const std::function<void(OptionVisitor&)>& visit) {
  Assigner assigner(path, value);
  visit(assigner);
  if (!assigner.found()) throw ArgumentError(path + ": no such option");
}

void bind_options(nb::module_& m) {
  m.def("require_own_version", &require_own_version, "version"_a, "type"_a,
        "Raises ArgumentError unless a pickle of a type was written by this version.");
  nb::class_<OptionEntry>(m, "OptionEntry", "One option, or the head of a group.")
      .def_ro("path", &OptionEntry::path, "Keys from the outermost group on, joined by dots.")
      .def_ro("value", &OptionEntry::value, "The present value, as YAML writes it.")
      .def_ro("doc", &OptionEntry::doc, "Meaning.")
      .def_ro("type", &OptionEntry::type, "bool, int, uint, double, string, list, choice or group.")
      .def_prop_ro("choices", as_tuple(&OptionEntry::choices), "Allowed names of a choice.")
      .def_prop_ro(
          "range", [](const OptionEntry& e) { return std::pair(e.range.min, e.range.max); },
          "Smallest and largest allowed value.");
  nb::class_<OptionSet>(m, "OptionSet", "Options by their paths.")
      .def("entries", &OptionSet::entries, "All options with their values, ranges and meanings.")
      .def("get", &OptionSet::get, "path"_a, "The value of an option.")
      .def("set", &OptionSet::set, "path"_a, "value"_a.none(),
           "Assigns an option; raises ArgumentError for a wrong type or a value out of range.")
      .def("to_yaml", &OptionSet::to_yaml, "All options as YAML, with comments.")
      .def("read_yaml", &OptionSet::read_yaml, "text"_a, "name"_a = "text",
           "Sets the options that a YAML text names; `name` stands in messages.")
      .def("check", &OptionSet::check, "Raises ArgumentError if options contradict each other.")
      .def("__copy__", &OptionSet::copy)
      .def("copy", &OptionSet::copy, "Options with the same values.");
  bind<RunOptions>(m, "RunOptionSet", "Options of a run.");
  bind<SlamOptions>(m, "SlamOptionSet", "Options of Slam.");
  bind<EvaluationOptions>(m, "EvaluationOptionSet", "Options of evaluate.");
  bind<PoseGraphOptions>(m, "PoseGraphOptionSet", "Options of optimize.");
  bind<IncrementalOptions>(m, "IncrementalOptionSet", "Options of IncrementalOptimizer.");
  bind<LocalizerOptions>(m, "LocalizerOptionSet", "Options of localize.");
}

}  // namespace placegraph::python
