#pragma once
#include <string>

namespace placegraph {

/// The bytes in base64 (RFC 4648), padded with `=`.
std::string to_base64(const std::string& bytes);

}  // namespace placegraph
