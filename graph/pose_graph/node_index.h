#pragma once
#include <placegraph/graph/core/ids.h>

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Positions of nodes by their ids.
/// Ids that are close together (0..n-1 as in most files) are looked up in a table, others in a hash
/// map; memory is linear in the number of nodes in both cases.
class NodeIndex {
 public:
  NodeIndex() = default;
  /// Indexes `ids` by their positions; of several equal ids the first is used.
  explicit NodeIndex(const std::vector<NodeId>& ids);

  /// Position of the id; nothing if it is unknown.
  std::optional<int> find(NodeId id) const {
    if (table_.empty()) return find_in_map(id);
    const std::uint64_t offset =
        static_cast<std::uint64_t>(id.value()) - static_cast<std::uint64_t>(low_);
    if (offset >= table_.size() || table_[offset] == kNone) return std::nullopt;
    return table_[offset];
  }
  /// Whether the id is known.
  bool contains(NodeId id) const { return find(id).has_value(); }
  /// Position of the id; throws ArgumentError if it is unknown.
  int at(NodeId id) const;

 private:
  static constexpr int kNone = -1;  // in the table: no node has this id

  std::optional<int> find_in_map(NodeId id) const;

  std::int64_t low_ = 0;
  std::vector<int> table_;
  std::unordered_map<NodeId, int> map_;
};

}  // namespace placegraph
