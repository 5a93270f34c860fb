#pragma once
#include <gtest/gtest.h>
#include <placegraph/eval/drawing/text_width.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace placegraph::test {

/// The value of an attribute in a tag; empty if it has none.
inline std::string attribute(const std::string& tag, const std::string& name) {
  const std::size_t at = tag.find(" " + name + "=\"");
  if (at == std::string::npos) return "";
  const std::size_t begin = at + name.size() + 3;
  return tag.substr(begin, tag.find('"', begin) - begin);
}

inline double number(const std::string& tag, const std::string& name) {
  return std::strtod(attribute(tag, name).c_str(), nullptr);
}

inline std::string unescaped(std::string text) {
  for (const auto& [from, to] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; ++at)
      text.replace(at, std::string(from).size(), to);
  return text;
}

/// The texts of a picture, unescaped.
inline std::vector<std::string> texts_of(const std::string& svg) {
  std::vector<std::string> texts;
  for (std::size_t at = 0; (at = svg.find("<text ", at)) != std::string::npos;) {
    const std::size_t begin = svg.find('>', at) + 1;
    at = svg.find("</text>", begin);
    texts.push_back(unescaped(svg.substr(begin, at - begin)));
  }
  return texts;
}

/// The tags of one name of a picture, without their brackets.
inline std::vector<std::string> tags_of(const std::string& svg, const std::string& name) {
  std::vector<std::string> tags;
  for (std::size_t at = 0; (at = svg.find("<" + name + " ", at)) != std::string::npos; ++at)
    tags.push_back(svg.substr(at + 1, svg.find('>', at) - at - 1));
  return tags;
}

/// The numbers in a text, whatever stands between them.
inline std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; (at = text.find_first_of("-.0123456789", at)) != std::string::npos;) {
    char* end = nullptr;
    numbers.push_back(std::strtod(text.c_str() + at, &end));
    at = static_cast<std::size_t>(end - text.c_str());
  }
  return numbers;
}

/// Tags close in the order in which they open, all numbers are finite, and every text lies inside
/// the view box.
inline void expect_good_svg(const std::string& svg) {
  ASSERT_EQ(svg.rfind("<svg ", 0), 0u);
  const std::string head = svg.substr(0, svg.find('>'));
  const double width = number(head, "width"), height = number(head, "height");
  EXPECT_EQ(attribute(head, "viewBox"),
            "0 0 " + attribute(head, "width") + " " + attribute(head, "height"));
  for (const char* bad : {"\"nan", "\"inf", ",nan", ",inf", ":nan", " nan,", "-nan", " inf,"})
    EXPECT_EQ(svg.find(bad), std::string::npos) << bad;
  std::vector<std::string> open;
  for (std::size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const std::size_t end = svg.find('>', at);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = svg.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(0, tag.find(' '));
    if (tag[0] == '/') {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ("/" + open.back(), tag);
      open.pop_back();
      continue;
    }
    if (tag.back() != '/') open.push_back(name);
    if (name != "text") continue;
    const std::string text = unescaped(svg.substr(end + 1, svg.find("</text>", end) - end - 1));
    const double size = number(tag, "font-size"), length = text_width(text, size);
    const std::string anchor = attribute(tag, "text-anchor");
    const double before = anchor == "start" ? 0 : anchor == "middle" ? length / 2 : length;
    const bool rotated = !attribute(tag, "transform").empty();
    const double x = number(tag, "x"), y = number(tag, "y");
    constexpr double kRounding = 0.2;
    if (rotated) {
      EXPECT_GE(x - 0.8 * size, -kRounding) << text;
      EXPECT_LE(y + before, height + kRounding) << text;
      EXPECT_GE(y + before - length, -kRounding) << text;
    } else {
      EXPECT_GE(x - before, -kRounding) << text;
      EXPECT_LE(x - before + length, width + kRounding) << text;
      EXPECT_GE(y - 0.8 * size, -kRounding) << text;
      EXPECT_LE(y + 0.25 * size, height + kRounding) << text;
    }
  }
  EXPECT_TRUE(open.empty());
}

}  // namespace placegraph::test
