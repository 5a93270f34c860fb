#pragma once
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The text of a JSON value (nlohmann::json or ordered_json) with its last line ended.
/// Bytes of a name that are not UTF-8 become replacement characters.
template <class Json>
std::string json_text(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace placegraph
