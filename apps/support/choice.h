#pragma once
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <string>
#include <vector>

namespace placegraph::apps {

/// The value of an enumeration whose names are `names`, in order.
/// Throws an ArgumentError that begins with `option` if `name` is not among them.
template <class Enum>
Enum choice(const std::string& option, const std::vector<std::string>& names,
            const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    std::string all;
    for (const std::string& one : names) all += (all.empty() ? "" : ", ") + one;
    throw ArgumentError(option + ": '" + name + "' is none of " + all);
  }
  return static_cast<Enum>(found - names.begin());
}

}  // namespace placegraph::apps
