#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace placegraph {

/// A line about implausible times of frames or poses: it states their distance and the unit in
/// which they would be plausible, as in "a frame every 100 s (0.01 Hz): are these milliseconds?".
/// Empty if the median distance is plausible: from 0.2 ms (5 kHz) to 10 s. `what`: "frame", "pose".
/// Precondition: increasing stamps [ns].
std::string odd_spacing(const std::vector<std::int64_t>& stamps_ns, const std::string& what);

/// A line about images that are missing, or whose times vary: spacings of more than five times the
/// median, or more than a fifth of the spacings off from a multiple of it by more than a fifth.
/// Empty if neither is the case. Precondition: increasing stamps [ns].
std::string irregular_spacing(const std::vector<std::int64_t>& stamps_ns);

/// The reason why two recordings have no time in common, if it can be found: the factor or the
/// offset that would make them overlap; empty if neither is evident. `other` names the recording
/// whose times are questioned, "the estimate". Precondition: increasing stamps [ns], none empty.
std::string other_clock(const std::vector<std::int64_t>& stamps_ns,
                        const std::vector<std::int64_t>& other_ns, const std::string& other);

}  // namespace placegraph
