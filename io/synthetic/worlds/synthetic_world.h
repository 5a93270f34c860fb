#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/geometry/trajectory.h>
#include <placegraph/graph/image/frame.h>
#include <placegraph/graph/scene/scene_model.h>
#include <placegraph/io/synthetic/defects/defects.h>

#include <memory>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

struct LabelledMesh;

namespace synthetic {
struct FlightSetting;
struct Rendering;
struct SensorModel;
struct Tour;
struct View;
}  // namespace synthetic

/// What to render. The same options give the same bits.
struct SyntheticOptions {
  std::string world = "town-loop";  ///< a built-in world, or the path of a KITTI pose file
  synthetic::Difficulty difficulty = synthetic::Difficulty::kStandard;  ///< of the images
  std::uint64_t seed = 1;     ///< another seed gives another world
  int frames = 0;             ///< at most this many from the start; 0 = all
  double duration_s = 0;      ///< duration of the flight, world `flight` only; 0 = 120 s
  int width = 0, height = 0;  ///< [px], intrinsics scaled along; 0 = the world's own
  int threads = 1;            ///< threads of one rendering
  SyntheticDefects defects;   ///< how images and calibration differ from what is written

  void check() const;  ///< throws ArgumentError naming the field
};
void visit(OptionVisitor& field, SyntheticOptions& options);

/// Requested contents of a SyntheticFrame beside the left image.
struct SyntheticContents {
  bool right = false;   ///< the right image
  bool depth = false;   ///< the depth image
  bool labels = false;  ///< the class of every pixel
  bool planes = false;  ///< the plane of every pixel
  bool flow = false;    ///< the displacement of every pixel
};

/// A frame with its ground truth.
///
/// All is at the left pixels' centres and the middle of the exposure; with the defect `depth_lag_s`
/// depth is older.
struct SyntheticFrame {
  Frame frame;   ///< image; right and depth if requested
  Image labels;  ///< CV_8UC1, see class_names()
  Image planes;  ///< CV_16UC1, row of planes(), 0 = no plane
  Image flow;    ///< CV_32FC2: displacement [px] to the next frame, NaN: none; empty for the last
};

/// A rendered sequence, computed on demand and without a disk.
///
/// Moving objects are followed in `flow`. Const members may be called from several threads at once.
class SyntheticWorld {
 public:
  /// Names of the built-in worlds.
  static const std::vector<std::string>& worlds();

  /// Builds the world. Throws ArgumentError for bad options and unknown worlds, FileError for a bad
  /// pose file.
  explicit SyntheticWorld(const SyntheticOptions& options);
  ~SyntheticWorld();
  SyntheticWorld(SyntheticWorld&&) noexcept;
  SyntheticWorld& operator=(SyntheticWorld&&) noexcept;

  const std::string& name() const;  ///< name of the world
  std::size_t size() const;         ///< number of frames
  /// The written calibration.
  ///
  /// It has baseline, depth camera (the left camera's own) and, if it is constant, camera height.
  Calibration calibration() const;
  std::int64_t stamp_ns(std::size_t index) const;  ///< the written time
  /// The time of the middle of the exposure, without the written time's error.
  double exposure_time_s(std::size_t index) const;
  /// Poses T_first_cam of the left camera at the written times, as in poses.txt.
  Trajectory ground_truth() const;
  /// Renders a frame. Throws ArgumentError for an index that is not below size().
  SyntheticFrame render(std::size_t index, const SyntheticContents& contents) const;
  /// Renders an image and its depth from a pose of the caller's: no sensor model, time 0.
  ///
  /// `T_plan_cam`: the pose in axes of the scene (y down, level), from the first camera's position,
  /// as in floor_plan().
  Frame view_from(const SE3& T_plan_cam) const;

  /// Names of the classes of labels.
  static std::vector<std::string> class_names();
  /// The street class and the surface of every label; empty for labels without a street class.
  static std::vector<SceneClass> scene_classes();
  /// Planes n . p = d of the static scene in the first camera's frame: (n, d); row 0 is unused.
  std::vector<Eigen::Vector4d> planes() const;
  /// A JSON text with rooms, walls and doors; empty outdoors.
  const std::string& floor_plan() const;
  /// The static part of the scene in the first camera's frame.
  ///
  /// Faces have the classes of labelled street images, the others their own names.
  LabelledMesh static_mesh() const;
  bool is_indoor() const;  ///< whether the world is inside of a building
  /// Flight, markers and camera mounting of the flight world; null for other worlds.
  const synthetic::FlightSetting* flight_setting() const;
  const SyntheticOptions& options() const { return options_; }  ///< those of the constructor
  /// The scene and the camera's path through it, in the scene's own frame (y down, level).
  const synthetic::Tour& tour() const { return *tour_; }

 private:
  synthetic::View view(std::size_t index, bool right, double delay_s = 0) const;
  synthetic::Rendering see(std::size_t index, bool right) const;
  Image expose(std::size_t index, bool right, const synthetic::Rendering& rendering) const;
  Image measure_depth(std::size_t index, const synthetic::Rendering& at_image) const;
  std::uint32_t frame_seed(std::size_t index, int image) const;

  SyntheticOptions options_;
  std::unique_ptr<const synthetic::SensorModel> sensor_;
  std::unique_ptr<const synthetic::Tour> tour_;
};

}  // namespace placegraph
