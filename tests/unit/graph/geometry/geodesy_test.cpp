#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/geodesy.h>

#include <limits>

namespace placegraph {
namespace geodesy_test {

constexpr double kA = 6378137.0, kB = 6356752.314245179;  // axes of WGS84 [m]

TEST(EnuFrame, PutsTheOriginAtZeroAndHeightUp) {
  const EnuFrame enu({48.98, 8.39, 116});
  EXPECT_LT(enu.to_enu({48.98, 8.39, 116}).norm(), 1e-9);
  EXPECT_TRUE(enu.to_enu({48.98, 8.39, 216}).isApprox(Eigen::Vector3d(0, 0, 100), 1e-9));
}

TEST(EnuFrame, SeesTheAxesOfTheEllipsoidFromTheEquator) {
  const EnuFrame enu({0, 0, 0});
  EXPECT_TRUE(enu.to_enu({0, 90, 0}).isApprox(Eigen::Vector3d(kA, 0, -kA), 1e-12));
  EXPECT_TRUE(enu.to_enu({90, 0, 0}).isApprox(Eigen::Vector3d(0, kB, -kA), 1e-12));
}

TEST(EnuFrame, MeasuresASmallStepNorthByTheMeridiansCurvature) {
  // Radius of the meridian at latitude 49 deg: a (1 - e^2) / (1 - e^2 sin^2 49)^1.5 = 6371.849 km.
  const EnuFrame enu({49, 8, 0});
  const Eigen::Vector3d step = enu.to_enu({49.001, 8, 0});
  EXPECT_NEAR(step.y(), deg_to_rad(6371848.6 * 0.001), 1e-3);
  EXPECT_NEAR(step.x(), 0, 1e-9);
  EXPECT_NEAR(step.z(), -step.y() * step.y() / (2 * 6371848.6), 1e-5);
}

TEST(EnuFrame, ComesBackFromThereToADifferenceOfNanometres) {
  const EnuFrame enu({-33.9, 179.999, 20});
  for (const GeodeticPosition p : {GeodeticPosition{-33.8, -179.99, 500}, {-34, 179.5, -30}}) {
    const GeodeticPosition back = enu.to_geodetic(enu.to_enu(p));
    EXPECT_NEAR(back.latitude_deg, p.latitude_deg, 1e-13 * 180);
    EXPECT_NEAR(back.longitude_deg, p.longitude_deg, 1e-13 * 360);
    EXPECT_NEAR(back.height_m, p.height_m, 1e-7);
  }
}

TEST(EnuFrame, RefusesWhatIsNoPosition) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(EnuFrame({91, 0, 0}), ArgumentError);
  EXPECT_THROW(EnuFrame({0, nan, 0}), ArgumentError);
  EXPECT_THROW(EnuFrame({0, 0, 0}).to_enu({0, 0, nan}), ArgumentError);
  EXPECT_THROW(EnuFrame({0, 0, 0}).to_enu({nan, 0, 0}), ArgumentError);
  EXPECT_THROW(EnuFrame({0, 0, 0}).to_enu({0, 600, 0}), ArgumentError);
  EXPECT_THROW(EnuFrame({0, 0, 1e308}), ArgumentError);
  EXPECT_THROW(EnuFrame({0, 540, 0}), ArgumentError);
}

}  // namespace geodesy_test
}  // namespace placegraph
