#pragma once
#include <placegraph/graph/core/options.h>

#include <memory>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

namespace internal {

/// Hands the values of one YAML file to an options struct's visit() and keeps account of the keys.
class OptionsFile {
 public:
  explicit OptionsFile(const std::string& path);
  OptionsFile(const std::string& path, const std::string& text);
  ~OptionsFile();
  OptionVisitor& visitor();
  /// Throws FileError for the first key that nobody asked for.
  void finish();

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

/// Hands one "a.b.c=value" to an options struct's visit().
class OptionAssignment {
 public:
  explicit OptionAssignment(const std::string& assignment);
  ~OptionAssignment();
  OptionVisitor& visitor();
  /// Throws ArgumentError if nobody asked for the key, with those of `known` that look like it.
  void finish(const std::vector<OptionEntry>& known);

 private:
  class Setter;
  std::unique_ptr<Setter> setter_;
};

}  // namespace internal

/// Sets the options that the YAML file at `path` names and leaves the others. Strict: an unknown or
/// duplicate key, a wrong type, NaN, or a value out of range is a FileError
/// "configs/kitti.yaml:12: frontend.flow.level: unknown key", and `options` is untouched. Relations
/// between fields are not checked: call `options.check()` once everything is set.
template <class Options>
void read_options(const std::string& path, Options& options) {
  internal::OptionsFile file(path);
  Options changed = options;
  visit(file.visitor(), changed);
  file.finish();
  options = changed;
}

/// The same from a text that stands in the file at `path`, as dump_options made it.
template <class Options>
void read_options_text(const std::string& path, const std::string& text, Options& options) {
  internal::OptionsFile file(path, text);
  Options changed = options;
  visit(file.visitor(), changed);
  file.finish();
  options = changed;
}

/// Sets one option from "a.b.c=value" (lists as [1, 2]). Throws ArgumentError
/// "--set a.b.c=value: unknown key; similar: a.b.d"; `options` is untouched then.
template <class Options>
void set_option(Options& options, const std::string& assignment) {
  internal::OptionAssignment setter(assignment);
  Options changed = options;
  visit(setter.visitor(), changed);
  setter.finish(list_options(options));
  options = changed;
}

/// The entries as YAML that read_options takes back, each one's doc and range as a comment above
/// it.
std::string dump_options(const std::vector<OptionEntry>& entries);
template <class Options>
std::string dump_options(const Options& options) {
  return dump_options(list_options(options));
}

/// The entries as Markdown: one table (key, default, range, meaning) a group.
std::string options_markdown(const std::vector<OptionEntry>& entries);
template <class Options>
std::string options_markdown(const Options& options) {
  return options_markdown(list_options(options));
}

}  // namespace placegraph
