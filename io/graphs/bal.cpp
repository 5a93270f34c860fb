#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/graphs/bal.h>

#include <array>

namespace placegraph {
namespace {

/// Conversion from the file's camera axes (y up, z backward) to ours (y down, z forward), and back.
SE3 half_turn_about_x() {
  return SE3(SO3(Eigen::Quaterniond(0, 1, 0, 0)), Eigen::Vector3d::Zero());
}

/// Reads the numbers of a file one after the other, independent of line breaks.
class NumberStream {
 public:
  explicit NumberStream(const std::string& path) : file_(path) {}

  double number(const char* what) { return file_.number(next(what), what); }
  int index(const char* what, std::int64_t count) {
    const std::int64_t value = file_.integer(next(what), what);
    if (value < 0 || value >= count)
      file_.fail(fmt::format("{}: {} is not in [0, {})", what, value, count));
    return static_cast<int>(value);
  }
  std::int64_t count(const char* what) {
    const std::int64_t value = file_.integer(next(what), what);
    if (value < 0 || value > std::numeric_limits<int>::max())
      file_.fail(fmt::format("{}: {} is out of range", what, value));
    return value;
  }
  void expect_end() {
    if (advance()) file_.fail("more numbers than the counts in the first line require");
  }
  const TextFile& file() const { return file_; }

 private:
  bool advance() {
    std::string_view line;
    while (at_ == fields_.size()) {
      if (!file_.next(line)) return false;
      split_blank(line, fields_);
      at_ = 0;
    }
    return true;
  }
  std::string_view next(const char* what) {
    if (!advance()) file_.fail(fmt::format("the file ends where a {} is expected", what));
    return fields_[at_++];
  }

  TextFile file_;
  std::vector<std::string_view> fields_;
  std::size_t at_ = 0;
};

/// Rotation vector, translation, focal length and coefficients.
using CameraNumbers = std::array<double, 9>;

BundleCamera camera_of(const CameraNumbers& v) {
  const SE3 T_cam_world(SO3::exp({v[0], v[1], v[2]}), Eigen::Vector3d(v[3], v[4], v[5]));
  return {(half_turn_about_x() * T_cam_world).inverse(), v[6], v[7], v[8], v};
}

BundleCamera parse_camera(NumberStream& numbers) {
  CameraNumbers v;
  for (double& x : v) x = numbers.number("camera parameter");
  if (!(v[6] > 0)) numbers.file().fail(fmt::format("the focal length {} is not positive", v[6]));
  return camera_of(v);
}

bool are_equal(const BundleCamera& a, const BundleCamera& b) {
  return a.T_world_cam.matrix() == b.T_world_cam.matrix() && a.focal_px == b.focal_px &&
         a.k1 == b.k1 && a.k2 == b.k2;
}

/// The numbers of a camera: those of its file while they give it.
CameraNumbers numbers_of(const BundleCamera& camera) {
  if (camera.of_file && are_equal(camera_of(*camera.of_file), camera)) return *camera.of_file;
  const SE3 T_cam_world = half_turn_about_x() * camera.T_world_cam.inverse();
  const Eigen::Vector3d w = T_cam_world.rotation().log(), t = T_cam_world.translation();
  return {w[0], w[1], w[2], t[0], t[1], t[2], camera.focal_px, camera.k1, camera.k2};
}

}  // namespace

Bundle read_bal(const std::string& path) {
  NumberStream numbers(path);
  const std::int64_t cameras = numbers.count("number of cameras");
  const std::int64_t points = numbers.count("number of points");
  const std::int64_t observations = numbers.count("number of observations");
  Bundle bundle;
  for (std::int64_t i = 0; i < observations; ++i) {
    BundleObservation o;
    o.camera = numbers.index("camera index", cameras);
    o.point = numbers.index("point index", points);
    o.px[0] = numbers.number("pixel");
    o.px[1] = -numbers.number("pixel");
    bundle.observations.push_back(o);
  }
  for (std::int64_t i = 0; i < cameras; ++i) bundle.cameras.push_back(parse_camera(numbers));
  for (std::int64_t i = 0; i < points; ++i) {
    Eigen::Vector3d p_world;
    for (int k = 0; k < 3; ++k) p_world[k] = numbers.number("point coordinate");
    bundle.points.push_back(p_world);
  }
  numbers.expect_end();
  return bundle;
}

void write_bal(const std::string& path, const Bundle& bundle) {
  bundle.check();
  AtomicFile file(path);
  std::ofstream& out = file.stream();
  out << fmt::format("{} {} {}\n", bundle.cameras.size(), bundle.points.size(),
                     bundle.observations.size());
  for (const BundleObservation& o : bundle.observations)
    out << fmt::format("{} {} {:.17g} {:.17g}\n", o.camera, o.point, o.px[0], -o.px[1]);
  for (const BundleCamera& camera : bundle.cameras)
    for (const double x : numbers_of(camera)) out << fmt::format("{:.17g}\n", x);
  for (const Eigen::Vector3d& p : bundle.points)
    out << fmt::format("{:.17g}\n{:.17g}\n{:.17g}\n", p[0], p[1], p[2]);
  file.commit();
}

}  // namespace placegraph
