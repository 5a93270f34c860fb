#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// CPU time that the stages of a program took, each without the stages it called.
///
///     const auto span = times.measure("window");  // until the end of the scope
///
/// One thread opens and closes spans, inner ones first; what its helper threads work meanwhile
/// counts for the open stage, as does any other work of the process.
class StageTimes {
 public:
  /// What one stage has taken so far.
  struct Stage {
    std::string name;        ///< as given to `measure`
    double cpu_s = 0;        ///< CPU time of all threads of the process, inner stages excluded [s]
    std::int64_t calls = 0;  ///< spans that were closed
  };

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

  /// Opens a span of the stage of that name, which ends with the scope it is kept in.
  [[nodiscard]] Span measure(const std::string& name);
  /// The stages in the order in which they were first met.
  /// A stage whose first span is still open has no calls and no time yet.
  const std::vector<Stage>& stages() const { return stages_; }

 private:
  struct Open {
    std::size_t stage;
    double begin_s, inner_s;
  };
  std::vector<Stage> stages_;
  std::vector<Open> open_;
};

}  // namespace placegraph
