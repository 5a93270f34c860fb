#include <fmt/format.h>
#include <fmt/ranges.h>
#include <placegraph/eval/errors/delta.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <array>
#include <charconv>
#include <cmath>

namespace placegraph {
namespace {

struct UnitName {
  const char* suffix;
  const char* singular;
  const char* plural;
};
/// In the order of Delta::Unit.
constexpr std::array<UnitName, 4> kUnitNames = {
    {{"f", "frame", "frames"}, {"s", "s", "s"}, {"m", "m", "m"}, {"deg", "deg", "deg"}}};

const UnitName& name_of(Delta::Unit unit) { return kUnitNames[static_cast<std::size_t>(unit)]; }

}  // namespace

Delta parse_delta(const std::string& text) {
  const char* const end = text.data() + text.size();
  Delta delta;
  const auto [rest, error] = std::from_chars(text.data(), end, delta.value);
  const std::string suffix(rest, end);
  const auto wrong = [&](const char* why) {
    return ArgumentError("delta '" + text + "': " + why +
                         " (10f: frames, 1s: seconds, 5m: metres, 10deg or 0.2rad: rotation)");
  };
  if (error != std::errc()) throw wrong("is no number with a unit");
  bool known = suffix.empty();
  for (std::size_t i = 0; i < kUnitNames.size() && !known; ++i)
    if ((known = suffix == kUnitNames[i].suffix)) delta.unit = static_cast<Delta::Unit>(i);
  if (suffix == "rad") {
    delta = {rad_to_deg(delta.value), Delta::Unit::kDegrees};
    known = true;
  }
  if (!known) throw wrong("has an unknown unit");
  // Beyond a billion no drive is that long, and a number of frames would not fit an int.
  if (!(delta.value > 0 && delta.value <= 1e9)) throw wrong("is not positive, or above 1e9");
  if (delta.unit == Delta::Unit::kFrames && delta.value != std::floor(delta.value))
    throw wrong("frames are counted in whole numbers");
  return delta;
}

std::vector<Delta> parse_deltas(const std::string& text) {
  std::vector<Delta> deltas;
  if (text.empty()) return deltas;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    deltas.push_back(parse_delta(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return deltas;
}

std::string to_string(const Delta& delta) {
  return fmt::format("{}{}", delta.value, name_of(delta.unit).suffix);
}

std::string to_string(const std::vector<Delta>& deltas) {
  std::vector<std::string> texts;
  for (const Delta& delta : deltas) texts.push_back(to_string(delta));
  return fmt::format("{}", fmt::join(texts, ","));
}

std::string text_of(const Delta& delta) {
  const UnitName& name = name_of(delta.unit);
  return fmt::format("{} {}", delta.value, delta.value == 1 ? name.singular : name.plural);
}

}  // namespace placegraph
