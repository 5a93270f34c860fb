#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/frontend/markers/marker_dictionary.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/aruco.hpp>
#include <utility>

namespace placegraph {
namespace {

namespace aruco = cv::aruco;

const std::vector<std::pair<const char*, aruco::PREDEFINED_DICTIONARY_NAME>>& families() {
  static const std::vector<std::pair<const char*, aruco::PREDEFINED_DICTIONARY_NAME>> all = {
      {"aruco_4x4_50", aruco::DICT_4X4_50},
      {"aruco_4x4_100", aruco::DICT_4X4_100},
      {"aruco_4x4_250", aruco::DICT_4X4_250},
      {"aruco_4x4_1000", aruco::DICT_4X4_1000},
      {"aruco_5x5_50", aruco::DICT_5X5_50},
      {"aruco_5x5_100", aruco::DICT_5X5_100},
      {"aruco_5x5_250", aruco::DICT_5X5_250},
      {"aruco_5x5_1000", aruco::DICT_5X5_1000},
      {"aruco_6x6_50", aruco::DICT_6X6_50},
      {"aruco_6x6_100", aruco::DICT_6X6_100},
      {"aruco_6x6_250", aruco::DICT_6X6_250},
      {"aruco_6x6_1000", aruco::DICT_6X6_1000},
      {"aruco_7x7_50", aruco::DICT_7X7_50},
      {"aruco_7x7_100", aruco::DICT_7X7_100},
      {"aruco_7x7_250", aruco::DICT_7X7_250},
      {"aruco_7x7_1000", aruco::DICT_7X7_1000},
      {"aruco_original", aruco::DICT_ARUCO_ORIGINAL},
      {"apriltag_16h5", aruco::DICT_APRILTAG_16h5},
      {"apriltag_25h9", aruco::DICT_APRILTAG_25h9},
      {"apriltag_36h10", aruco::DICT_APRILTAG_36h10},
      {"apriltag_36h11", aruco::DICT_APRILTAG_36h11}};
  return all;
}

}  // namespace

std::vector<std::string> marker_dictionaries() {
  std::vector<std::string> names;
  for (const auto& family : families()) names.emplace_back(family.first);
  return names;
}

MarkerFamily marker_family(const std::string& dictionary) {
  std::string known;
  for (const auto& [name, family] : families()) {
    if (dictionary == name) {
      const auto found = aruco::getPredefinedDictionary(family);
      return {found->bytesList, found->markerSize, found->maxCorrectionBits};
    }
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw ArgumentError("no marker dictionary '" + dictionary + "' (known: " + known + ")");
}

}  // namespace placegraph
