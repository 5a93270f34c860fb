#pragma once
#include <placegraph/graph/core/ids.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// Images by their names: a path stands for the image whose file it names.
class NameIndex {
 public:
  /// The images 0, 1, ... of these names.
  explicit NameIndex(const std::vector<std::string>& names);

  /// The image of that path or, where only one ends like it, of its last part; nothing else.
  std::optional<FrameId> find(std::string_view name) const;

 private:
  std::map<std::string, std::optional<FrameId>, std::less<>> paths_, ends_;  ///< nothing: several
};

}  // namespace placegraph
