#include <placegraph/io/loops/name_index.h>

namespace placegraph {
namespace {

std::string_view end_of(std::string_view path) {
  return path.substr(path.find_last_of('/') + 1);  // npos + 1 is 0
}

}  // namespace

NameIndex::NameIndex(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const FrameId image(static_cast<std::int64_t>(i));
    for (const auto& [index, key] :
         {std::pair{&paths_, std::string(names[i])}, std::pair{&ends_, std::string(end_of(names[i]))}})
      if (const auto [entry, is_new] = index->emplace(key, image); !is_new)
        entry->second = std::nullopt;
  }
}

std::optional<FrameId> NameIndex::find(std::string_view name) const {
  if (const auto entry = paths_.find(name); entry != paths_.end()) return entry->second;
  const auto entry = ends_.find(end_of(name));
  return entry == ends_.end() ? std::nullopt : entry->second;
}

}  // namespace placegraph
