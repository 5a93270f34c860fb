#include "apps/support/match_file.h"
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>

#include <array>
#include <cmath>

namespace placegraph::apps {
namespace {

/// Larger than any image or scene; its fourth power does not overflow by far.
constexpr double kMostMatch = 1e6;

using MatchRow = std::array<double, 6>;

/// Reads the first columns of every line, with the given names.
std::vector<MatchRow> read_rows(const std::string& path, const std::vector<const char*>& names) {
  TextFile file(path);
  std::vector<MatchRow> rows;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() < names.size()) {
      std::string wanted;
      for (const char* name : names) wanted += std::string(" ") + name;
      file.fail(std::to_string(fields.size()) + " columns, at least " +
                std::to_string(names.size()) + " expected:" + wanted);
    }
    MatchRow row{};
    for (std::size_t i = 0; i < names.size(); ++i) {
      row[i] = file.number(fields[i], names[i]);
      if (std::abs(row[i]) > kMostMatch)
        file.fail(std::string(names[i]) + ": " + in_quotes(fields[i]) + " is above 1e6");
    }
    rows.push_back(row);
  }
  if (rows.empty()) throw FileError(path, "no match in it");
  return rows;
}

}  // namespace

MatchFile read_matches(const std::string& path) {
  MatchFile matches;
  for (const MatchRow& row : read_rows(path, {"xA", "yA", "xB", "yB"})) {
    matches.px_a.emplace_back(row[0], row[1]);
    matches.px_b.emplace_back(row[2], row[3]);
  }
  return matches;
}

PointPairFile read_point_pairs(const std::string& path) {
  PointPairFile pairs;
  for (const MatchRow& row : read_rows(path, {"xA", "yA", "zA", "xB", "yB", "zB"})) {
    pairs.points_a.emplace_back(row[0], row[1], row[2]);
    pairs.points_b.emplace_back(row[3], row[4], row[5]);
  }
  return pairs;
}

SeenPointFile read_seen_points(const std::string& path) {
  SeenPointFile seen;
  for (const MatchRow& row : read_rows(path, {"X", "Y", "Z", "x", "y"})) {
    seen.points.emplace_back(row[0], row[1], row[2]);
    seen.px.emplace_back(row[3], row[4]);
  }
  return seen;
}

}  // namespace placegraph::apps
