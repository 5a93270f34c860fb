#pragma once
#include <string>
#include <string_view>

namespace placegraph {

/// The bytes in base64 (RFC 4648), padded with `=`.
std::string to_base64(std::string_view bytes);

}  // namespace placegraph
