#include <fmt/format.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/ids.h>
#include <placegraph/graph/text/id_format.h>

#include <concepts>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace placegraph {
namespace id_test {

using CatId = Id<struct CatTag>;
using DogId = Id<struct DogTag>;

// An id costs what its number costs.
static_assert(sizeof(CatId) == sizeof(std::int64_t));
static_assert(alignof(CatId) == alignof(std::int64_t));
static_assert(std::is_trivially_copyable_v<CatId>);
static_assert(std::is_standard_layout_v<CatId>);

// A number becomes an id, and an id a number, only where that is said.
static_assert(std::is_constructible_v<CatId, int>);
static_assert(std::is_constructible_v<CatId, std::size_t>);
static_assert(!std::is_constructible_v<CatId, double>);
static_assert(!std::is_constructible_v<CatId, bool>);
static_assert(!std::is_convertible_v<int, CatId>);
static_assert(!std::is_assignable_v<CatId&, int>);
static_assert(!std::is_convertible_v<CatId, std::int64_t>);
static_assert(!std::is_constructible_v<std::int64_t, CatId>);
static_assert(!std::is_constructible_v<bool, CatId>);

// Ids of two kinds have nothing to do with each other.
static_assert(!std::is_constructible_v<CatId, DogId>);
static_assert(!std::is_assignable_v<CatId&, DogId>);
static_assert(!std::equality_comparable_with<CatId, DogId>);
static_assert(!std::equality_comparable_with<CatId, int>);
static_assert(std::totally_ordered<CatId>);

template <class A, class B>
concept CanBeAdded = requires(A a, B b) { a + b; };
static_assert(!CanBeAdded<CatId, int> && !CanBeAdded<CatId, CatId>);

constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

TEST(Id, IsTheNumberItWasMadeOf) {
  static_assert(CatId(7).value() == 7);
  EXPECT_EQ(CatId().value(), 0);
  EXPECT_EQ(CatId(std::size_t{5}).value(), 5);
  for (const std::int64_t number : {kMin, std::int64_t{-1}, std::int64_t{0}, kMax})
    EXPECT_EQ(CatId(number).value(), number);
  EXPECT_EQ(CatId::lowest().value(), kMin);
  EXPECT_EQ(CatId::highest().value(), kMax);
}

TEST(Id, ComparesByItsNumber) {
  EXPECT_EQ(CatId(3), CatId(3));
  EXPECT_NE(CatId(3), CatId(4));
  EXPECT_LT(CatId(-1), CatId(0));
  EXPECT_GT(CatId::highest(), CatId(4));
  EXPECT_LE(CatId::lowest(), CatId(kMin));
  const std::set<CatId> ordered{CatId(10), CatId(9), CatId(-2)};
  EXPECT_EQ(std::vector<CatId>(ordered.begin(), ordered.end()),
            (std::vector<CatId>{CatId(-2), CatId(9), CatId(10)}));
  EXPECT_LT(std::optional<CatId>(), CatId(-5));
}

TEST(Id, CountsUp) {
  CatId next(41);
  EXPECT_EQ(next++, CatId(41));
  EXPECT_EQ(++next, CatId(43));
  EXPECT_EQ(next, CatId(43));
}

TEST(Id, IsHashedAsItsNumber) {
  for (const std::int64_t number : {std::int64_t{0}, std::int64_t{12}, kMax})
    EXPECT_EQ(std::hash<CatId>()(CatId(number)), std::hash<std::int64_t>()(number));
  const std::unordered_map<CatId, int> lives{{CatId(1), 9}, {CatId(2), 7}};
  EXPECT_EQ(lives.at(CatId(2)), 7);
  EXPECT_FALSE(lives.contains(CatId(3)));
}

TEST(Id, IsWrittenAsItsNumber) {
  std::ostringstream stream;
  stream << CatId(-12);
  EXPECT_EQ(stream.str(), "-12");
  EXPECT_EQ(to_string(CatId(kMax)), std::to_string(kMax));
  EXPECT_EQ(fmt::format("cat {} of {}", CatId(3), DogId(4)), "cat 3 of 4");
}

TEST(Id, IsANumberInJson) {
  const nlohmann::json json = {{"cat", CatId(3)}, {"cats", std::vector<CatId>{CatId(1), CatId(2)}}};
  EXPECT_EQ(json.dump(), R"({"cat":3,"cats":[1,2]})");
  EXPECT_TRUE(json["cat"].is_number_integer());
  EXPECT_EQ(json["cat"].get<CatId>(), CatId(3));
  EXPECT_EQ(json["cats"].get<std::vector<CatId>>(), (std::vector<CatId>{CatId(1), CatId(2)}));
  EXPECT_THROW((void)nlohmann::json("three").get<CatId>(), nlohmann::json::exception);
}

}  // namespace id_test
}  // namespace placegraph
