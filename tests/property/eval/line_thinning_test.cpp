#include <gtest/gtest.h>
#include <placegraph/eval/drawing/line_thinning.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace placegraph {
namespace line_thinning_test {

using Eigen::Vector2d;

const PixelArea kArea = {{-50, -50}, {1100, 900}};
constexpr double kRounding_px = 1e-6;

struct Shape {
  const char* name;
  std::function<Vector2d(double share, Random& random, const Vector2d& last)> point;
};

/// Points within kArea, which a line visits in the order of their shares from 0 to 1.
const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all = {
      {"circle",
       [](double share, Random&, const Vector2d&) {
         const double angle = 2 * std::numbers::pi * share;
         return Vector2d(500 + 300 * std::cos(angle), 400 + 300 * std::sin(angle));
       }},
      {"straight",
       [](double share, Random&, const Vector2d&) { return Vector2d(1000 * share, 700 * share); }},
      {"spiral of 40 rounds",
       [](double share, Random&, const Vector2d&) {
         const double angle = 80 * std::numbers::pi * share;
         return Vector2d(500 + 380 * share * std::cos(angle), 400 + 380 * share * std::sin(angle));
       }},
      {"there and back on one street",
       [](double share, Random& random, const Vector2d&) {
         return Vector2d(500 + 480 * std::sin(50 * share), 400 + random.uniform(-0.1, 0.1));
       }},
      {"random walk",
       [](double, Random& random, const Vector2d& last) {
         const Vector2d next = last + Vector2d(random.uniform(-3, 3), random.uniform(-3, 3));
         return Vector2d(next.cwiseMax(0).cwiseMin(Vector2d(1000, 800)));
       }},
      {"noise",
       [](double, Random& random, const Vector2d&) {
         return Vector2d(random.uniform(0, 1000), random.uniform(0, 800));
       }},
      {"noise over x",
       [](double share, Random& random, const Vector2d&) {
         return Vector2d(1000 * share, random.uniform(300, 500));
       }},
      {"standing still", [](double, Random&, const Vector2d&) { return Vector2d(500.3, 400.7); }},
      {"standing at four corners", [](double share, Random&, const Vector2d&) {
         return Vector2d(share < 0.5 ? 100 : 800, std::fmod(4 * share, 2) < 1 ? 100 : 600);
       }}};
  return all;
}

PixelLine line_of(const Shape& shape, std::size_t count, Random& random) {
  PixelLine line;
  Vector2d last(500, 400);
  for (std::size_t i = 0; i < count; ++i) {
    last = shape.point(static_cast<double>(i) / static_cast<double>(count), random, last);
    line.points.emplace_back(last);
  }
  return line;
}

std::size_t index_of(const PixelLine& line, Random& random) {
  return static_cast<std::size_t>(random.index(static_cast<int>(line.points.size()) - 1));
}

double distance(const Vector2d& p, const std::vector<ThinnedLine>& lines) {
  double least = std::numeric_limits<double>::infinity();
  for (const ThinnedLine& line : lines)
    for (const auto& stretch : line.stretches)
      for (std::size_t i = 1; i < stretch.size(); ++i) {
        const Vector2d along = stretch[i] - stretch[i - 1], from = p - stretch[i - 1];
        const double square = along.squaredNorm(),
                     share = square > 0 ? std::clamp(from.dot(along) / square, 0.0, 1.0) : 0;
        least = std::min(least, (from - share * along).squaredNorm());
      }
  return std::sqrt(least);
}

std::size_t points_of(const std::vector<ThinnedLine>& lines) {
  std::size_t count = 0;
  for (const ThinnedLine& line : lines)
    for (const auto& stretch : line.stretches) count += stretch.size();
  return count;
}

std::vector<ThinnedLine> thinned(const PixelLine& line, double tolerance_px) {
  return thin_line(line, tolerance_px, kArea).value();
}

/// The points of the line lie within the tolerance; of many, some hundred are looked at.
void expect_near(const PixelLine& line, const std::vector<ThinnedLine>& drawn,
                 double tolerance_px) {
  const std::size_t every = 1 + line.points.size() * points_of(drawn) / 4'000'000;
  for (std::size_t i = 0; i < line.points.size(); i += every)
    if (line.points[i]) {
      ASSERT_LE(distance(*line.points[i], drawn), tolerance_px + kRounding_px) << "point " << i;
    }
}

/// Both ends of every segment are points of one run of the line, in their order.
void expect_segments_of_runs(const PixelLine& line, const ThinnedLine& drawn) {
  std::size_t at = 0;
  for (const auto& stretch : drawn.stretches) {
    // A point that stands alone is a short stroke.
    if (stretch.size() == 2 && stretch[1] == stretch[0] + Vector2d(0.5, 0)) continue;
    std::size_t before = line.points.size();
    for (const Vector2d& p : stretch) {
      // A new stretch may begin at the point where the last one ended.
      while (at < line.points.size() && line.points[at] != p) ++at;
      ASSERT_LT(at, line.points.size()) << p.transpose() << " is no later point of the line";
      for (std::size_t i = before; i < at; ++i) ASSERT_TRUE(line.points[i]) << "over a gap";
      before = at;
    }
  }
}

class EveryShape : public ::testing::TestWithParam<std::size_t> {
 protected:
  const Shape& shape() const { return shapes()[GetParam()]; }
};

TEST_P(EveryShape, HasNoPointOffTheDrawnLine) {
  Random random(21, GetParam());
  for (const std::size_t count : {1u, 2u, 3u, 10u, 100u, 1000u, 20'000u, 200'000u})
    for (const double tolerance_px : {0.5, 4.0, 30.0}) {
      // Stretches that cross the picture take long with small cells.
      const bool slow = count > 7000 * tolerance_px && shape().name == std::string("noise");
      if (slow) continue;
      SCOPED_TRACE(testing::Message()
                   << shape().name << ", " << count << " points, " << tolerance_px << " px");
      const PixelLine line = line_of(shape(), count, random);
      const auto drawn = thinned(line, tolerance_px);
      ASSERT_EQ(drawn.size(), 1u);
      expect_near(line, drawn, tolerance_px);
      EXPECT_LE(points_of(drawn), 2 * count);
    }
}

TEST_P(EveryShape, KeepsOutliersAndGapsAndTheOrder) {
  Random random(22, GetParam());
  for (int trial = 0; trial < 20; ++trial) {
    SCOPED_TRACE(testing::Message() << shape().name << ", trial " << trial);
    PixelLine line = line_of(shape(), 50 + static_cast<std::size_t>(random.index(3000)), random);
    const auto outlier = index_of(line, random);
    for (int gap = 0; gap < 3; ++gap) {
      const std::size_t begin = index_of(line, random);
      for (std::size_t i = begin; i < std::min(begin + 20, line.points.size()); ++i)
        line.points[i] = gap == 0 ? std::optional(Vector2d(NAN, 3)) : std::nullopt;
    }
    line.points[outlier] = Vector2d(-40, 830);
    const double tolerance_px = random.uniform(0.1, 20);
    const auto drawn = thinned(line, tolerance_px);
    EXPECT_LE(distance(*line.points[outlier], drawn), tolerance_px + kRounding_px);
    for (auto& p : line.points)
      if (p && !p->allFinite()) p.reset();
    expect_near(line, drawn, tolerance_px);
    const bool unique = GetParam() < 7;  // else points before and after a gap are the same
    if (unique) expect_segments_of_runs(line, drawn.at(0));
  }
}

TEST_P(EveryShape, FitsIntoFewPointsWithALargeTolerance) {
  Random random(23, GetParam());
  const PixelLine line = line_of(shape(), 100'000, random);
  constexpr std::size_t kMost = 800;
  std::size_t fitting = 0;
  for (double tolerance_px = 0.5; tolerance_px < 3000; tolerance_px *= 4) {
    const auto drawn = thin_line(line, tolerance_px, kArea, kMost);
    if (!drawn) continue;
    ++fitting;
    EXPECT_LE(points_of(*drawn), kMost);
    EXPECT_EQ(points_of(*drawn), points_of(thinned(line, tolerance_px)));
  }
  EXPECT_GE(fitting, 2u) << shape().name;
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, ::testing::Range<std::size_t>(0, shapes().size()));

TEST(ThinLine, DrawsAsManyPointsOfASmoothLineWhateverTheirNumber) {
  Random random(24);
  for (const std::size_t shape : {0u, 1u, 2u})
    EXPECT_LE(points_of(thinned(line_of(shapes()[shape], 200'000, random), 0.5)),
              points_of(thinned(line_of(shapes()[shape], 20'000, random), 0.5)) * 11 / 10 + 2);
}

TEST(ThinLine, KeepsTheExtremesOfEveryColumn) {
  Random random(25);
  PixelLine line = line_of(shapes()[6], 100'000, random);
  line.points[70'000]->y() = 20;
  const auto drawn = thinned(line, 1);
  EXPECT_LE(points_of(drawn), 2u * 5 * 1001);  // columns of a fifth of a pixel
  EXPECT_LE(distance(*line.points[70'000], drawn), 0.2 + kRounding_px);
}

TEST(ThinLine, ShowsTheHighestLevelOfPointsThatFallTogether) {
  Random random(26);
  for (int trial = 0; trial < 20; ++trial) {
    PixelLine line = line_of(shapes()[0], 5000, random);
    line.levels.assign(5001, 0);
    line.points.push_back(line.points.front());
    for (int& level : line.levels) level = random.index(3);
    const std::size_t worst = index_of(line, random);
    line.levels[worst] = 24;
    const auto drawn = thinned(line, 2);
    ASSERT_EQ(drawn.back().level, 24);
    EXPECT_LE(distance(*line.points[worst], {drawn.back()}), 2 + kRounding_px);
    EXPECT_TRUE(std::ranges::is_sorted(drawn, {}, &ThinnedLine::level));
    expect_near(line, drawn, 2);
  }
}

TEST(ThinLine, DrawsLinksThatFallTogetherOnceAndEveryOtherOne) {
  PixelLine line;
  Random random(27);
  const auto add = [&](const Vector2d& a, const Vector2d& b) {
    line.points.emplace_back(a);
    line.points.emplace_back(b);
    line.points.emplace_back();
  };
  for (int i = 0; i < 50'000; ++i)
    add({random.uniform(100, 101), 100}, {random.uniform(600, 601), 500});
  add({0, 700}, {900, 10});
  const auto drawn = thinned(line, 2);
  EXPECT_LE(points_of(drawn), 20u);
  expect_near(line, drawn, 2);
  EXPECT_EQ(drawn.at(0).stretches.back(), (std::vector<Vector2d>{{0, 700}, {900, 10}}));
}

TEST(ThinLine, LeavesOutWhatLiesOutsideTheArea) {
  const PixelLine line = {{Vector2d(-900, 0), Vector2d(-100, 40), std::nullopt, Vector2d(0, 0),
                           Vector2d(1e12, 0), std::nullopt, Vector2d(0, -1e300)},
                          {}};
  const auto drawn = thinned(line, 1);
  ASSERT_EQ(points_of(drawn), 2u);
  EXPECT_EQ(drawn[0].stretches[0][1], Vector2d(1e12, 0));
  EXPECT_TRUE(thinned({}, 1).empty());
  EXPECT_THROW(thin_line(line, 0, kArea), ArgumentError);
}

TEST(ThinPoints, KeepsAPointNearEveryOther) {
  Random random(28);
  for (const double tolerance_px : {0.5, 7.0, 60.0}) {
    std::vector<Vector2d> points = {{NAN, 4}, {-30, 900}};
    for (int i = 0; i < 4000; ++i)
      points.emplace_back(random.uniform(0, 300), random.uniform(0, 200));
    const std::vector<Vector2d> kept = thin_points(points, tolerance_px);
    EXPECT_EQ(kept.front(), points[1]);
    for (const Vector2d& p : points)
      EXPECT_TRUE(!p.allFinite() || std::ranges::any_of(kept, [&](const Vector2d& q) {
        return (p - q).norm() <= tolerance_px;
      }));
    EXPECT_LE(kept.size(), 2 + 2 * 3 * (2 + 300 / tolerance_px) * (2 + 200 / tolerance_px));
  }
}

}  // namespace line_thinning_test
}  // namespace placegraph
