#pragma once
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/io/config/yaml_config.h>

#include <memory>

#include "python/src/bindings.h"
#include "python/src/warnings.h"

namespace placegraph::python {

/// One options struct behind an interface that knows its fields by their paths.
class OptionSet {
 public:
  virtual ~OptionSet() = default;
  virtual std::vector<OptionEntry> entries() const = 0;
  /// The value of a field, of the Python type that fits; throws ArgumentError for an unknown path.
  virtual nb::object get(const std::string& path) const = 0;
  /// Assigns a value after checking type and range; the options are unchanged if it throws.
  virtual void set(const std::string& path, nb::handle value) = 0;
  virtual std::string to_yaml() const = 0;
  virtual void read_yaml(const std::string& text, const std::string& name) = 0;
  virtual void check() const = 0;
  virtual std::unique_ptr<OptionSet> copy() const = 0;
};

/// The value at a path of visited options; throws ArgumentError if there is none.
nb::object fetch_option(const std::string& path, const std::function<void(OptionVisitor&)>& visit);
/// Assigns it.
void assign_option(const std::string& path, nb::handle value,
                   const std::function<void(OptionVisitor&)>& visit);

template <class Options>
class OptionSetOf : public OptionSet {
 public:
  OptionSetOf() = default;
  explicit OptionSetOf(Options options) : options_(std::move(options)) {}
  const Options& options() const { return options_; }

  std::vector<OptionEntry> entries() const override { return list_options(options_); }
  nb::object get(const std::string& path) const override {
    Options copy = options_;
    return fetch_option(path, [&](OptionVisitor& visitor) { visit(visitor, copy); });
  }
  void set(const std::string& path, nb::handle value) override {
    Options changed = options_;
    assign_option(path, value, [&](OptionVisitor& visitor) { visit(visitor, changed); });
    options_ = std::move(changed);
  }
  std::string to_yaml() const override { return dump_options(options_); }
  void read_yaml(const std::string& text, const std::string& name) override {
    Options changed = options_;
    read_options_text(name, text, changed, python_notes());
    options_ = std::move(changed);
  }
  void check() const override { check_ranges(options_); }
  std::unique_ptr<OptionSet> copy() const override {
    return std::make_unique<OptionSetOf<Options>>(options_);
  }

 private:
  Options options_;
};

/// The C++ struct in options from Python. Throws ArgumentError, which names the argument, if they
/// are of another kind.
template <class Options>
const Options& options_in(const OptionSet& set, const char* argument) {
  const auto* typed = dynamic_cast<const OptionSetOf<Options>*>(&set);
  if (!typed) throw ArgumentError(std::string(argument) + ": options of another kind");
  return typed->options();
}

}  // namespace placegraph::python
