#pragma once
// Inside io only.
#include <placegraph/io/calibration/raw_camera.h>
#include <placegraph/io/config/yaml_document.h>

#include <initializer_list>
#include <string>

namespace placegraph {

/// Reads the keys of another program's calibration, with errors (FileError) that name file, line
/// and program.
class CalibrationReader {
 public:
  CalibrationReader(const YamlDocument& yaml, std::string program)
      : yaml_(yaml), program_(std::move(program)) {}

  [[noreturn]] void fail(const YAML::Node& at, const std::string& message) const;

  /// A list of numbers, a matrix with `data`, or a list of rows.
  std::vector<double> numbers(const YAML::Node& node, const char* what) const;
  /// The same with exactly `count` numbers.
  std::vector<double> numbers(const YAML::Node& node, const char* what, std::size_t count) const;
  double number(const YAML::Node& map, const std::string& key) const;
  double number_or_zero(const YAML::Node& map, const std::string& key) const;
  /// A width or height; 0 means none.
  int side(double value, const YAML::Node& at) const;
  /// Focal lengths and principal point from a 3x3 matrix.
  void set_matrix(const YAML::Node& node, Camera& camera) const;
  /// `model` is the name in any of the programs; empty: radial-tangential.
  void set_distortion(const std::string& model, const std::vector<double>& d, const YAML::Node& at,
                      RawCamera& raw) const;
  /// A rigid motion; an error at `at` if R is not a rotation.
  SE3 motion(const Eigen::Matrix3d& R, const Eigen::Vector3d& t, const YAML::Node& at) const;

 private:
  const YamlDocument& yaml_;
  std::string program_;
};

/// The value of the first of these keys that exists; undefined if there is none.
YAML::Node first_of(const YAML::Node& map, std::initializer_list<const char*> keys);

std::string lower(std::string text);

}  // namespace placegraph
