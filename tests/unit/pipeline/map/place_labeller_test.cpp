#include <gtest/gtest.h>
#include <placegraph/frontend/places/classifiers/place_classifier.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/pipeline/map/place_labeller.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace place_labeller_test {

/// A view of room 0 (red, wide stripes) or 1 (green, narrow ones), a little different every time.
Image view_of(int room, Random& random) {
  Image image(120, 160, CV_8UC3);
  const int period = room == 0 ? 40 : 10, at = static_cast<int>(random.index(8));
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const int stripe = (x + at) / period % 2 == 0 ? 60 : 0;
      const int noise = static_cast<int>(random.index(20));
      image.at<cv::Vec3b>(y, x) = room == 0 ? cv::Vec3b(30, 40, 120 + stripe + noise)
                                            : cv::Vec3b(30, 120 + stripe + noise, 40);
    }
  return image;
}

PlaceClassifier two_rooms(Random& random) {
  std::vector<PlaceCueVectors> views;
  std::vector<int> labels;
  for (int visit = 0; visit < 2; ++visit)
    for (int room = 0; room < 2; ++room)
      for (int i = 0; i < 10; ++i) {
        views.push_back(describe_for_classes(view_of(room, random)));
        labels.push_back(room);
      }
  return PlaceClassifier::train(std::move(views), labels, PlaceClassifierOptions());
}

/// Three places: views of room 0, of room 1, and none.
Map three_places() {
  Map map;
  for (int i = 0; i < 3; ++i) {
    Place place;
    place.id = PlaceId(10 * i);
    map.place_graph.places.push_back(place);
  }
  for (int i = 0; i < 8; ++i) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(i);
    keyframe.place = PlaceId(i < 5 ? 0 : 10);
    map.keyframes.push_back(keyframe);
  }
  return map;
}

TEST(PlaceLabeller, GivesEachPlaceWhatItsViewsSay) {
  Random random(3);
  const PlaceClassifier classifier = two_rooms(random);
  const auto labels = label_places(three_places(), classifier, [&](const Keyframe& keyframe) {
    return view_of(keyframe.place == PlaceId(0) ? 0 : 1, random);
  });
  ASSERT_EQ(labels.size(), 3u);
  EXPECT_EQ(labels[0].place, PlaceId(0));
  EXPECT_EQ(labels[0].label, 0);
  EXPECT_EQ(labels[0].views, 5);
  EXPECT_GT(labels[0].probability, 0.8);
  EXPECT_EQ(labels[1].place, PlaceId(10));
  EXPECT_EQ(labels[1].label, 1);
  EXPECT_EQ(labels[2].label, std::nullopt);  // without views
  EXPECT_EQ(labels[2].views, 0);
}

TEST(PlaceLabeller, LeavesAPlaceOfTwoMindsWithoutLabel) {
  Random random(3);
  const PlaceClassifier classifier = two_rooms(random);
  PlaceLabelOptions options;
  options.min_probability = 0.7;
  int view = 0;
  const auto labels = label_places(
      three_places(), classifier, [&](const Keyframe&) { return view_of(view++ % 2, random); },
      options);
  EXPECT_EQ(labels[0].label, std::nullopt);  // three views against two
  EXPECT_LT(labels[0].probability, 0.7);
}

}  // namespace place_labeller_test
}  // namespace placegraph
