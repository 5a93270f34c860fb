#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/geometry/trajectory_edit.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/filter_steps.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

constexpr double kMostPosesAtRate = 1e8;     // more are a mistake of units
constexpr double kSyncedWithin_s = 0.02;     // that of `eval trajectory`
constexpr std::int64_t kFirst = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kLast = std::numeric_limits<std::int64_t>::max();

void need_times(const Trajectory& trajectory) {
  require(trajectory.has_times, "the trajectory has no times; give it some with --times");
}

/// Two ends of an interval, each of which may be open.
struct CropRange {
  std::optional<std::int64_t> from, to;
};

/// "A:B"; `read` gives the value of an end.
template <class Read>
CropRange range_of(const std::string& word, const Read& read) {
  const std::size_t colon = word.find(':');
  require(colon != word.npos && word.find(':', colon + 1) == word.npos,
          in_quotes(word) + " is no interval A:B, of which one end may be left out");
  CropRange range;
  if (colon > 0) range.from = read(word.substr(0, colon));
  if (colon + 1 < word.size()) range.to = read(word.substr(colon + 1));
  require(range.from || range.to, "both ends of the interval are left out");
  require(!range.from || !range.to || *range.from <= *range.to,
          in_quotes(word) + " ends before it begins");
  return range;
}

std::int64_t frame_of(const std::string& word) {
  const auto frame = word.ends_with('f') ? parse_integer(word.substr(0, word.size() - 1))
                                         : std::nullopt;
  require(frame && *frame >= 0, in_quotes(word) + " is no number of a frame, as 10f");
  return *frame;
}

std::int64_t time_of(const std::string& word) {
  const auto time_ns = parse_seconds_as_ns(word);
  require(time_ns.has_value(), in_quotes(word) + " is no time in seconds");
  return *time_ns;
}

FilterFunction crop_frames(const CropRange& range) {
  return [range](const Trajectory& trajectory) {
    if (!trajectory.has_times)
      return frames_between(trajectory, range.from.value_or(kFirst), range.to.value_or(kLast));
    const auto end = static_cast<std::int64_t>(trajectory.size());
    std::vector<std::size_t> indices;
    for (std::int64_t i = range.from.value_or(0); i < end && i <= range.to.value_or(end); ++i)
      indices.push_back(static_cast<std::size_t>(i));
    return frames_at(trajectory, indices);
  };
}

FilterFunction parse_crop(FilterWords& words) {
  const bool absolute = words.take_if("at");
  const std::string word = words.take("the interval A:B");
  if (!absolute && word.find('f') != word.npos) return crop_frames(range_of(word, frame_of));
  const CropRange range = range_of(word, time_of);
  return [range, absolute](const Trajectory& trajectory) {
    need_times(trajectory);
    const std::int64_t begin_ns =
        absolute || trajectory.poses.empty() ? 0 : trajectory.poses.front().stamp_ns;
    return frames_between(trajectory, range.from ? begin_ns + *range.from : kFirst,
                          range.to ? begin_ns + *range.to : kLast);
  };
}

/// The times of a list of times, or of a trajectory.
std::vector<std::int64_t> stamps_in_file(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  if (file.next_data(line)) split_blank(line, fields);
  if (fields.size() == 1 && line.find_first_of(",;{") == line.npos) return read_times(path);
  std::vector<std::int64_t> stamps_ns;
  for (const StampedPose& pose : read_timed_poses(path, Orientation::kOptional).poses)
    stamps_ns.push_back(pose.stamp_ns);
  return stamps_ns;
}

std::vector<std::int64_t> stamps_at_rate(const Trajectory& trajectory, double rate_hz) {
  std::vector<std::int64_t> stamps_ns;
  if (trajectory.poses.empty()) return stamps_ns;
  const std::int64_t first_ns = trajectory.poses.front().stamp_ns,
                     last_ns = trajectory.poses.back().stamp_ns;
  require(seconds(first_ns, last_ns) * rate_hz < kMostPosesAtRate,
          "these are more than 100,000,000 poses");
  for (std::int64_t i = 0;; ++i) {
    const std::int64_t stamp_ns =
        first_ns + std::llround(1e9 * static_cast<double>(i) / rate_hz);
    if (stamp_ns > last_ns) return stamps_ns;
    stamps_ns.push_back(stamp_ns);
  }
}

FilterFunction parse_interpolate(FilterWords& words) {
  const std::string word = words.take("a rate, as 10hz, or a file of times");
  const std::optional<Quantity> rate = parse_quantity(word);
  std::vector<std::int64_t> given_ns;
  double rate_hz = 0;
  if (rate && rate->unit == "hz") {
    rate_hz = rate->value;
    require(rate_hz > 0, "a rate of " + word + " is not positive");
  } else {
    given_ns = stamps_in_file(word);
  }
  std::optional<double> gap_s;
  if (words.take_if("gap")) gap_s = words.number("the longest gap [s]");
  require(!gap_s || *gap_s > 0, "the longest gap is not positive");
  return [given_ns, rate_hz, gap_s](const Trajectory& trajectory) {
    need_times(trajectory);
    const double most_s =
        gap_s.value_or(1e-9 * static_cast<double>(longest_spacing_ns(trajectory)));
    return resample(trajectory, rate_hz > 0 ? stamps_at_rate(trajectory, rate_hz) : given_ns,
                    most_s);
  };
}

/// Frames at even distances in the list, the first and the last one included.
std::vector<std::size_t> evenly_chosen(std::size_t size, std::size_t count) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < std::min(size, count); ++i)
    indices.push_back(count >= size ? i
                      : count == 1  ? 0
                                    : (i * (size - 1) + (count - 1) / 2) / (count - 1));
  return indices;
}

std::size_t count_of_frames(FilterWords& words) {
  const std::string& word = words.take("a number of frames");
  const auto count = parse_integer(word);
  require(count && *count > 0, in_quotes(word) + " is not a positive number of frames");
  return static_cast<std::size_t>(*count);
}

FilterFunction parse_downsample(FilterWords& words) {
  if (words.take_if("to")) {
    const std::size_t count = count_of_frames(words);
    return [count](const Trajectory& trajectory) {
      return frames_at(trajectory, evenly_chosen(trajectory.size(), count));
    };
  }
  if (parse_integer(words.peek())) {
    const std::size_t step = count_of_frames(words);
    return [step](const Trajectory& trajectory) {
      std::vector<std::size_t> indices;
      for (std::size_t i = 0; i < trajectory.size(); i += step) indices.push_back(i);
      return frames_at(trajectory, indices);
    };
  }
  FrameSpacing spacing;
  do {
    const std::string& word = words.take("a number of frames or a distance, as 0.5m, 2s or 5deg");
    const std::optional<Quantity> quantity = parse_quantity(word);
    require(quantity && quantity->value > 0 &&
                (quantity->unit == "m" || quantity->unit == "s" || quantity->unit == "deg"),
            in_quotes(word) + " is no distance with its unit: m, s or deg");
    (quantity->unit == "m" ? spacing.m : quantity->unit == "s" ? spacing.s : spacing.deg) =
        quantity->value;
  } while (words.has_next());
  return [spacing](const Trajectory& trajectory) {
    if (spacing.s) need_times(trajectory);
    require(!spacing.deg || trajectory.has_orientation, "the trajectory has positions alone");
    return spaced(trajectory, spacing);
  };
}

FilterFunction parse_sync(FilterWords& words) {
  const std::string path = words.take("a file of times");
  Trajectory other;
  for (const std::int64_t stamp_ns : stamps_in_file(path))
    other.poses.push_back({stamp_ns, std::nullopt});
  AssociationOptions options;
  options.max_difference_s =
      words.has_next() ? words.number("the difference [s]") : kSyncedWithin_s;
  require(options.max_difference_s >= 0, "the difference is negative");
  return [other, options](const Trajectory& trajectory) {
    need_times(trajectory);
    std::vector<std::size_t> indices;
    for (const auto& [i, j] : associate_by_time(trajectory, other, options))
      indices.push_back(static_cast<std::size_t>(i));
    return frames_at(trajectory, indices);
  };
}

FilterFunction parse_posed(FilterWords&) {
  return [](const Trajectory& trajectory) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < trajectory.size(); ++i)
      if (trajectory.poses[i].T_world_body) indices.push_back(i);
    return frames_at(trajectory, indices);
  };
}

FilterFunction parse_distinct(FilterWords&) {
  return [](const Trajectory& trajectory) {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
      const auto& T = trajectory.poses[i].T_world_body;
      const auto* kept = indices.empty() ? nullptr : &trajectory.poses[indices.back()].T_world_body;
      if (T && kept && *kept && T->matrix() == (*kept)->matrix()) continue;
      indices.push_back(i);
    }
    return frames_at(trajectory, indices);
  };
}

FilterFunction parse_offset(FilterWords& words) {
  const std::int64_t offset_ns = words.seconds_ns("the time to add [s]");
  return [offset_ns](Trajectory trajectory) {
    need_times(trajectory);
    for (StampedPose& pose : trajectory.poses) pose.stamp_ns += offset_ns;
    return trajectory;
  };
}

FilterFunction parse_reverse(FilterWords&) {
  return [](Trajectory trajectory) {
    if (trajectory.poses.empty()) return trajectory;
    const std::int64_t ends_ns =
        trajectory.poses.front().stamp_ns + trajectory.poses.back().stamp_ns;
    std::ranges::reverse(trajectory.poses);
    for (StampedPose& pose : trajectory.poses) pose.stamp_ns = ends_ns - pose.stamp_ns;
    return trajectory;
  };
}

FilterFunction parse_merge(FilterWords& words) {
  const Trajectory other = read_timed_poses(words.take("a file"), Orientation::kOptional);
  return [other](const Trajectory& trajectory) {
    return merge({trajectory, other}, Overlap::kRefused).trajectory;
  };
}

}  // namespace

const std::vector<FilterStepKind>& frame_steps() {
  static const std::vector<FilterStepKind> steps = {
      {"crop", "crop [at] A:B",
       "keeps the frames from A to B seconds after the first (`at`: times; `10f:20f`: frames)",
       parse_crop},
      {"downsample", "downsample N",
       "keeps every N-th frame (`to N`: N frames), or poses that are `0.5m 2s 5deg` apart",
       parse_downsample},
      {"interpolate", "interpolate FILE [gap S]",
       "poses at the times in a file or at a rate (`10hz`), none across a gap",
       parse_interpolate},
      {"sync", "sync FILE [S]",
       "keeps the frames that have a partner in a file within S seconds (0.02)",
       parse_sync},
      {"posed", "posed", "leaves out frames without a pose", parse_posed},
      {"distinct", "distinct",
       "leaves out poses that equal the one before in every number",
       parse_distinct},
      {"offset", "offset S", "adds S seconds to the times", parse_offset},
      {"reverse", "reverse",
       "reverses the order of the poses; the times keep their range",
       parse_reverse},
      {"merge", "merge FILE", "adds a trajectory of another time", parse_merge},
  };
  return steps;
}

}  // namespace placegraph
