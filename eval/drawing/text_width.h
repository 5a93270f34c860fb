#pragma once
#include <string>
#include <vector>

namespace placegraph {

/// The characters of a text in UTF-8; U+FFFD for bytes that are none.
std::vector<char32_t> code_points(const std::string& text);
std::string utf8(char32_t character);

/// Width of a text [px] in DejaVu Sans at this height of the font.
/// It is exact for ASCII, up to kerning, and an upper bound for most others. Fonts that replace it
/// in other programs (Verdana, Helvetica, Arial) are not wider.
double text_width(const std::string& text, double size_px);

/// The text, or its begin and end with "…" between them, so that it is not wider than this.
std::string fitted(const std::string& text, double size_px, double most_px);

/// Lines of a text that are not wider than this, broken at spaces; longer words are fitted().
std::vector<std::string> wrapped(const std::string& text, double size_px, double most_px);

}  // namespace placegraph
