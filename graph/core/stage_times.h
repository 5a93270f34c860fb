#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// The time that one stage has taken so far.
struct StageTime {
  std::string name;        ///< as given to `measure`
  double cpu_s = 0;        ///< CPU time of all threads of the process, inner stages excluded [s]
  std::int64_t calls = 0;  ///< spans that were closed
};

/// CPU time of the stages of a program, each without the stages that it called.
///
///     const auto span = times.measure("window");  // until the end of the scope
///
/// One thread opens and closes spans, inner ones first. CPU time of its helper threads and of any
/// other thread of the process counts for the open stage.
class StageTimes {
 public:
  using Stage = StageTime;  ///< its former name

  /// Measures from its construction to its destruction; made by `measure`.
  class Span {
   public:
    /// Opens a span of the stage at position `stage` of `times`, which must outlive it.
    Span(StageTimes& times, std::size_t stage);
    ~Span();
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    StageTimes& times_;
  };

  /// Opens a span of the named stage, which ends when the returned object is destroyed.
  [[nodiscard]] Span measure(const std::string& name);
  /// The stages in the order of their first spans.
  /// A stage whose first span is still open has no calls and no time yet.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  struct Open {
    std::size_t stage;
    double begin_s, inner_s;
  };
  std::vector<StageTime> stages_;
  std::vector<Open> open_;
};

}  // namespace placegraph
