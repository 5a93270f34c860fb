#include <gmock/gmock.h>
#include <placegraph/frontend/places/descriptors/combined_retrieval.h>
#include <placegraph/frontend/places/descriptors/descriptor_retrieval.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "tests/support/message_of.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace descriptor_retrieval_test {

using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Has a descriptor for every frame.
struct Listed final : ImageDescriber {
  std::vector<std::vector<float>> of_frame;
  int described = 0;
  std::vector<float> describe(const Image&, FrameId frame) override {
    ++described;
    return of_frame.at(static_cast<std::size_t>(frame.value()));
  }
};

std::vector<float> random_vector(Random& random, int length, double scale = 1) {
  std::vector<float> vector;
  for (int i = 0; i < length; ++i) vector.push_back(static_cast<float>(scale * random.normal()));
  return vector;
}

double product(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i]) * b[i];
  return sum;
}

void add_frames(PlaceRetrieval& retrieval, int count, const Image& image = {}) {
  for (int i = 0; i < count; ++i) {
    retrieval.begin_frame(FrameId(i));
    retrieval.add(image);
  }
}

TEST(DescriptorRetrieval, FindsTheLargestProductsOfAnyRange) {
  Random random = test::seeded_random(7);
  for (const bool normalize : {true, false})
    for (const int length : {1, 5, 300}) {
      const auto describer = std::make_shared<Listed>();
      constexpr int kStored = 90;
      for (int i = 0; i <= kStored; ++i)
        describer->of_frame.push_back(random_vector(random, length, random.uniform(0.1, 50)));
      DescriptorRetrieval retrieval(describer, normalize);
      add_frames(retrieval, kStored);
      retrieval.begin_frame(FrameId(kStored));
      const std::vector<float>& query = describer->of_frame[kStored];
      for (const auto& [first, last] :
           std::vector<std::pair<int, int>>{{0, 89}, {10, 40}, {7, 7}}) {
        const auto list = retrieval.query({}, first, last);
        const int count = std::min(last - first + 1, DescriptorRetrieval::kShortList);
        ASSERT_EQ(static_cast<int>(list.size()), count);
        std::vector<double> expected;
        for (int view = first; view <= last; ++view) {
          const auto& stored = describer->of_frame[static_cast<std::size_t>(view)];
          const double unit = std::sqrt(product(query, query) * product(stored, stored));
          expected.push_back(product(query, stored) / (normalize ? unit : 1));
          const double tolerance = 1e-5 * unit;  // single precision
          EXPECT_NEAR(retrieval.similarity({}, view), expected.back(), tolerance);
        }
        for (const PlaceSimilarity& each : list) {
          const double score = expected[static_cast<std::size_t>(each.view - first)];
          EXPECT_NEAR(each.score, score, 1e-5 * std::max(1.0, std::abs(score)));
        }
        std::ranges::sort(expected, std::greater());
        for (std::size_t i = 0; i < list.size(); ++i)
          EXPECT_NEAR(list[i].score, expected[i], 1e-5 * std::max(1.0, std::abs(expected[i])));
      }
      EXPECT_THAT(retrieval.query({}, 5, 4), IsEmpty());
    }
}

TEST(DescriptorRetrieval, AFrameIsDescribedOnceUntilItForgetsAll) {
  const auto describer = std::make_shared<Listed>();
  describer->of_frame = {{1, 0}, {0, 1}};
  DescriptorRetrieval retrieval(describer);
  add_frames(retrieval, 2);
  retrieval.begin_frame(FrameId(1));
  EXPECT_EQ(retrieval.query({}, 0, 1).front().view, 1);
  EXPECT_EQ(describer->described, 2);
  retrieval.clear();
  EXPECT_EQ(retrieval.size(), 0);
  describer->of_frame = {{1, 0, 0}, {0, 1, 0}};  // another length, after all were forgotten
  EXPECT_THAT(retrieval.query({}, 0, 1), IsEmpty());
  add_frames(retrieval, 2);
  EXPECT_EQ(describer->described, 5);
}

TEST(DescriptorRetrieval, RefusesDescriptorsThatCannotBeCompared) {
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const auto refusal = [](std::vector<float> second, bool normalize) {
    const auto describer = std::make_shared<Listed>();
    describer->of_frame = {{1, 0}, std::move(second)};
    DescriptorRetrieval retrieval(describer, normalize);
    return message_of<ArgumentError>([&] { add_frames(retrieval, 2); });
  };
  EXPECT_THAT(refusal({nan, 1}, true), HasSubstr("image 1 has a value that is not finite"));
  EXPECT_THAT(refusal({1, -infinity}, false), HasSubstr("image 1 has a value that is not finite"));
  EXPECT_THAT(refusal({1, 2, 3}, true), HasSubstr("image 1 has 3 values, those before have 2"));
  EXPECT_THAT(refusal({}, true), HasSubstr("image 1 is empty"));
  EXPECT_THAT(refusal({0, 0}, true), HasSubstr("image 1 is zero"));
  EXPECT_THROW(DescriptorRetrieval(nullptr), ArgumentError);
}

TEST(StrangerScale, DoesNotDependOnTheUnitOfTheSimilarities) {
  Random random = test::seeded_random(3);
  for (const double factor : {1e-3, 1.0, 1e4})
    for (const double offset : {0.0, -30.0}) {
      StrangerScale unit, other;
      for (int i = 0; i < 400; ++i) {
        const double similarity = random.normal();
        unit.add(similarity);
        other.add(factor * similarity + offset);
      }
      std::vector<double> a = {-1, 0, 0.5, 4}, b;
      for (const double value : a) b.push_back(factor * value + offset);
      unit.standardize(a);
      other.standardize(b);
      // The floor of the deviation is a thousandth of the smallest one.
      for (std::size_t i = 0; i < a.size(); ++i)
        EXPECT_NEAR(b[i], a[i], 2e-3 * (1 + std::abs(a[i])));
    }
}

TEST(StrangerScale, StandardizesNormalValuesInSpiteOfFriendsAmongThem) {
  Random random = test::seeded_random(4);
  StrangerScale scale;
  for (int i = 0; i < 4000; ++i) scale.add(random.normal(5, 2));
  for (int i = 0; i < 200; ++i) scale.add(1000);
  std::vector<double> values = {5, 9, 1};
  scale.standardize(values);
  // A twentieth of friends moves the median by a sixteenth of a deviation.
  EXPECT_NEAR(values[0], 0, 0.15);
  EXPECT_NEAR(values[1], 2, 0.25);
  EXPECT_NEAR(values[2], -2, 0.25);
  std::vector<double> none = {1, 2};
  StrangerScale().standardize(none);
  EXPECT_THAT(none, ElementsAre(0, 0));
}

/// Places of blurred noise, each seen twice: images 0 to kPlaces - 1, and again under other noise.
constexpr int kPlaces = 30;
Image view_of_place(int image) {
  Image coarse(9, 12, CV_8UC3), view, noise(120, 160, CV_8UC3);
  cv::RNG(static_cast<std::uint64_t>(image % kPlaces) + 1).fill(coarse, cv::RNG::UNIFORM, 20, 200);
  cv::resize(coarse, view, {160, 120}, 0, 0, cv::INTER_CUBIC);
  cv::RNG(static_cast<std::uint64_t>(image) + 1000).fill(noise, cv::RNG::UNIFORM, 0, 40);
  view += noise;
  return view;
}

/// Number of second views whose place is found, of images that `shown` returns.
template <class Shown>
int right_answers(PlaceRetrieval& retrieval, const Shown& shown) {
  int right = 0;
  for (int i = 0; i < 2 * kPlaces; ++i) {
    retrieval.begin_frame(FrameId(i));
    const Image image = shown(i);
    if (i >= kPlaces) {
      const auto list = retrieval.query(image, 0, kPlaces - 1);
      EXPECT_TRUE(std::ranges::is_sorted(list, std::ranges::greater(), &PlaceSimilarity::score));
      right += !list.empty() && list.front().view == i - kPlaces;
    }
    retrieval.add(image);
  }
  return right;
}

TEST(CombinedRetrieval, EitherDecidesWhereTheOtherKnowsNothing) {
  Random random = test::seeded_random(11);
  PlaceRecognizerOptions options;
  options.cues = only_cues(options.cues, {"tiny", "gradients"});
  for (const double unit : {1e-2, 1.0, 1e3}) {
    SCOPED_TRACE(unit);
    const auto knows = std::make_shared<Listed>(), guesses = std::make_shared<Listed>();
    for (int i = 0; i < 2 * kPlaces; ++i) {
      guesses->of_frame.push_back(random_vector(random, 32, unit));
      if (i < kPlaces) {
        knows->of_frame.push_back(random_vector(random, 32, unit));
      } else {
        knows->of_frame.push_back(knows->of_frame[static_cast<std::size_t>(i - kPlaces)]);
        for (float& value : knows->of_frame.back())
          value += static_cast<float>(0.2 * unit * random.normal());
      }
    }
    const auto same = [](int) { return view_of_place(0); };
    CombinedRetrieval by_descriptor(knows, false, options), by_cues(guesses, false, options);
    EXPECT_EQ(right_answers(by_descriptor, same), kPlaces);
    EXPECT_GE(right_answers(by_cues, view_of_place), kPlaces - 1);
    // After it has forgotten all, it answers as before.
    by_descriptor.clear();
    EXPECT_EQ(right_answers(by_descriptor, view_of_place), kPlaces);
  }
}

TEST(CombinedRetrieval, TheSameImagesHaveTheSameScores) {
  PlaceRecognizerOptions options;
  options.cues = only_cues(options.cues, {"tiny", "colour", "corners"});
  const auto run = [&] {
    Random random(5);
    const auto describer = std::make_shared<Listed>();
    for (int i = 0; i < kPlaces; ++i) describer->of_frame.push_back(random_vector(random, 8));
    CombinedRetrieval retrieval(describer, true, options);
    std::vector<double> scores;
    for (int i = 0; i < kPlaces; ++i) {
      retrieval.begin_frame(FrameId(i));
      for (const PlaceSimilarity& each : retrieval.query(view_of_place(i), 0, i - 1))
        scores.push_back(each.score);
      retrieval.add(view_of_place(i));
    }
    return scores;
  };
  const std::vector<double> scores = run();
  EXPECT_EQ(scores.size(), static_cast<std::size_t>(kPlaces * (kPlaces - 1) / 2));
  EXPECT_EQ(run(), scores);
}

}  // namespace descriptor_retrieval_test
}  // namespace placegraph
