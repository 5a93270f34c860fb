#include "apps/flight/flight.h"

#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace flight_test {

using test::message_of;
using testing::HasSubstr;

ImuNoise some_noise() {
  ImuNoise noise;
  noise.gyro = 0.001, noise.accel = 0.02;
  noise.gyro_bias_walk = 1e-5, noise.accel_bias_walk = 1e-4;
  return noise;
}

TEST(ParseSpan, TakesTwoTimesInOrder) {
  const TimeSpan span = parse_span("1.5:20");
  EXPECT_EQ(span.from_s, 1.5);
  EXPECT_EQ(span.to_s, 20);
  for (const char* wrong : {"", "3", "3:", ":3", "3:2", "3:3", "a:4", "1:2x", "1x:2", "1:2:3"})
    EXPECT_THAT(message_of<ArgumentError>([&] { parse_span(wrong); }),
                HasSubstr("--blind: '" + std::string(wrong) + "' is not of the form FROM:TO"));
}

TEST(FlightOptionsOfArguments, TakeTheNoiseOfTheSensorUnlessAnotherIsSet) {
  const ImuNoise noise = some_noise();
  FlightArguments arguments;
  EXPECT_EQ(flight_options(arguments, noise).flight.filter.gyro_noise, 0.001);
  arguments.settings = {"filter.gyro_noise=0.004"};
  const FlightRunOptions options = flight_options(arguments, noise);
  EXPECT_EQ(options.flight.filter.gyro_noise, 0.004);
  EXPECT_EQ(options.flight.filter.accel_noise, 0.02);
}

TEST(FlightOptionsOfArguments, KnowWhenMarkersAreNotLookedFor) {
  FlightArguments arguments;
  arguments.blind = {"1:2", "5:6"};
  arguments.markers_until_s = 9;
  arguments.predict_ahead_ms = 20;
  const FlightRunOptions options = flight_options(arguments, some_noise());
  ASSERT_EQ(options.blind.size(), 3u);
  EXPECT_EQ(options.blind[1].from_s, 5);
  EXPECT_EQ(options.blind[2].from_s, 9);
  EXPECT_GT(options.blind[2].to_s, 1e9);
  EXPECT_NEAR(options.predict_ahead_s, 0.02, 1e-12);
  arguments.no_markers = true;
  ASSERT_EQ(flight_options(arguments, some_noise()).blind.size(), 1u);
  EXPECT_LT(flight_options(arguments, some_noise()).blind[0].from_s, -1e9);
}

TEST(FlightOptionsOfArguments, RefuseWhatDoesNotGoTogether) {
  const auto message = [](const FlightArguments& arguments) {
    return message_of<ArgumentError>([&] { flight_options(arguments, some_noise()); });
  };
  FlightArguments arguments;
  arguments.smooth = true;
  arguments.predict_ahead_ms = 10;
  EXPECT_THAT(message(arguments), HasSubstr("--smooth: predicted states cannot be smoothed"));
  arguments = {};
  arguments.predict_ahead_ms = 1e6;
  EXPECT_THAT(message(arguments), HasSubstr("--predict-ahead-ms: 1000000 is not within 0 and "));
  arguments = {};
  arguments.markers_until_s = 0;
  EXPECT_THAT(message(arguments), HasSubstr("--markers-until: must be positive"));
}

TEST(OpenFlight, RefusesAFolderOfAnotherLayout) {
  const test::TemporaryFolder folder;
  FlightArguments arguments;
  arguments.flight = folder.path();
  EXPECT_THAT(message_of<ArgumentError>([&] { open_flight(arguments); }),
              HasSubstr("is no folder with mav0/cam0/data.csv"));
}

}  // namespace flight_test
}  // namespace placegraph::apps
