#include <fmt/format.h>
#include <placegraph/eval/uncertainty/confidence_interval.h>

namespace placegraph {

std::string to_text(const ConfidenceInterval& interval) {
  if (!interval.outcome) {
    const std::string& reason = interval.outcome.reason;
    const char* rest = reason.ends_with(": no interval") ? "" : ": no interval";
    return fmt::format("{:.4g}, {}{}", interval.estimate, reason, rest);
  }
  return fmt::format("{:.4g}, {:g} % interval {:.4g} to {:.4g} ({})", interval.estimate,
                     100 * interval.level, interval.low, interval.high, interval.of);
}

}  // namespace placegraph
