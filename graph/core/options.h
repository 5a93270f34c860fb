#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The closed interval of allowed values of an option; by default any number.
struct Range {
  double min = -std::numeric_limits<double>::infinity();  ///< smallest value allowed
  double max = std::numeric_limits<double>::infinity();   ///< largest value allowed
};

/// Who an option is for.
enum class OptionLevel {
  kBasic,     ///< everybody: what most runs set
  kAdvanced,  ///< those who adapt the system to other data; the default
  kInternal   ///< developers: constants of an algorithm
};

/// A key that became a constant: files of earlier versions may hold it.
struct RetiredOption {
  const char* key;  ///< last word of its path
  double value;     ///< the constant's value
};

/// Visits the fields of an options struct.
/// From this one protocol come strict YAML reading, `placegraph config`, `--set a.b.c=v`, range
/// checks and docs/options.md.
///
/// Each `XOptions` aggregate has one free function beside it that lists key, member, doc, range:
///
///     void visit(OptionVisitor& field, KltOptions& o) {
///       field("window_px", o.window_px, "side of the square window", {5, 63});
///       field.choice("metric", o.metric, {"ssd", "zncc"}, "similarity");   // enum class, 0-based
///       field.group("ransac", o.ransac, "outlier rejection");              // nested options
///       field.basic()("enabled", o.enabled, "whether points are tracked"); // for everybody
///       field.formerly("sigma")("sigma_px", o.sigma_px, "noise [px]");     // had another key
///       field.retired({{"blur_px", 1}});                                   // is a constant now
///     }
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;

  /// Marks the next field, or all fields of the next group, as OptionLevel::kBasic.
  OptionVisitor& basic() { return mark(OptionLevel::kBasic); }
  /// Marks the next field, or all fields of the next group, as OptionLevel::kInternal.
  OptionVisitor& internal() { return mark(OptionLevel::kInternal); }
  /// Names the key that the next field or group had in earlier versions.
  /// Files and `--set` may still use it.
  OptionVisitor& formerly(const char* key) {
    marks_.former_key = key;
    return *this;
  }

  /// Names keys that are constants now; `group`, if not null, was the group around them.
  /// Files and `--set` may still hold them; their values are not used.
  virtual void retired(const std::vector<RetiredOption>& keys, const char* group = nullptr);

  /// A switch: YAML's true or false.
  virtual void operator()(const char* key, bool& value, const char* doc) = 0;
  /// An integer within `range`.
  virtual void operator()(const char* key, int& value, const char* doc, Range range = {}) = 0;
  /// An integer that is not negative, such as the seed of a random generator.
  virtual void operator()(const char* key, std::uint64_t& value, const char* doc) = 0;
  /// A number within `range`; NaN is in no range.
  virtual void operator()(const char* key, double& value, const char* doc, Range range = {}) = 0;
  /// A text, such as a path; it may be empty.
  virtual void operator()(const char* key, std::string& value, const char* doc) = 0;
  /// A list of any length whose elements are all within `range`.
  virtual void operator()(const char* key, std::vector<double>& value, const char* doc,
                          Range range = {}) = 0;

  /// An enum class whose enumerators are 0, 1, ... in the order of `names`.
  template <class Enum>
  void choice(const char* key, Enum& value, const std::vector<std::string>& names,
              const char* doc) {
    int index = static_cast<int>(value);
    choice_index(key, index, names, doc);
    value = static_cast<Enum>(index);
  }

  /// Nested options, whose fields get the paths "key.field".
  /// `visit(OptionVisitor&, Options&)` must be found by argument-dependent lookup. A visitor that
  /// checks calls `options.check()` instead, if it exists.
  template <class Options>
  void group(const char* key, Options& options, const char* doc) {
    begin_group(key, doc);
    if constexpr (requires { options.check(); }) {
      if (checks())
        check_group([&options] { options.check(); });
      else
        visit(*this, options);
    } else {
      visit(*this, options);
    }
    end_group();
  }

 protected:
  /// What `basic`, `internal` and `formerly` say about the next field or group.
  struct Marks {
    std::optional<OptionLevel> level;  ///< nothing: that of the group around it
    const char* former_key = nullptr;  ///< null: it always had its key
  };
  /// The marks of the present field or group; the next one begins without marks.
  Marks take_marks() { return std::exchange(marks_, {}); }

  virtual void choice_index(const char* key, int& index, const std::vector<std::string>& names,
                            const char* doc) = 0;
  virtual void begin_group(const char* key, const char* doc) = 0;
  virtual void end_group() = 0;
  /// Whether the visitor receives the `check()` of each group, between begin_group and end_group,
  /// instead of its fields.
  virtual bool checks() const { return false; }
  virtual void check_group(const std::function<void()>& check) { check(); }

 private:
  OptionVisitor& mark(OptionLevel level) {
    marks_.level = level;
    return *this;
  }

  Marks marks_;
};

/// One field of an options struct, or the head of a group, with its full path.
struct OptionEntry {
  std::string path;   ///< keys from the outermost group on: "frontend.tracker.window_px"
  std::string value;  ///< the present value, as YAML would write it; empty for a group
  std::string doc;    ///< meaning, one line
  std::string type;   ///< bool | int | uint | double | string | list | choice | group
  Range range;        ///< allowed values of an int, a double or the elements of a list
  std::vector<std::string> choices;            ///< allowed names of a choice, else empty
  OptionLevel level = OptionLevel::kAdvanced;  ///< who it is for; of a group: its fields
  std::string former_path;  ///< the path that it had in earlier versions; empty: the same
};

namespace internal {
/// Collects entries; `check` throws ArgumentError "path: value outside [min, max]".
class OptionCollector : public OptionVisitor {
 public:
  using OptionVisitor::operator();
  explicit OptionCollector(bool check) : check_(check) {}
  void operator()(const char* key, bool& value, const char* doc) override;
  void operator()(const char* key, int& value, const char* doc, Range range) override;
  void operator()(const char* key, std::uint64_t& value, const char* doc) override;
  void operator()(const char* key, double& value, const char* doc, Range range) override;
  void operator()(const char* key, std::string& value, const char* doc) override;
  void operator()(const char* key, std::vector<double>& value, const char* doc,
                  Range range) override;
  void retired(const std::vector<RetiredOption>& keys, const char* group = nullptr) override;
  std::vector<OptionEntry> entries;
  std::vector<OptionEntry> retired_entries;  ///< paths, values and types alone

 protected:
  void choice_index(const char* key, int& index, const std::vector<std::string>& names,
                    const char* doc) override;
  void begin_group(const char* key, const char* doc) override;
  void end_group() override;
  bool checks() const override { return check_; }
  void check_group(const std::function<void()>& check) override;

 private:
  void add(const char* key, std::string value, const char* doc, const char* type, Range range = {},
           std::vector<std::string> choices = {});
  void check_range(const char* key, double value, Range range) const;
  std::vector<std::string> prefix_, former_prefix_;
  std::vector<OptionLevel> levels_ = {OptionLevel::kAdvanced};  // levels of the groups around
  bool check_;
};
}  // namespace internal

/// All fields of `options`, groups included, in the order `visit` lists them.
template <class Options>
std::vector<OptionEntry> list_options(const Options& options) {
  internal::OptionCollector collector(false);
  Options copy = options;
  visit(collector, copy);
  return collector.entries;
}

/// Keys that files of earlier versions may hold and that are constants now: paths and values.
template <class Options>
std::vector<OptionEntry> list_retired_options(const Options& options) {
  internal::OptionCollector collector(false);
  Options copy = options;
  visit(collector, copy);
  return collector.retired_entries;
}

/// Throws ArgumentError naming the first field that is NaN or outside its range.
/// The message is "path: value outside [min, max]". For a group that has a `check()` it is the
/// message of that check, preceded by the name of the group.
template <class Options>
void check_ranges(const Options& options) {
  internal::OptionCollector collector(true);
  Options copy = options;
  visit(collector, copy);
}

}  // namespace placegraph
