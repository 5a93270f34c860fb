#include <placegraph/eval/drawing/text_width.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace placegraph {
namespace {

/// Widths of U+0020 to U+007E in DejaVu Sans, in thousandths of the height of the font.
constexpr int kWidths[] = {
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361,  318, 337, 636, 636, 636,
    636, 636, 636, 636, 636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632,
    575, 775, 752, 295, 295, 656, 557, 863, 748, 787, 603, 787, 695, 635,  611, 732, 684, 989, 685,
    611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635, 615, 352,  635, 634, 278, 278, 579,
    278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592,  525, 636, 337, 636, 838};

double em_width(char32_t c) {
  if (c < 0x20) return kWidths[0] / 1000.0;
  if (c - 0x20 < std::size(kWidths)) return kWidths[c - 0x20] / 1000.0;
  return c < 0x250 ? 0.84 : 1.05;  // Latin letters with marks; all others
}

double width_of(const std::vector<char32_t>& characters, double size_px) {
  double width = 0;
  for (const char32_t c : characters) width += em_width(c);
  return width * size_px;
}

}  // namespace

std::vector<char32_t> code_points(const std::string& text) {
  constexpr char32_t kReplacement = 0xfffd;
  std::vector<char32_t> characters;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) -> unsigned {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u;
    };
    const unsigned first = byte(0);
    const std::size_t length = first < 0x80                     ? 1
                               : first >= 0xc2 && first < 0xe0  ? 2
                               : first >= 0xe0 && first < 0xf0  ? 3
                               : first >= 0xf0 && first <= 0xf4 ? 4
                                                                : 0;
    char32_t c = length == 1 ? first : first & (0x7fu >> length);
    bool good = length > 0;
    for (std::size_t k = 1; k < length && good; ++k) {
      good = (byte(k) & 0xc0) == 0x80;
      c = c << 6 | (byte(k) & 0x3f);
    }
    constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    good = good && c >= kLeast[length] && c <= 0x10ffff && (c < 0xd800 || c >= 0xe000) &&
           c != 0xfffe && c != 0xffff;
    characters.push_back(good ? c : kReplacement);
    i += good ? length : 1;
  }
  return characters;
}

std::string utf8(char32_t c) {
  const auto tail = [&](int shift) { return static_cast<char>(0x80 | (c >> shift & 0x3f)); };
  if (c < 0x80) return {static_cast<char>(c)};
  if (c < 0x800) return {static_cast<char>(0xc0 | c >> 6), tail(0)};
  if (c < 0x10000) return {static_cast<char>(0xe0 | c >> 12), tail(6), tail(0)};
  return {static_cast<char>(0xf0 | c >> 18), tail(12), tail(6), tail(0)};
}

double text_width(const std::string& text, double size_px) {
  return width_of(code_points(text), size_px);
}

std::string fitted(const std::string& text, double size_px, double most_px) {
  const std::vector<char32_t> all = code_points(text);
  if (width_of(all, size_px) <= most_px) return text;
  std::size_t begin = 0, end = 0;  // characters kept
  double width = em_width(U'…') * size_px;
  while (begin + end < all.size()) {
    const bool front = begin <= end;
    width += size_px * em_width(front ? all[begin] : all[all.size() - 1 - end]);
    if (width > most_px) break;
    ++(front ? begin : end);
  }
  std::string kept;
  for (std::size_t i = 0; i < begin; ++i) kept += utf8(all[i]);
  kept += utf8(U'…');
  for (std::size_t i = all.size() - end; i < all.size(); ++i) kept += utf8(all[i]);
  return kept;
}

std::vector<std::string> wrapped(const std::string& text, double size_px, double most_px) {
  std::vector<std::string> lines;
  std::string line;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const std::string longer = line.empty() ? word : line + ' ' + word;
    if (line.empty() || text_width(longer, size_px) <= most_px) {
      line = longer;
    } else {
      lines.push_back(fitted(line, size_px, most_px));
      line = word;
    }
    begin = end + 1;
  }
  if (!line.empty()) lines.push_back(fitted(line, size_px, most_px));
  return lines;
}

}  // namespace placegraph
