#pragma once
#include <placegraph/eval/gate/record.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace placegraph::gate_worlds {

using Values = std::vector<std::optional<double>>;

/// A record of one sequence "00" with figures by their keys.
inline Record record_of(const std::vector<std::pair<std::string, Values>>& figures) {
  Record record{{"system"}, {{}}};
  record.sequences[0].name = "00";
  for (const auto& [key, values] : figures) {
    FigureRecord& figure = record.sequences[0].figures.emplace_back();
    figure.key = key;
    figure.values = values;
  }
  return record;
}

inline Values values_of(const std::vector<double>& runs) { return {runs.begin(), runs.end()}; }

}  // namespace placegraph::gate_worlds
