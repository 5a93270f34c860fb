#pragma once
#include <string>
#include <string_view>

namespace placegraph {

/// The bytes in base64 (RFC 4648), padded with `=`.
std::string to_base64(std::string_view bytes);

/// The bytes of a text that to_base64() made.
std::string from_base64(std::string_view text);

}  // namespace placegraph
