#include <gtest/gtest.h>
#include <placegraph/eval/drawing/text_width.h>

#include "tests/support/seed.h"

namespace placegraph {
namespace text_width_test {

std::string random_text(Random& random, int most, bool spaces) {
  const std::u32string letters = U"aWi._ä€中\x1f600";
  std::string text;
  for (int i = random.index(most + 1); i > 0; --i)
    text += spaces && random.index(5) == 0
                ? " "
                : utf8(letters[static_cast<std::size_t>(random.index(9))]);
  return text;
}

TEST(TextFitting, WidthsAddUpAndGrowWithTheFont) {
  Random random = test::seeded_random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const std::string a = random_text(random, 20, true), b = random_text(random, 20, true);
    const double width = text_width(a + b, 15);
    EXPECT_NEAR(width, text_width(a, 15) + text_width(b, 15), 1e-9);
    EXPECT_NEAR(text_width(a + b, 45), 3 * width, 1e-9);
  }
}

TEST(TextFitting, AShortenedTextIsABeginAndAnEndOfIt) {
  Random random = test::seeded_random(6);
  const std::string dots = "…";
  for (int trial = 0; trial < 400; ++trial) {
    const std::string text = random_text(random, 40, false);
    const double most = random.uniform(text_width(dots, 10), 250);
    const std::string fit = fitted(text, 10, most);
    EXPECT_LE(text_width(fit, 10), most + 1e-9);
    if (text_width(text, 10) <= most) {
      EXPECT_EQ(fit, text);
      continue;
    }
    const std::size_t cut = fit.find(dots);
    ASSERT_NE(cut, std::string::npos);
    const std::string begin = fit.substr(0, cut), end = fit.substr(cut + dots.size());
    EXPECT_TRUE(text.starts_with(begin));
    EXPECT_TRUE(text.ends_with(end));
    const std::size_t kept = code_points(begin).size() + code_points(end).size();
    EXPECT_LT(kept, code_points(text).size());
    EXPECT_LE(code_points(begin).size() - code_points(end).size(), 1u);
  }
}

TEST(TextFitting, LinesHoldAllWordsInOrderAndAsManyAsTheyCan) {
  Random random = test::seeded_random(7);
  for (int trial = 0; trial < 200; ++trial) {
    std::string text;
    for (int i = 1 + random.index(20); i > 0; --i) {
      const auto letters = static_cast<std::size_t>(1 + random.index(8));
      text += (text.empty() ? "" : " ") + std::string(letters, static_cast<char>('a' + i));
    }
    const double most = random.uniform(94, 200);  // the widest word, 8 times m, has 93.5 px
    const std::vector<std::string> lines = wrapped(text, 12, most);
    std::string joined;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      joined += (i > 0 ? " " : "") + lines[i];
      EXPECT_LE(text_width(lines[i], 12), most);
      if (i == 0) continue;
      const std::string word = lines[i].substr(0, lines[i].find(' '));
      EXPECT_GT(text_width(lines[i - 1] + " " + word, 12), most);
    }
    EXPECT_EQ(joined, text);
  }
}

TEST(TextFitting, AnyBytesBecomeCharactersThatHaveUtf8) {
  Random random = test::seeded_random(8);
  for (int trial = 0; trial < 500; ++trial) {
    std::string bytes;
    for (int i = random.index(12); i > 0; --i) bytes += static_cast<char>(random.index(256));
    const std::vector<char32_t> characters = code_points(bytes);
    EXPECT_LE(characters.size(), bytes.size());
    std::string text;
    for (const char32_t c : characters) {
      EXPECT_TRUE(c <= 0x10ffff && !(c >= 0xd800 && c < 0xe000));
      text += utf8(c);
    }
    EXPECT_EQ(code_points(text), characters);
    EXPECT_EQ(text_width(text, 10), text_width(bytes, 10));
  }
}

}  // namespace text_width_test
}  // namespace placegraph
