#include <placegraph/graph/core/stage_times.h>
#include <time.h>

#include <algorithm>

namespace placegraph {
namespace {

double process_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

StageTimes::Span::Span(StageTimes& times, std::size_t stage) : times_(times) {
  times_.open_.push_back({stage, process_cpu_s(), 0});
}

StageTimes::Span::~Span() {
  const Open span = times_.open_.back();
  times_.open_.pop_back();
  const double took_s = process_cpu_s() - span.begin_s;
  StageTime& stage = times_.stages_[span.stage];
  stage.cpu_s += took_s - span.inner_s;
  ++stage.calls;
  if (!times_.open_.empty()) times_.open_.back().inner_s += took_s;
}

StageTimes::Span StageTimes::measure(const std::string& name) {
  const auto known = std::find_if(stages_.begin(), stages_.end(),
                                  [&](const StageTime& stage) { return stage.name == name; });
  const auto index = static_cast<std::size_t>(known - stages_.begin());
  if (known == stages_.end()) stages_.push_back({name});
  return Span(*this, index);
}

}  // namespace placegraph
