#include <placegraph/graph/core/error.h>
#include <placegraph/io/match_file.h>
#include <placegraph/io/text_file.h>

#include <cmath>

namespace placegraph {
namespace {

constexpr double kMaxPixel = 1e6;  ///< larger than any image; its fourth power is far from overflow

}  // namespace

MatchFile read_matches(const std::string& path) {
  TextFile file(path);
  MatchFile matches;
  std::string_view line;
  std::vector<std::string_view> fields;
  constexpr const char* kNames[] = {"xA", "yA", "xB", "yB"};
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() < 4)
      file.fail(std::to_string(fields.size()) + " columns, at least 4 expected: xA yA xB yB");
    double px[4];
    for (std::size_t i = 0; i < 4; ++i) {
      px[i] = file.number(fields[i], kNames[i]);
      if (std::abs(px[i]) > kMaxPixel)
        file.fail(std::string(kNames[i]) + ": " + in_quotes(fields[i]) + " is no pixel");
    }
    matches.px_a.emplace_back(px[0], px[1]);
    matches.px_b.emplace_back(px[2], px[3]);
  }
  if (matches.px_a.empty()) throw FileError(path, "no match in it");
  return matches;
}

}  // namespace placegraph
