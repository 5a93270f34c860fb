#include <fmt/format.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/scale/scale_check.h>

#include <algorithm>
#include <cmath>

namespace placegraph {

void ScaleCheck::add(FrameId frame, double log_factor) { compared_.push_back({frame, log_factor}); }

std::optional<DataNote> ScaleCheck::note() const {
  // On streets, real and rendered, one comparison in a thousand exceeds 13 %, and the median is at
  // most 2.3 %.
  constexpr double kFar = 0.2, kShare = 0.03, kMedian = 0.06;
  // Comparisons that contradict, and comparisons with a median. Chosen.
  constexpr std::size_t kFewestFar = 2, kFewest = 5;
  const auto far = [](const Compared& c) { return std::abs(c.log_factor) > kFar; };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(compared_, far));
  const auto share = static_cast<double>(count) / static_cast<double>(compared_.size());
  const bool contradicts = count >= kFewestFar && share > kShare;
  std::vector<double> off;
  for (const Compared& c : compared_) off.push_back(std::abs(c.log_factor));
  const double median = off.empty() ? 0 : median_of(off);
  const bool scatters = off.size() >= kFewest && median > kMedian;
  if (!contradicts && !scatters) return std::nullopt;
  std::string text = fmt::format(
      "the lengths by the ground and by the points differ by {:.0f} % in the median of {} "
      "comparisons",
      100 * std::expm1(median), compared_.size());
  if (contradicts) {
    const Compared& worst = *std::ranges::max_element(
        compared_, {}, [](const Compared& c) { return std::abs(c.log_factor); });
    text += fmt::format("; {} differ by more than 20 %, the most by a factor of {:.2f} at frame {}",
                        count, std::exp(std::abs(worst.log_factor)), worst.frame.value());
  }
  return DataNote{text, true, NoteCause::kScale,
                  "look at the images there: few points, a ground that is not plain, or a plane "
                  "that is no ground; --mask leaves out what is none"};
}

}  // namespace placegraph
