#pragma once
#include <string>

namespace placegraph {

/// Checks a file that is to be read, before it is opened.
/// A pipe of the shell, as <(...), is accepted. Throws FileError for a folder, for a device and for
/// a named pipe, which would keep the program waiting or never end. Says nothing about a file that
/// is missing.
void require_input_file(const std::string& path);

}  // namespace placegraph
