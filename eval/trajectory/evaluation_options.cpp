#include <fmt/format.h>
#include <placegraph/eval/trajectory/evaluation_options.h>
#include <placegraph/graph/core/error.h>

namespace placegraph {

std::string to_string(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "none";
    case Alignment::kOrigin:
      return "origin";
    case Alignment::kSe3:
      return "se3";
    case Alignment::kSim3:
      return "sim3";
    case Alignment::kScale:
      return "scale";
    case Alignment::kYaw:
      return "yaw";
  }
  throw ArgumentError("unknown alignment");
}

std::string to_string(const AlignmentSpan& span) {
  if (span.unit == AlignmentSpan::Unit::kAll) return {};
  static constexpr const char* kNames[] = {"", "frames", "seconds", "poses"};
  const std::string end = span.end < AlignmentSpan{}.end ? fmt::format("{:g}", span.end) : "";
  return fmt::format("{} {:g}:{}", kNames[static_cast<int>(span.unit)], span.begin, end);
}

void SegmentOptions::check() const {
  check_ranges(*this);
  require(!lengths_m.empty(), "lengths_m: empty list");
}

void visit(OptionVisitor& field, SegmentOptions& o) {
  field("lengths_m", o.lengths_m, "segment lengths of t_rel and r_rel [m]", {1e-3, 1e6});
  field("step", o.step, "frames between the starts of two segments", {1, 1e6});
  field("frame_rate_hz", o.frame_rate_hz,
        "frame rate for speeds, if the ground truth has no times [Hz]", {1e-3, 1e4});
  field("speed_bin_m_per_s", o.speed_bin_m_per_s,
        "width of an interval of the table per speed [m/s]", {1e-3, 1e3});
}

void AlignmentSpan::check() const {
  check_ranges(*this);
  require(begin < end, "align_over: the span ends before it begins");
}

void visit(OptionVisitor& field, AlignmentSpan& o) {
  field.choice("unit", o.unit, {"all", "frames", "seconds", "poses"},
               "what begin and end count: numbers of frames, seconds since the first posed frame, "
               "or posed frames");
  field("begin", o.begin, "first value of the span", {-1e12, 1e12});
  field("end", o.end, "first value behind the span", {-1e12, 1e12});
}

void visit(OptionVisitor& field, RelativeErrorOptions& o) {
  const std::string before = to_string(o.deltas);
  std::string deltas = before;
  field("deltas", deltas, "lengths of steps, as 10f,1s,5m,10deg; empty: none");
  if (deltas != before) o.deltas = parse_deltas(deltas);
  field.choice("pairs", o.pairs, {"consecutive", "all"}, "where steps begin");
}

void EvaluationOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, EvaluationOptions& o) {
  field.choice("align", o.alignment, {"none", "origin", "se3", "sim3", "scale", "yaw"},
               "transformation fitted before the comparison");
  field.group("align_over", o.align_over, "poses that the transformation is fitted to");
  field.choice("vertical", o.vertical, {"estimated", "x", "y", "z"},
               "vertical of the ground truth's world");
  field.choice("part", o.part, {"space", "xy", "xz", "yz", "fitted", "x", "y", "z"},
               "part of the position errors that is judged");
  field.choice("associate", o.association, {"auto", "index", "time"},
               "association of the poses of the two files");
  field("max_difference_s", o.time.max_difference_s,
        "largest difference of the stamps of a pair [s]", {0, 1e6});
  field("offset_s", o.time.offset_s, "offset added to the estimate's stamps [s]", {-1e12, 1e12});
  field.group("segments", o.segments, "segments of t_rel and r_rel");
  field.group("relative", o.relative, "relative errors over other steps than one frame");
}

}  // namespace placegraph
