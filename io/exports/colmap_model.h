#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/io/exports/ply_points.h>

#include <string>
#include <vector>

namespace placegraph {

/// A sparse reconstruction as COLMAP stores it: a camera, posed images, points with their tracks.
struct ColmapModel {
  /// An image point of a point.
  struct Observation {
    Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< (0, 0): centre of the first pixel
    int point = 0;                                 ///< position in `points`
  };
  /// An image with its pose.
  struct Image {
    std::uint32_t id = 0;                   ///< unique, from 1
    std::string name;                       ///< path within the folder of the images
    SE3 T_world_cam;                        ///< pose of its camera
    std::vector<Observation> observations;  ///< in any order
  };
  /// A point in the world.
  struct Point {
    std::uint64_t id = 0;                               ///< unique, from 1
    Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< position
    std::array<std::uint8_t, 3> rgb{};                  ///< red, green, blue
    double error_px = 0;                                ///< mean reprojection error
  };
  /// A camera as the files describe it.
  struct RawCamera {
    std::uint32_t id = 0;                 ///< unique
    std::string model;                    ///< name of its model, such as FULL_OPENCV
    std::uint64_t width = 0, height = 0;  ///< size of its images [px]
    std::vector<double> parameters;       ///< all parameters of the model
  };
  Camera camera;                          ///< camera of all images
  std::uint32_t camera_id = 1;            ///< its id
  std::vector<RawCamera> unused_cameras;  ///< further cameras, which no image has
  std::vector<Image> images;              ///< images, in any order
  std::vector<Point> points;              ///< points, in any order
};

/// Pixels of COLMAP count from the corner of the first one, ours from its centre [px].
inline constexpr double kColmapCorner_px = 0.5;

/// Ids of the cameras that no image has.
std::vector<std::uint32_t> unused_camera_ids(const ColmapModel& model);

/// Contents of the files of a model.
struct ColmapFiles {
  std::string cameras, images, points;  ///< cameras, images and points3D, .bin or .txt
};

/// The files of a model, with poses T_cam_world and pixels from the corner of the first pixel.
/// The camera of the images is PINHOLE, OPENCV or OPENCV_FISHEYE; unused ones remain as they are.
/// Throws ArgumentError if the camera has a third radial coefficient, an observation refers to a
/// missing point, ids are not unique, those of images or points not positive, a name is empty, or
/// has a blank in a text, or the model of an unused camera has no number for the binary form.
ColmapFiles to_colmap(const ColmapModel& model, NumberForm form);

}  // namespace placegraph
