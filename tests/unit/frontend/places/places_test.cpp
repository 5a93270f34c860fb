#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/frontend/places/place_database.h>
#include <placegraph/graph/core/error.h>

#include <set>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace places_test {

using namespace test;

/// What a place shows: features of its own, seen again with some bits wrong.
class Views {
 public:
  Views(int count, int features, Random& random)
      : random_(random), places_(static_cast<std::size_t>(count)) {
    for (auto& place : places_)
      for (int i = 0; i < features; ++i) place.push_back(random_descriptor(random));
  }
  std::vector<Feature> see(int place, int wrong_bits) {
    std::vector<Feature> features;
    for (const BinaryDescriptor& d : places_[static_cast<std::size_t>(place)]) {
      features.emplace_back();
      features.back().descriptor = flipped(d, wrong_bits, random_);
    }
    return features;
  }

 private:
  Random& random_;
  std::vector<std::vector<BinaryDescriptor>> places_;
};

bool any(KeyframeId) { return true; }

PlaceDatabaseOptions small_options() {
  PlaceDatabaseOptions options;
  options.vocabulary = {8, 3, 4};
  options.first_training = 10;
  return options;
}

TEST(Vocabulary, GivesSimilarDescriptorsOneWord) {
  Random random = seeded_random(81);
  std::vector<BinaryDescriptor> centres, sample;
  for (int c = 0; c < 20; ++c) {
    centres.push_back(random_descriptor(random));
    for (int i = 0; i < 12; ++i) sample.push_back(flipped(centres.back(), 8, random));
  }
  const Vocabulary vocabulary = Vocabulary::train(sample, {6, 2, 5}, random);
  EXPECT_FALSE(vocabulary.empty());
  EXPECT_GT(vocabulary.words(), 15);
  EXPECT_LE(vocabulary.words(), 36);
  int same = 0;
  std::set<std::uint32_t> words;
  for (const BinaryDescriptor& centre : centres) {
    const std::uint32_t word = vocabulary.word(centre);
    EXPECT_LT(word, static_cast<std::uint32_t>(vocabulary.words()));
    words.insert(word);
    for (int i = 0; i < 5; ++i) same += vocabulary.word(flipped(centre, 8, random)) == word;
  }
  EXPECT_GT(same, 75);  // of 100: a cluster that a split went through has two words
  EXPECT_GT(words.size(), 12u);
}

TEST(Vocabulary, IsTheSameForTheSameSeed) {
  Random numbers = seeded_random(82);
  std::vector<BinaryDescriptor> sample;
  for (int i = 0; i < 300; ++i) sample.push_back(random_descriptor(numbers));
  Random one(5), two(5);
  const Vocabulary a = Vocabulary::train(sample, {4, 3, 3}, one);
  const Vocabulary b = Vocabulary::train(sample, {4, 3, 3}, two);
  EXPECT_EQ(a.words(), b.words());
  for (const BinaryDescriptor& d : sample) EXPECT_EQ(a.word(d), b.word(d));
}

TEST(Vocabulary, HasOneWordWhereAllIsEqualAndNoneWithoutTraining) {
  Random random = seeded_random(83);
  const BinaryDescriptor d = random_descriptor(random);
  const Vocabulary vocabulary = Vocabulary::train({50, d}, {4, 3, 3}, random);
  EXPECT_EQ(vocabulary.words(), 1);
  EXPECT_EQ(vocabulary.word(random_descriptor(random)), 0u);
  EXPECT_THROW(Vocabulary::train({}, {}, random), ArgumentError);
  EXPECT_TRUE(Vocabulary().empty());
  EXPECT_THROW(Vocabulary().word(d), ArgumentError);
  VocabularyOptions options;
  options.branching = 1;
  EXPECT_THROW(Vocabulary::train({d}, options, random), ArgumentError);
}

TEST(PlaceDatabase, KnowsNothingBeforeItsFirstTraining) {
  Random random = seeded_random(84);
  Views views(10, 40, random);
  PlaceDatabase database(small_options(), 1);
  for (int i = 0; i < 9; ++i) database.add(KeyframeId(i), views.see(i, 0));
  EXPECT_EQ(database.size(), 9u);
  EXPECT_TRUE(database.query(views.see(3, 0), 5, any).empty());
  EXPECT_TRUE(database.describe(views.see(3, 0)).words.empty());
  EXPECT_EQ(database.similarity(views.see(3, 0), KeyframeId(3)), 0);
  database.add(KeyframeId(9), views.see(9, 0));
  EXPECT_EQ(database.query(views.see(3, 0), 5, any).front().id, KeyframeId(3));
}

TEST(PlaceDatabase, FindsTheSamePlaceAmongMany) {
  Random random = seeded_random(85);
  constexpr int kPlaces = 25;
  Views views(kPlaces, 60, random);
  PlaceDatabase database(small_options(), 1);
  for (int i = 0; i < kPlaces; ++i)
    database.add(KeyframeId(100 + i), views.see(i, 5));  // trains at 10 and 20
  for (int i = 0; i < kPlaces; ++i) {
    const auto again = views.see(i, 6);
    const auto candidates = database.query(again, 3, any);
    ASSERT_EQ(candidates.size(), 3u);
    EXPECT_EQ(candidates[0].id, KeyframeId(100 + i));
    EXPECT_GT(candidates[0].score, 1.2 * candidates[1].score);
    EXPECT_GE(candidates[1].score, candidates[2].score);
    EXPECT_LE(candidates[0].score, 1 + 1e-6);
    EXPECT_NEAR(database.similarity(again, KeyframeId(100 + i)), candidates[0].score, 1e-6);
    // Who is not allowed is not proposed.
    const auto others =
        database.query(again, 100, [&](KeyframeId id) { return id != KeyframeId(100 + i); });
    for (const PlaceCandidate& c : others) EXPECT_NE(c.id, KeyframeId(100 + i));
  }
  EXPECT_EQ(database.similarity(views.see(0, 0), KeyframeId(7)), 0);  // unknown
}

TEST(PlaceDatabase, DescribesAllViewsAnewWhenTheirNumberHasDoubled) {
  Random random = seeded_random(86);
  Views views(20, 40, random);
  PlaceDatabase database(small_options(), 1);
  for (int i = 0; i < 19; ++i) database.add(KeyframeId(i), views.see(i, 0));
  const auto seen = views.see(2, 0);
  const Appearance before = database.describe(seen);
  database.add(KeyframeId(19), views.see(19, 0));
  const Appearance after = database.describe(seen);
  EXPECT_NE(before.words, after.words);
  EXPECT_NEAR(database.similarity(seen, KeyframeId(2)), 1, 1e-5);
  double sum = 0;
  for (std::size_t i = 0; i < after.words.size(); ++i) {
    sum += after.words[i].second;
    if (i > 0) {
      EXPECT_LT(after.words[i - 1].first, after.words[i].first);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(PlaceDatabase, IsTheSameForTheSameSeed) {
  Random random = seeded_random(87);
  Views views(12, 40, random);
  PlaceDatabase a(small_options(), 9), b(small_options(), 9);
  for (int i = 0; i < 12; ++i) {
    const auto features = views.see(i, 3);
    a.add(KeyframeId(i), features);
    b.add(KeyframeId(i), features);
  }
  EXPECT_EQ(a.describe(views.see(1, 0)).words, b.describe(views.see(1, 0)).words);
}

TEST(PlaceDatabase, LivesWithViewsThatShowNothing) {
  PlaceDatabase database(small_options(), 1);
  for (int i = 0; i < 25; ++i) database.add(KeyframeId(i), {});
  EXPECT_TRUE(database.query({}, 5, any).empty());
  Random random = seeded_random(88);
  Views views(1, 40, random);
  EXPECT_TRUE(database.query(views.see(0, 0), 5, any).empty());
}

}  // namespace places_test
}  // namespace placegraph
