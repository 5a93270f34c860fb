#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/calibration_reader.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <cctype>

namespace placegraph {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

YAML::Node first_of(const YAML::Node& map, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (map[key].IsDefined()) return map[key];
  return YAML::Node(YAML::NodeType::Undefined);
}

void CalibrationReader::fail(const YAML::Node& at, const std::string& message) const {
  yaml_.fail(at, program_ + "'s calibration: " + message);
}

std::vector<double> CalibrationReader::numbers(const YAML::Node& node, const char* what) const {
  const YAML::Node list = node.IsMap() ? node["data"] : node;
  std::vector<double> values;
  if (list.IsDefined() && list.IsSequence())
    for (const YAML::Node& element : list) {
      if (element.IsSequence()) {
        for (const double value : numbers(element, what)) values.push_back(value);
        continue;
      }
      const auto value = yaml_number(element);
      if (!value) fail(element, std::string(what) + ": an element is not a number");
      values.push_back(*value);
    }
  if (values.empty() || values.size() > 64)
    fail(node, std::string(what) + ": is not a list of numbers");
  return values;
}

std::vector<double> CalibrationReader::numbers(const YAML::Node& node, const char* what,
                                               std::size_t count) const {
  std::vector<double> values = numbers(node, what);
  if (values.size() != count)
    fail(node, fmt::format("{}: expected {} numbers, found {}", what, count, values.size()));
  return values;
}

double CalibrationReader::number(const YAML::Node& map, const std::string& key) const {
  const YAML::Node node = map[key];
  if (!node.IsDefined()) fail(map, key + ": is missing");
  const auto value = yaml_number(node);
  if (!value) fail(node, key + ": is not a number");
  return *value;
}

double CalibrationReader::number_or_zero(const YAML::Node& map, const std::string& key) const {
  return map[key].IsDefined() ? number(map, key) : 0;
}

int CalibrationReader::side(double value, const YAML::Node& at) const {
  if (!(value >= 0 && value <= 20000)) fail(at, "the size is not one of 1 to 20000 px");
  return static_cast<int>(value);
}

void CalibrationReader::set_matrix(const YAML::Node& node, Camera& camera) const {
  const std::vector<double> K = numbers(node, "camera matrix");
  if (K.size() != 9) fail(node, fmt::format("a camera matrix has 9 numbers, not {}", K.size()));
  camera.fx = K[0], camera.cx = K[2], camera.fy = K[4], camera.cy = K[5];
}

void CalibrationReader::set_distortion(const std::string& model, const std::vector<double>& d,
                                       const YAML::Node& at, RawCamera& raw) const {
  const std::string name = lower(model);
  const bool nothing = std::all_of(d.begin(), d.end(), [](double k) { return k == 0; });
  if (name == "none" || d.empty() ||
      (nothing && name.find("equi") == name.npos && name != "fisheye"))
    return;
  if (name == "equidistant" || name == "equi" || name == "fisheye" || name == "kannalabrandt8" ||
      name == "kannala_brandt4") {
    if (d.size() != 4)
      fail(at, fmt::format("an equidistant lens has 4 coefficients, not {}", d.size()));
    raw.camera.distortion = Distortion::kEquidistant;
    std::copy(d.begin(), d.end(), raw.camera.coefficients.begin());
    return;
  }
  const bool known = name.empty() || name == "plumb_bob" || name == "radtan" ||
                     name == "radial-tangential" || name == "rational_polynomial" ||
                     name == "brown_conrady" || name == "pinhole";
  if (!known) fail(at, "the lens model " + in_quotes(model) + " is unknown: undistort the images");
  try {
    set_radial_tangential(d, raw);
  } catch (const ArgumentError& error) {
    fail(at, error.what());
  }
}

SE3 CalibrationReader::motion(const Eigen::Matrix3d& R, const Eigen::Vector3d& t,
                              const YAML::Node& at) const {
  try {
    return SE3(R, t);
  } catch (const ArgumentError& error) {
    fail(at, error.what());
  }
}

}  // namespace placegraph
