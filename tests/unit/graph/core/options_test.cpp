#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/options.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace placegraph {
namespace options_test {

enum class Metric { kSsd, kZncc };

struct InnerOptions {
  double noise_px = 0.1;
  Metric metric = Metric::kZncc;
};

void visit(OptionVisitor& field, InnerOptions& o) {
  field("noise_px", o.noise_px, "noise", {0, 10});
  field.choice("metric", o.metric, {"ssd", "zncc"}, "similarity");
}

struct OuterOptions {
  bool loops = true;
  int window_px = 21;
  std::uint64_t seed = 18446744073709551615ull;
  std::string name = "a b";
  std::vector<double> lengths_m = {100, 0.5};
  InnerOptions inner;
  InnerOptions other;
};

void visit(OptionVisitor& field, OuterOptions& o) {
  field("loops", o.loops, "close loops");
  field("window_px", o.window_px, "side of the window", {5, 63});
  field("seed", o.seed, "of all randomness");
  field("name", o.name, "for people");
  field("lengths_m", o.lengths_m, "of segments", {0, 1000});
  field.group("inner", o.inner, "the inside");
  field.group("other", o.other, "the other side");
}

TEST(ListOptions, FlattensGroupsInOrder) {
  std::vector<std::string> paths, values, types;
  for (const OptionEntry& entry : list_options(OuterOptions())) {
    paths.push_back(entry.path);
    values.push_back(entry.value);
    types.push_back(entry.type);
  }
  using testing::ElementsAre;
  EXPECT_THAT(paths, ElementsAre("loops", "window_px", "seed", "name", "lengths_m", "inner",
                                 "inner.noise_px", "inner.metric", "other", "other.noise_px",
                                 "other.metric"));
  EXPECT_THAT(values, ElementsAre("true", "21", "18446744073709551615", "\"a b\"", "[100, 0.5]", "",
                                  "0.1", "zncc", "", "0.1", "zncc"));
  EXPECT_THAT(types, ElementsAre("bool", "int", "uint", "string", "list", "group", "double",
                                 "choice", "group", "double", "choice"));
}

TEST(ListOptions, CarriesDocRangeAndChoices) {
  const auto entries = list_options(OuterOptions());
  EXPECT_EQ(entries[1].doc, "side of the window");
  EXPECT_EQ(entries[1].range.min, 5);
  EXPECT_EQ(entries[1].range.max, 63);
  EXPECT_THAT(entries[7].choices, testing::ElementsAre("ssd", "zncc"));
}

TEST(ListOptions, WritesStringsThatYamlReadsBackAsStrings) {
  const auto written = [](const std::string& name) {
    OuterOptions options;
    options.name = name;
    return list_options(options)[3].value;
  };
  EXPECT_EQ(written("vocabulary.bin"), "vocabulary.bin");
  EXPECT_EQ(written(""), "\"\"");
  EXPECT_EQ(written("true"), "\"true\"");
  EXPECT_EQ(written("12"), "\"12\"");
  EXPECT_EQ(written("a: b # c"), "\"a: b # c\"");
  EXPECT_EQ(written("say \"no\"\\\n"), "\"say \\\"no\\\"\\\\\\n\"");
}

TEST(ListOptions, WritesNumbersThatReadBackTheSame) {
  for (const double value : {1. / 3, 1e-300, 5e20, 0.1 + 0.2}) {
    InnerOptions options;
    options.noise_px = value;
    EXPECT_EQ(std::stod(list_options(options)[0].value), value);
  }
  InnerOptions options;
  options.noise_px = std::numeric_limits<double>::infinity();
  EXPECT_EQ(list_options(options)[0].value, ".inf");
}

std::string complaint(const std::function<void(OuterOptions&)>& spoil) {
  OuterOptions options;
  spoil(options);
  try {
    check_ranges(options);
  } catch (const ArgumentError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CheckRanges, NamesTheFieldTheValueAndTheRange) {
  EXPECT_EQ(complaint([](auto&) {}), "accepted");
  EXPECT_EQ(complaint([](auto& o) { o.window_px = 4; }), "window_px: 4 outside [5, 63]");
  EXPECT_EQ(complaint([](auto& o) { o.window_px = 64; }), "window_px: 64 outside [5, 63]");
  EXPECT_EQ(complaint([](auto& o) { o.inner.noise_px = -0.5; }),
            "inner.noise_px: -0.5 outside [0, 10]");
  EXPECT_EQ(complaint([](auto& o) { o.other.noise_px = NAN; }),
            "other.noise_px: .nan outside [0, 10]");
  EXPECT_EQ(complaint([](auto& o) {
              o.lengths_m = {1, 2000};
            }),
            "lengths_m: 2000 outside [0, 1000]");
}

TEST(CheckRanges, AcceptsBothEndsOfTheInterval) {
  EXPECT_EQ(complaint([](auto& o) { o.window_px = 5; }), "accepted");
  EXPECT_EQ(complaint([](auto& o) { o.window_px = 63; }), "accepted");
}

TEST(CheckRanges, RefusesAnEnumeratorThatHasNoName) {
  EXPECT_THAT(complaint([](auto& o) { o.inner.metric = static_cast<Metric>(2); }),
              testing::StartsWith("inner.metric: 2"));
}

struct MarkedInner {
  int a = 1, b = 2;
};

void visit(OptionVisitor& field, MarkedInner& o) {
  field("a", o.a, "no mark: the level of the group");
  field.basic()("b", o.b, "a mark of its own");
}

struct MarkedOptions {
  int first = 1, second = 2;
  MarkedInner inner, plain;
};

void visit(OptionVisitor& field, MarkedOptions& o) {
  field.basic().formerly("one")("first", o.first, "basic, and had another key");
  field("second", o.second, "the marks of the field before are gone");
  field.internal().formerly("inside").group("inner", o.inner, "an internal group");
  field.group("plain", o.plain, "a group without marks");
}

TEST(ListOptions, KnowsLevelsAndFormerPaths) {
  std::vector<std::string> found;
  for (const OptionEntry& entry : list_options(MarkedOptions()))
    found.push_back(entry.path + " " + std::to_string(static_cast<int>(entry.level)) + " " +
                    entry.former_path);
  EXPECT_THAT(found, testing::ElementsAre("first 0 one", "second 1 ", "inner 2 inside",
                                          "inner.a 2 inside.a", "inner.b 0 inside.b", "plain 1 ",
                                          "plain.a 1 ", "plain.b 0 "));
}

}  // namespace options_test
}  // namespace placegraph
