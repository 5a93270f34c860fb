// Faults of the order of frames and of their stamps.
#include <algorithm>
#include <numeric>
#include <opencv2/core.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kAll = "mono stereo rgbd";
constexpr auto kTimes = "times_questionable";
constexpr auto kOrder = "times_questionable|jump|few_posed|components";
constexpr auto kFewer = "times_questionable|few_posed|lost_frames|components|jump|drift_large";

std::vector<std::size_t> numbers_of(const Recording& recording) {
  std::vector<std::size_t> numbers(recording.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

Recording every(const Recording& recording, std::size_t step) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < recording.size(); i += step) kept.push_back(i);
  return with_kept(recording, kept);
}

/// Eight frames are lost at a quarter, a half and three quarters of the sequence.
Recording with_dropped_bursts(const Recording& recording) {
  std::vector<std::size_t> kept;
  const std::size_t size = recording.size(), length = std::min<std::size_t>(8, size / 8);
  for (std::size_t i = 0; i < size; ++i) {
    bool lost = false;
    for (std::size_t quarter = 1; quarter <= 3; ++quarter)
      lost = lost || (i >= quarter * size / 4 && i < quarter * size / 4 + length);
    if (!lost) kept.push_back(i);
  }
  return with_kept(recording, kept);
}

/// Every frame twice, at the rate of the recording.
Recording doubled(const Recording& recording) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < recording.size(); ++i) numbers.insert(numbers.end(), 2, i);
  return with_order(recording, numbers);
}

/// The images stop at one of them while the camera moves on: the truth does not stop.
Recording frozen(const Recording& recording) {
  Recording out = recording;
  out.faulty = part(recording, 0.5, 0.65);
  const Frame& last = recording.frames[out.faulty.first];
  for (std::size_t i = out.faulty.first; i <= out.faulty.last; ++i) {
    const std::int64_t stamp_ns = out.frames[i].stamp_ns;
    const FrameId id = out.frames[i].id;
    out.frames[i] = last;
    out.frames[i].stamp_ns = stamp_ns;
    out.frames[i].id = id;
  }
  return out;
}

Recording shuffled(const Recording& recording, std::uint32_t seed) {
  std::vector<std::size_t> numbers = numbers_of(recording);
  cv::RNG random = random_of(seed, 0);
  for (std::size_t i = numbers.size() - 1; i > 0; --i)
    std::swap(numbers[i],
              numbers[static_cast<std::size_t>(random.uniform(0, static_cast<int>(i) + 1))]);
  return with_order(recording, numbers);
}

Recording neighbours_exchanged(const Recording& recording) {
  std::vector<std::size_t> numbers = numbers_of(recording);
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) std::swap(numbers[i], numbers[i + 1]);
  return with_order(recording, numbers);
}

/// Blocks of ten frames change places in pairs.
Recording blocks_exchanged(const Recording& recording) {
  std::vector<std::size_t> numbers = numbers_of(recording);
  for (std::size_t i = 0; i + 20 <= numbers.size(); i += 20)
    std::rotate(numbers.begin() + static_cast<std::ptrdiff_t>(i),
                numbers.begin() + static_cast<std::ptrdiff_t>(i + 10),
                numbers.begin() + static_cast<std::ptrdiff_t>(i + 20));
  return with_order(recording, numbers);
}

/// New stamps from the number and the stamp of each frame.
Recording with_stamps(const Recording& recording,
                      const std::function<std::int64_t(std::size_t, std::int64_t)>& stamp_ns) {
  Recording out = recording;
  out.faulty = whole(recording);
  for (std::size_t i = 0; i < out.size(); ++i)
    out.frames[i].stamp_ns = stamp_ns(i, recording.frames[i].stamp_ns);
  return out;
}

/// Stamps that vary by up to 45 % of the distance between two, and still increase.
Recording jittered(const Recording& recording, std::uint32_t seed) {
  const std::int64_t distance_ns = median_distance_ns(recording);
  return with_stamps(recording, [&](std::size_t i, std::int64_t stamp_ns) {
    cv::RNG random = random_of(seed, i);
    return stamp_ns + distance_ns +
           static_cast<std::int64_t>(random.uniform(-0.45, 0.45) *
                                     static_cast<double>(distance_ns));
  });
}

std::vector<Fault> order_faults() {
  return {
      {"every_2nd", kAll, "every second frame", "-",
       [](const Recording& r, std::uint32_t) { return every(r, 2); }},
      {"every_3rd", kAll, "every third frame", kFewer,
       [](const Recording& r, std::uint32_t) { return every(r, 3); }},
      {"every_5th", kAll, "every fifth frame", kFewer,
       [](const Recording& r, std::uint32_t) { return every(r, 5); }},
      {"dropped_bursts", kAll, "eight frames are lost, three times", kFewer,
       [](const Recording& r, std::uint32_t) { return with_dropped_bursts(r); }},
      {"repeated_frames", kAll, "every frame is there twice", "repeated_frames",
       [](const Recording& r, std::uint32_t) { return doubled(r); }},
      {"frozen", kAll, "one image is repeated for a while, the camera moves on",
       "repeated_frames|jump", [](const Recording& r, std::uint32_t) { return frozen(r); }},
      {"shuffled", kAll, "the frames are in random order", kOrder, shuffled},
      {"neighbours_exchanged", kAll, "frames change places with their neighbours", kOrder,
       [](const Recording& r, std::uint32_t) { return neighbours_exchanged(r); }},
      {"blocks_exchanged", kAll, "blocks of ten frames change places", kOrder,
       [](const Recording& r, std::uint32_t) { return blocks_exchanged(r); }},
  };
}

std::vector<Fault> stamp_faults() {
  return {
      {"times_half_rate", kAll, "stamps are twice as far apart as they were", "-",
       [](const Recording& r, std::uint32_t) {
         return with_stamps(r, [](std::size_t, std::int64_t ns) { return 2 * ns; });
       }},
      {"times_equal", kAll, "every stamp is there twice", kTimes,
       [](const Recording& r, std::uint32_t) {
         return with_stamps(
             r, [&r](std::size_t i, std::int64_t) { return r.frames[i - i % 2].stamp_ns; });
       }},
      {"times_jittered", kAll, "stamps vary by up to 45 % of their distance", kTimes, jittered},
      {"times_milliseconds", kAll, "stamps are milliseconds, taken as seconds", kTimes,
       [](const Recording& r, std::uint32_t) {
         return with_stamps(r, [](std::size_t, std::int64_t ns) { return 1000 * ns; });
       }},
      {"times_too_small", kAll, "stamps are thousands of seconds, taken as seconds", kTimes,
       [](const Recording& r, std::uint32_t) {
         return with_stamps(r, [](std::size_t, std::int64_t ns) { return ns / 1000; });
       }},
      {"times_gap", kAll, "the stamps jump by an hour in the middle", kTimes,
       [](const Recording& r, std::uint32_t) {
         return with_stamps(r, [&r](std::size_t i, std::int64_t ns) {
           return ns + (i < r.size() / 2 ? 0 : 3600LL * 1000000000);
         });
       }},
  };
}

}  // namespace

std::vector<Fault> timing_faults() {
  std::vector<Fault> faults = order_faults();
  const std::vector<Fault> more = stamp_faults();
  faults.insert(faults.end(), more.begin(), more.end());
  return faults;
}

}  // namespace placegraph::faults
