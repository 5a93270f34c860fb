#pragma once
#include <string>

namespace placegraph {

/// The bytes of a file, as they are.
///
/// Throws FileError as require_input_file (text_file.h), or if it cannot be read.
std::string read_bytes(const std::string& path);

}  // namespace placegraph
