#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/calibration/foreign_calibration.h>
#include <placegraph/io/config/yaml_document.h>
#include <placegraph/io/files/text_file.h>

#include <algorithm>
#include <cctype>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

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

/// Reads the keys of one file, with errors that name file and line.
class Reader {
 public:
  Reader(const YamlDocument& yaml, std::string program)
      : yaml_(yaml), program_(std::move(program)) {}

  [[noreturn]] void fail(const YAML::Node& at, const std::string& message) const {
    yaml_.fail(at, program_ + "'s calibration: " + message);
  }

  /// A list of numbers, a matrix with `data`, or a list of rows.
  std::vector<double> numbers(const YAML::Node& node, const char* what) const {
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
      fail(node, std::string(what) + ": is no list of numbers");
    return values;
  }

  double number(const YAML::Node& map, const std::string& key) const {
    const YAML::Node node = map[key];
    if (!node.IsDefined()) fail(map, key + ": is missing");
    const auto value = yaml_number(node);
    if (!value) fail(node, key + ": is not a number");
    return *value;
  }
  double number_or_zero(const YAML::Node& map, const std::string& key) const {
    return map[key].IsDefined() ? number(map, key) : 0;
  }

  int side(double value, const YAML::Node& at) const {
    if (!(value >= 0 && value <= 20000)) fail(at, "the size is not one of 1 to 20000 px");
    return static_cast<int>(value);
  }

  void set_matrix(const YAML::Node& node, Camera& camera) const {
    const std::vector<double> K = numbers(node, "camera matrix");
    if (K.size() != 9) fail(node, fmt::format("a camera matrix has 9 numbers, not {}", K.size()));
    camera.fx = K[0], camera.cx = K[2], camera.fy = K[4], camera.cy = K[5];
  }

  void set_distortion(const std::string& model, const std::vector<double>& d, const YAML::Node& at,
                      Camera& camera) const {
    const std::string name = lower(model);
    const bool nothing = std::all_of(d.begin(), d.end(), [](double k) { return k == 0; });
    if (name == "none" || d.empty() ||
        (nothing && name.find("equi") == name.npos && name != "fisheye"))
      return;
    if (name == "equidistant" || name == "equi" || name == "fisheye" || name == "kannalabrandt8" ||
        name == "kannala_brandt4") {
      if (d.size() != 4)
        fail(at, fmt::format("an equidistant lens has 4 coefficients, not {}", d.size()));
      camera.distortion = Distortion::kEquidistant;
      std::copy(d.begin(), d.end(), camera.coefficients.begin());
      return;
    }
    const bool known = name.empty() || name == "plumb_bob" || name == "radtan" ||
                       name == "radial-tangential" || name == "rational_polynomial" ||
                       name == "brown_conrady" || name == "pinhole";
    if (!known)
      fail(at, "the lens model " + in_quotes(model) + " is not known: undistort the images");
    try {
      set_radial_tangential(d, camera);
    } catch (const ArgumentError& error) {
      fail(at, error.what());
    }
  }

 private:
  const YamlDocument& yaml_;
  std::string program_;
};

ForeignCalibration read_opencv(const YamlDocument& yaml, const YAML::Node& matrix) {
  const YAML::Node& root = yaml.root();
  ForeignCalibration result;
  result.program = root["distortion_model"].IsDefined() ? "ROS" : "OpenCV";
  const Reader reader(yaml, result.program);
  Camera& camera = result.camera;
  reader.set_matrix(matrix, camera);
  for (const char* key : {"image_width", "width", "imageWidth", "Image_Width"})
    if (root[key].IsDefined()) camera.width = reader.side(reader.number(root, key), root[key]);
  for (const char* key : {"image_height", "height", "imageHeight", "Image_Height"})
    if (root[key].IsDefined()) camera.height = reader.side(reader.number(root, key), root[key]);
  const YAML::Node d = first_of(root, {"distortion_coefficients", "Distortion_Coefficients",
                                       "distCoeffs", "dist_coeffs", "distortion_coeffs", "D", "d"});
  const YAML::Node model = first_of(root, {"distortion_model"});
  if (d.IsDefined() && !d.IsNull())
    reader.set_distortion(model.IsDefined() ? model.Scalar() : "",
                          reader.numbers(d, "distortion coefficients"), d, camera);
  return result;
}

ForeignCalibration read_kalibr(const YamlDocument& yaml) {
  const YAML::Node cam0 = yaml.root()["cam0"];
  const Reader reader(yaml, "Kalibr");
  ForeignCalibration result;
  result.program = "Kalibr";
  const std::string model = cam0["camera_model"].IsDefined() ? cam0["camera_model"].Scalar() : "";
  if (model != "pinhole")
    reader.fail(cam0, "camera_model: " + in_quotes(model) + " is not known, only pinhole is");
  if (!cam0["intrinsics"].IsDefined()) reader.fail(cam0, "intrinsics: is missing");
  const std::vector<double> k = reader.numbers(cam0["intrinsics"], "intrinsics");
  if (k.size() != 4)
    reader.fail(cam0["intrinsics"], fmt::format("intrinsics: expected 4, found {}", k.size()));
  Camera& camera = result.camera;
  camera.fx = k[0], camera.fy = k[1], camera.cx = k[2], camera.cy = k[3];
  if (cam0["resolution"].IsDefined()) {
    const std::vector<double> size = reader.numbers(cam0["resolution"], "resolution");
    if (size.size() != 2) reader.fail(cam0["resolution"], "resolution: expected 2 numbers");
    camera.width = reader.side(size[0], cam0["resolution"]);
    camera.height = reader.side(size[1], cam0["resolution"]);
  }
  if (cam0["distortion_coeffs"].IsDefined())
    reader.set_distortion(
        cam0["distortion_model"].IsDefined() ? cam0["distortion_model"].Scalar() : "radtan",
        reader.numbers(cam0["distortion_coeffs"], "distortion_coeffs"), cam0["distortion_coeffs"],
        camera);
  return result;
}

/// `prefix`: "Camera." or, since its third version, "Camera1.".
ForeignCalibration read_orb_slam(const YamlDocument& yaml, const std::string& prefix) {
  const YAML::Node& root = yaml.root();
  const Reader reader(yaml, "ORB-SLAM");
  ForeignCalibration result;
  result.program = "ORB-SLAM";
  Camera& camera = result.camera;
  camera.fx = reader.number(root, prefix + "fx"), camera.fy = reader.number(root, prefix + "fy");
  camera.cx = reader.number(root, prefix + "cx"), camera.cy = reader.number(root, prefix + "cy");
  camera.width = reader.side(reader.number_or_zero(root, "Camera.width"), root);
  camera.height = reader.side(reader.number_or_zero(root, "Camera.height"), root);
  result.fps = reader.number_or_zero(root, "Camera.fps");
  if (root["Camera.bf"].IsDefined())
    result.baseline_m = reader.number(root, "Camera.bf") / camera.fx;
  if (root["Stereo.b"].IsDefined()) result.baseline_m = reader.number(root, "Stereo.b");
  for (const char* key : {"DepthMapFactor", "RGBD.DepthMapFactor"})
    if (root[key].IsDefined() && reader.number(root, key) > 0)
      result.depth_unit_m = 1 / reader.number(root, key);
  const std::string type =
      root["Camera.type"].IsDefined() ? lower(root["Camera.type"].Scalar()) : "";
  std::vector<double> d;
  const bool fisheye = type == "kannalabrandt8";
  const auto names = fisheye ? std::vector<const char*>{"k1", "k2", "k3", "k4"}
                             : std::vector<const char*>{"k1", "k2", "p1", "p2", "k3"};
  for (const char* name : names) d.push_back(reader.number_or_zero(root, prefix + name));
  reader.set_distortion(fisheye ? "equidistant" : "radtan", d, root, camera);
  return result;
}

ForeignCalibration read_realsense(const YamlDocument& yaml, const YAML::Node& camera_node) {
  const Reader reader(yaml, "RealSense");
  ForeignCalibration result;
  result.program = "RealSense";
  Camera& camera = result.camera;
  camera.fx = reader.number(camera_node, "fx"), camera.fy = reader.number(camera_node, "fy");
  camera.cx = reader.number(camera_node, "ppx"), camera.cy = reader.number(camera_node, "ppy");
  camera.width = reader.side(reader.number_or_zero(camera_node, "width"), camera_node);
  camera.height = reader.side(reader.number_or_zero(camera_node, "height"), camera_node);
  if (camera_node["coeffs"].IsDefined()) {
    std::string model =
        camera_node["model"].IsDefined() ? lower(camera_node["model"].Scalar()) : "";
    if (const std::size_t dot = model.rfind('.'); dot != model.npos) model.erase(0, dot + 1);
    std::replace(model.begin(), model.end(), ' ', '_');
    reader.set_distortion(model, reader.numbers(camera_node["coeffs"], "coeffs"),
                          camera_node["coeffs"], camera);
  }
  return result;
}

std::optional<ForeignCalibration> read_yaml(const std::string& path) {
  const YamlDocument yaml(path);
  const YAML::Node& root = yaml.root();
  if (!root.IsMap()) return std::nullopt;
  if (root["cam0"].IsDefined() && root["cam0"].IsMap()) return read_kalibr(yaml);
  for (const char* prefix : {"Camera.", "Camera1."})
    if (root[std::string(prefix) + "fx"].IsDefined()) return read_orb_slam(yaml, prefix);
  const YAML::Node matrix =
      first_of(root, {"camera_matrix", "Camera_Matrix", "cameraMatrix", "K", "k"});
  if (matrix.IsDefined()) return read_opencv(yaml, matrix);
  if (root["ppx"].IsDefined()) return read_realsense(yaml, root);
  for (const char* stream : {"color", "rgb", "left", "infrared"})
    if (root[stream].IsDefined() && root[stream].IsMap() && root[stream]["ppx"].IsDefined())
      return read_realsense(yaml, root[stream]);
  return std::nullopt;
}

/// OpenCV's XML by its own reader, as the YAML that it would have written.
std::optional<ForeignCalibration> read_xml(const std::string& path) {
  ForeignCalibration result;
  result.program = "OpenCV";
  try {
    const cv::FileStorage file(path, cv::FileStorage::READ);
    cv::Mat K, d;
    for (const char* key : {"camera_matrix", "Camera_Matrix", "cameraMatrix", "K"})
      if (!file[key].empty()) file[key] >> K;
    for (const char* key :
         {"distortion_coefficients", "Distortion_Coefficients", "distCoeffs", "D"})
      if (!file[key].empty()) file[key] >> d;
    if (K.total() != 9)
      throw FileError(path, "OpenCV's calibration: no camera matrix of 9 numbers");
    K.convertTo(K, CV_64F);
    d.convertTo(d, CV_64F);
    Camera& camera = result.camera;
    camera.fx = K.at<double>(0, 0), camera.cx = K.at<double>(0, 2);
    camera.fy = K.at<double>(1, 1), camera.cy = K.at<double>(1, 2);
    for (const char* key : {"image_width", "image_Width", "width"})
      if (!file[key].empty()) camera.width = static_cast<int>(file[key]);
    for (const char* key : {"image_height", "image_Height", "height"})
      if (!file[key].empty()) camera.height = static_cast<int>(file[key]);
    const std::vector<double> coefficients(d.begin<double>(), d.end<double>());
    if (std::any_of(coefficients.begin(), coefficients.end(), [](double k) { return k != 0; }))
      set_radial_tangential(coefficients, camera);
  } catch (const cv::Exception& error) {
    throw FileError(path, std::string("OpenCV's calibration: ") + error.err);
  } catch (const ArgumentError& error) {
    throw FileError(path, std::string("OpenCV's calibration: ") + error.what());
  }
  return result;
}

/// "CAMERA_ID MODEL WIDTH HEIGHT PARAMS...", of which the first line is taken. (0.5, 0.5) is the
/// centre of COLMAP's first pixel.
std::optional<ForeignCalibration> read_colmap(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  std::vector<std::string_view> fields;
  if (!file.next_data(line)) return std::nullopt;
  split_blank(line, fields);
  if (fields.size() < 7 || !parse_integer(fields[0]) ||
      !std::isupper(static_cast<unsigned char>(fields[1][0])))
    return std::nullopt;
  ForeignCalibration result;
  result.program = "COLMAP";
  Camera& camera = result.camera;
  const std::int64_t width = file.integer(fields[2], "width"),
                     height = file.integer(fields[3], "height");
  if (width < 1 || height < 1 || width > 20000 || height > 20000)
    file.fail("COLMAP's calibration: the size is not one of 1 to 20000 px");
  camera.width = static_cast<int>(width), camera.height = static_cast<int>(height);
  std::vector<double> p;
  for (std::size_t i = 4; i < fields.size(); ++i) p.push_back(file.number(fields[i], "parameter"));
  const std::string model(fields[1]);
  const bool one_focal = model == "SIMPLE_PINHOLE" || model == "SIMPLE_RADIAL" ||
                         model == "RADIAL" || model == "SIMPLE_RADIAL_FISHEYE";
  const std::size_t intrinsics = one_focal ? 3 : 4;
  const auto count = [&]() -> std::size_t {
    if (model == "SIMPLE_PINHOLE" || model == "PINHOLE") return 0;
    if (model == "SIMPLE_RADIAL") return 1;
    if (model == "RADIAL") return 2;
    if (model == "OPENCV" || model == "OPENCV_FISHEYE") return 4;
    if (model == "FULL_OPENCV") return 8;
    file.fail("COLMAP's calibration: the model " + in_quotes(model) +
              " is not known: undistort the images");
  }();
  if (p.size() != intrinsics + count)
    file.fail(fmt::format("COLMAP's calibration: {} has {} parameters, not {}", model,
                          intrinsics + count, p.size()));
  camera.fx = p[0], camera.fy = one_focal ? p[0] : p[1];
  camera.cx = p[intrinsics - 2] - 0.5, camera.cy = p[intrinsics - 1] - 0.5;
  std::vector<double> d(p.begin() + static_cast<std::ptrdiff_t>(intrinsics), p.end());
  if (model == "OPENCV_FISHEYE") {
    camera.distortion = Distortion::kEquidistant;
    std::copy(d.begin(), d.end(), camera.coefficients.begin());
  } else if (!d.empty()) {
    d.resize(std::max<std::size_t>(d.size(), 4), 0);
    try {
      set_radial_tangential(d, camera);
    } catch (const ArgumentError& error) {
      file.fail(std::string("COLMAP's calibration: ") + error.what());
    }
  }
  return result;
}

}  // namespace

void set_radial_tangential(const std::vector<double>& coefficients, Camera& camera) {
  const bool rest_is_zero =
      coefficients.size() <= 5 ||
      std::all_of(coefficients.begin() + 5, coefficients.end(), [](double k) { return k == 0; });
  require(coefficients.size() >= 4 && rest_is_zero,
          fmt::format(
              "a radial-tangential lens has 4 or 5 coefficients, not {}{}", coefficients.size(),
              coefficients.size() >= 8 ? " (the rational model of eight is read where k4, k5 and "
                                         "k6 are zero; else undistort the images first)"
                                       : ""));
  camera.distortion = Distortion::kRadialTangential;
  std::copy(coefficients.begin(),
            coefficients.begin() +
                static_cast<std::ptrdiff_t>(std::min<std::size_t>(coefficients.size(), 5)),
            camera.coefficients.begin());
}

std::optional<ForeignCalibration> read_foreign_calibration(const std::string& path) {
  TextFile file(path);
  std::string_view line;
  bool any = false;
  while (!any && file.next(line)) any = !line.empty();
  std::optional<ForeignCalibration> result;
  if (any && line.starts_with("<?xml"))
    result = read_xml(path);
  else if (path.ends_with(".txt"))
    result = read_colmap(path);
  else
    result = read_yaml(path);
  if (!result) return result;
  const Camera& camera = result->camera;
  if (!(camera.fx > 0 && camera.fy > 0))
    throw FileError(path, result->program + "'s calibration: fx, fy: must be positive");
  return result;
}

}  // namespace placegraph
