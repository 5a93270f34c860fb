#include <fmt/format.h>
#include <placegraph/eval/uncertainty/confidence_interval.h>

namespace placegraph {

std::string to_text(const ConfidenceInterval& interval) {
  if (!interval.outcome)
    return fmt::format("{:.4g}, {}: no interval", interval.estimate, interval.outcome.reason);
  return fmt::format("{:.4g}, {:g} % interval {:.4g} to {:.4g} ({})", interval.estimate,
                     100 * interval.level, interval.low, interval.high, interval.of);
}

}  // namespace placegraph
