#include <placegraph/graph/scene/environment.h>

#include <algorithm>
#include <array>

namespace placegraph {
namespace {

const std::array<std::string, kEnvironmentCount> kEnvironmentNames{"street", "road", "corridor",
                                                                   "room", "hall"};
const std::string kPrefix = "environment:";

}  // namespace

const std::string& environment_name(Environment kind) {
  return kEnvironmentNames[static_cast<std::size_t>(kind)];
}

std::optional<Environment> environment_of_name(const std::string& name) {
  const auto known = std::find(kEnvironmentNames.begin(), kEnvironmentNames.end(), name);
  if (known == kEnvironmentNames.end()) return std::nullopt;
  return static_cast<Environment>(known - kEnvironmentNames.begin());
}

Assumptions assumptions_of(Environment kind) {
  switch (kind) {
    case Environment::kStreet:
      return {true, false, true};  // houses follow their street, which is curved
    case Environment::kRoad:
      return {true, false, true};
    case Environment::kCorridor:
      return {true, true, false};
    case Environment::kRoom:
      return {false, true, false};  // tables, beds and steps hide the floor ahead
    case Environment::kHall:
      return {true, true, false};
  }
  return {};
}

void label_environment(Place& place, Environment kind) {
  std::erase_if(place.labels, [](const std::string& label) { return label.starts_with(kPrefix); });
  place.labels.push_back(kPrefix + environment_name(kind));
}

std::optional<Environment> environment_of(const Place& place) {
  for (const std::string& label : place.labels)
    if (label.starts_with(kPrefix)) return environment_of_name(label.substr(kPrefix.size()));
  return std::nullopt;
}

}  // namespace placegraph
