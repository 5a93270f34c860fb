#pragma once
#include <cstddef>
#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// The words of a text in lines of at most `width` bytes.
/// All but the first begin with `indent`. A word longer than a line has a line of its own. Ends
/// with a line break.
std::string wrapped_text(const std::string& text, const std::string& indent,
                         std::size_t width = 100);

}  // namespace placegraph
