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
  struct Stage {
    std::string name;
    double cpu_s = 0;
    std::int64_t calls = 0;
  };

  class Span {
   public:
    Span(StageTimes& times, std::size_t stage);
    ~Span();
    Span(const Span&) = delete;
    Span& operator=(const Span&) = delete;

   private:
    StageTimes& times_;
  };

  [[nodiscard]] Span measure(const std::string& name);
  /// In the order in which they were first met; open spans are not in it.
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
