#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/json_file.h>
#include <placegraph/io/files/text_file.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace placegraph {

nlohmann::json read_json(const std::string& path) {
  require_input_file(path);
  std::ifstream stream(path);
  if (!stream) throw FileError(path, "cannot be opened for reading");
  try {
    return nlohmann::json::parse(stream);
  } catch (const nlohmann::json::parse_error& error) {
    throw FileError(path, "is not valid JSON, at byte " + std::to_string(error.byte));
  }
}

void take_json(const std::string& path, const std::string& command,
               const std::function<void(const nlohmann::json&)>& take) {
  const auto another = [&](const std::string& reason) {
    return FileError(path, "was not written by `placegraph " + command + "`: " + reason);
  };
  const nlohmann::json document = read_json(path);
  try {
    take(document);
  } catch (const nlohmann::json::exception& error) {
    const std::string text = error.what();  // begins with the name of the error in brackets
    const std::size_t bracket = text.find("] ");
    throw another(bracket == std::string::npos ? text : text.substr(bracket + 2));
  } catch (const ArgumentError& error) {
    throw another(error.what());
  }
}

nlohmann::json pose_json(const SE3& T) {
  const Eigen::Vector3d& t = T.translation();
  const Eigen::Quaterniond& q = T.rotation().quaternion();
  return {{"position_m", {t.x(), t.y(), t.z()}}, {"quaternion_xyzw", {q.x(), q.y(), q.z(), q.w()}}};
}

SE3 pose_of(const nlohmann::json& pose) {
  const auto t = pose.at("position_m").get<std::array<double, 3>>();
  const auto q = pose.at("quaternion_xyzw").get<std::array<double, 4>>();
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  require(std::abs(rotation.norm() - 1) < 1e-2, "quaternion_xyzw is not of unit length");
  return {SO3(rotation.normalized()), Eigen::Vector3d(t[0], t[1], t[2])};
}

}  // namespace placegraph
