#pragma once
#include <cstdint>

namespace placegraph {

class SlidingWindow;

/// Standard deviation of log(|t_middle_last| / |t_first_middle|) between three keyframes of the
/// window: how well it holds its unit of length where nothing measures that. The gauge plays no
/// part in it. Infinite if two of the three stand in one point. Throws ArgumentError unless they
/// are three different keyframes of the window.
double sigma_log_length_ratio(const SlidingWindow& window, std::int64_t first, std::int64_t middle,
                              std::int64_t last);

}  // namespace placegraph
