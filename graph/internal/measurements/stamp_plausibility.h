#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph {

/// What is odd about the times of frames or poses: one line that says how far apart they are and
/// in which unit they would be plausible, "a frame every 100 s (0.01 Hz): are these milliseconds?".
/// Empty if nothing is odd: their median distance is from 0.2 ms (5 kHz) to 10 s.
/// `what`: "frame", "pose". Precondition: increasing stamps [ns].
std::string odd_spacing(const std::vector<std::int64_t>& stamps_ns, const std::string& what);

/// Why two recordings have no time in common, as far as it can be told: the factor or the offset
/// that would give them the same; empty if neither is evident. `other` says whose times are
/// doubted, "the estimate". Precondition: increasing stamps [ns], none empty.
std::string other_clock(const std::vector<std::int64_t>& stamps_ns,
                        const std::vector<std::int64_t>& other_ns, const std::string& other);

}  // namespace placegraph
