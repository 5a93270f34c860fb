#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/node_index.h>

#include <algorithm>
#include <string>

namespace placegraph {
namespace {
constexpr std::uint64_t kTablePerNode = 4;  ///< a table may have this many entries per node
}

NodeIndex::NodeIndex(const std::vector<NodeId>& ids) {
  if (ids.empty()) return;
  const auto [low, high] = std::minmax_element(ids.begin(), ids.end());
  // Unsigned, since the distance of two ids may exceed the range of a signed number.
  const std::uint64_t span =
      static_cast<std::uint64_t>(high->value()) - static_cast<std::uint64_t>(low->value());
  if (span < kTablePerNode * ids.size()) {
    low_ = low->value();
    table_.assign(static_cast<std::size_t>(span) + 1, kNone);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      int& place = table_[static_cast<std::size_t>(ids[i].value() - low_)];
      if (place == kNone) place = static_cast<int>(i);
    }
    return;
  }
  map_.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) map_.emplace(ids[i], static_cast<int>(i));
}

std::optional<int> NodeIndex::find_in_map(NodeId id) const {
  const auto found = map_.find(id);
  return found == map_.end() ? std::nullopt : std::optional(found->second);
}

int NodeIndex::at(NodeId id) const {
  const std::optional<int> position = find(id);
  if (!position) throw ArgumentError("pose graph: there is no node " + to_string(id));
  return *position;
}

}  // namespace placegraph
