#include <fmt/format.h>
#include <placegraph/eval/alignment/alignment_options.h>
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

}  // namespace placegraph
