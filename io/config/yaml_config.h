#pragma once
#include <placegraph/graph/core/log.h>
#include <placegraph/graph/core/options.h>

#include <memory>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

namespace internal {

/// Assigns a YAML file's values in an options struct's visit() and records the used keys.
class OptionsFile {
 public:
  explicit OptionsFile(const std::string& path);
  OptionsFile(const std::string& path, const std::string& text);
  ~OptionsFile();
  OptionVisitor& visitor();
  /// Throws FileError for the first key of the file that visit() did not request; names old
  /// spellings to `log`.
  void finish(const LogSink& log);

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

/// Assigns one "a.b.c=value" in an options struct's visit().
class OptionAssignment {
 public:
  explicit OptionAssignment(const std::string& assignment);
  ~OptionAssignment();
  OptionVisitor& visitor();
  /// Throws ArgumentError, with the similar keys of `known`, if visit() did not request the key;
  /// names an old spelling to `log`.
  void finish(const std::vector<OptionEntry>& known, const LogSink& log);

 private:
  class Setter;
  std::unique_ptr<Setter> setter_;
};

}  // namespace internal

/// Sets the options that the YAML file at `path` names; the others keep their values.
///
/// Throws FileError for an unknown or duplicate key, a wrong type, NaN, or a value out of range, as
/// in "configs/kitti.yaml:12: frontend.flow.level: unknown key"; `options` is untouched then.
/// Each former spelling of a key is named to `log` with its present one, as a warning, and each
/// key that is a constant now with its value.
/// Relations between fields are not checked: call `options.check()` once everything is set.
template <class Options>
void read_options(const std::string& path, Options& options, const LogSink& log = {}) {
  internal::OptionsFile file(path);
  Options changed = options;
  visit(file.visitor(), changed);
  file.finish(log);
  options = changed;
}

/// Sets the options that a YAML text names, as dump_options writes it.
///
/// `path` is the file name for error messages; otherwise as read_options.
template <class Options>
void read_options_text(const std::string& path, const std::string& text, Options& options,
                       const LogSink& log = {}) {
  internal::OptionsFile file(path, text);
  Options changed = options;
  visit(file.visitor(), changed);
  file.finish(log);
  options = changed;
}

/// Sets one option from a text "a.b.c=value"; lists are written as [1, 2].
///
/// Throws ArgumentError for an unknown key, a wrong type or a value out of range, as in
/// "--set a.b.c=value: unknown key; similar: a.b.d"; `options` is untouched then.
template <class Options>
void set_option(Options& options, const std::string& assignment, const LogSink& log = {}) {
  internal::OptionAssignment setter(assignment);
  Options changed = options;
  visit(setter.visitor(), changed);
  setter.finish(list_options(options), log);
  options = changed;
}

/// Writes options as YAML that read_options accepts; comments give meaning and range.
std::string dump_options(const std::vector<OptionEntry>& entries);
/// Writes all fields of `options` as YAML that read_options accepts.
template <class Options>
std::string dump_options(const Options& options) {
  return dump_options(list_options(options));
}

/// Writes options as Markdown: a list of keys, values, ranges, levels and meanings per group.
std::string options_markdown(const std::vector<OptionEntry>& entries);
/// Writes all fields of `options` as Markdown, with their present values as defaults.
template <class Options>
std::string options_markdown(const Options& options) {
  return options_markdown(list_options(options));
}

}  // namespace placegraph
