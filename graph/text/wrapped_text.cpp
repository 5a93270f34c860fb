#include <placegraph/graph/text/wrapped_text.h>

#include <sstream>

namespace placegraph {

std::string wrapped_text(const std::string& text, const std::string& indent, std::size_t width) {
  std::istringstream words(text);
  std::string out, line, word;
  bool empty = true;  // no word is on the line
  while (words >> word) {
    if (!empty && line.size() + 1 + word.size() > width) {
      out += line + "\n";
      line = indent;
      empty = true;
    }
    line += (empty ? "" : " ") + word;
    empty = false;
  }
  return out + line + "\n";
}

}  // namespace placegraph
