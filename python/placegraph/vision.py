"""Single functions on arrays: optical flow, motions, homographies, planes, scenes, markers.

    from placegraph import vision

    flow = vision.optical_flow(first, second, "dis")              # H x W x 2 float32
    pose = vision.estimate_relative_pose(camera, px_ref, px_cur)  # N x 2 each
    if pose:
        print(pose.T_ref_cur, pose.inliers)

Images are H x W arrays of uint8 (colour: H x W x 3, blue, green, red), depth images H x W of
float32 [m], points N x 2 [px] or N x 3 [m]. A result is true if it may be used; otherwise `outcome`
and `reason` say why not. Each function has options of its own: `vision.FlowOptions()`.
"""

from __future__ import annotations

from . import _core
from ._core import (
    AffineFlow,
    AlignmentResult,
    AlignResult,
    CircularMotionResult,
    CloudPlane,
    CloudPlanesResult,
    Cuboid,
    DepthPlane,
    DerotatedFlow,
    FlowError,
    FlowVectors,
    GravityPoseResult,
    HomographyFit,
    HomographyMotion,
    Horizon,
    LabelledImage,
    LateralBalance,
    ManhattanFrame,
    MarkerDetector,
    MarkerObservation,
    MarkerPose,
    MarkerPoses,
    MatchedPoints,
    MotionFromPlanesResult,
    OrientationMap,
    PlanarRegion,
    PlanarRegionsResult,
    Plane,
    PlanesReading,
    PlaneTrack,
    PlaneTracker,
    PointCloud,
    Pose3d2dResult,
    Pose3d3dResult,
    RelativePose,
    SceneDirections,
    SceneModel,
    TimeToContact,
    VanishingPoint,
    VentralMotion,
    affine_flow,
    align,
    classify_surfaces,
    compute_orientation_map,
    decompose_homography,
    derotate,
    detect_segments,
    estimate_circular_motion,
    estimate_horizon,
    estimate_marker_poses,
    estimate_pose_3d2d,
    estimate_pose_3d3d,
    estimate_pose_with_gravity,
    estimate_relative_pose,
    find_cloud_planes,
    find_corners,
    find_cuboids,
    find_depth_planes,
    find_planar_regions,
    find_scene_directions,
    flow_error,
    flow_methods,
    homography_from_plane,
    homography_through,
    indoor_surfaces,
    interpolation_flow,
    key_pixel_flow,
    label_jointly,
    lateral_balance,
    lucas_kanade,
    marker_dictionaries,
    match_wide,
    motion_from_homography,
    motion_from_planes,
    optical_flow,
    refine_homography,
    sampled_flow,
    time_to_contact,
    umeyama,
    ventral_motion,
)
from .options import kinds


class FlowOptions(kinds.FlowOptions):
    """Options of `optical_flow`."""

    __slots__ = ()
    _kind = _core.FlowOptionSet


class LucasKanadeOptions(kinds.LucasKanadeOptions):
    """Options of `lucas_kanade`."""

    __slots__ = ()
    _kind = _core.LucasKanadeOptionSet


class InterpolationFlowOptions(kinds.InterpolationFlowOptions):
    """Options of `interpolation_flow`."""

    __slots__ = ()
    _kind = _core.InterpolationFlowOptionSet


class KeyPixelFlowOptions(kinds.KeyPixelFlowOptions):
    """Options of `key_pixel_flow`."""

    __slots__ = ()
    _kind = _core.KeyPixelFlowOptionSet


class RelativePoseOptions(kinds.RelativePoseOptions):
    """Options of `estimate_relative_pose`."""

    __slots__ = ()
    _kind = _core.RelativePoseOptionSet


class Pose3d2dOptions(kinds.Pose3d2dOptions):
    """Options of `estimate_pose_3d2d`."""

    __slots__ = ()
    _kind = _core.Pose3d2dOptionSet


class Pose3d3dOptions(kinds.Pose3d3dOptions):
    """Options of `estimate_pose_3d3d`."""

    __slots__ = ()
    _kind = _core.Pose3d3dOptionSet


class GravityPoseOptions(kinds.GravityPoseOptions):
    """Options of `estimate_pose_with_gravity`."""

    __slots__ = ()
    _kind = _core.GravityPoseOptionSet


class CircularMotionOptions(kinds.CircularMotionOptions):
    """Options of `estimate_circular_motion`."""

    __slots__ = ()
    _kind = _core.CircularMotionOptionSet


class PlanarRegionsOptions(kinds.PlanarRegionsOptions):
    """Options of `find_planar_regions`."""

    __slots__ = ()
    _kind = _core.PlanarRegionsOptionSet


class MotionFromPlanesOptions(kinds.MotionFromPlanesOptions):
    """Options of `motion_from_planes`."""

    __slots__ = ()
    _kind = _core.MotionFromPlanesOptionSet


class AlignOptions(kinds.AlignOptions):
    """Options of `align`."""

    __slots__ = ()
    _kind = _core.AlignOptionSet


class PlaneTrackerOptions(kinds.PlaneTrackerOptions):
    """Options of `PlaneTracker`."""

    __slots__ = ()
    _kind = _core.PlaneTrackerOptionSet


class CloudPlanesOptions(kinds.CloudPlanesOptions):
    """Options of `find_cloud_planes`."""

    __slots__ = ()
    _kind = _core.CloudPlanesOptionSet


class CuboidOptions(kinds.CuboidOptions):
    """Options of `find_cuboids`."""

    __slots__ = ()
    _kind = _core.CuboidOptionSet


class DepthPlanesOptions(kinds.DepthPlanesOptions):
    """Options of `find_depth_planes`."""

    __slots__ = ()
    _kind = _core.DepthPlanesOptionSet


class SegmentDetectorOptions(kinds.SegmentDetectorOptions):
    """Options of `detect_segments`."""

    __slots__ = ()
    _kind = _core.SegmentDetectorOptionSet


class WideMatcherOptions(kinds.WideMatcherOptions):
    """Options of `match_wide`."""

    __slots__ = ()
    _kind = _core.WideMatcherOptionSet


class SceneDirectionOptions(kinds.SceneDirectionOptions):
    """Options of `find_scene_directions`."""

    __slots__ = ()
    _kind = _core.SceneDirectionOptionSet


class OrientationMapOptions(kinds.OrientationMapOptions):
    """Options of `compute_orientation_map`."""

    __slots__ = ()
    _kind = _core.OrientationMapOptionSet


class MarkerDetectorOptions(kinds.MarkerDetectorOptions):
    """Options of `MarkerDetector`."""

    __slots__ = ()
    _kind = _core.MarkerDetectorOptionSet


class HorizonOptions(kinds.HorizonOptions):
    """Options of `estimate_horizon`."""

    __slots__ = ()
    _kind = _core.HorizonOptionSet

__all__ = [
    "AffineFlow",
    "AlignOptions",
    "AlignResult",
    "AlignmentResult",
    "CircularMotionOptions",
    "CircularMotionResult",
    "CloudPlane",
    "CloudPlanesOptions",
    "CloudPlanesResult",
    "Cuboid",
    "CuboidOptions",
    "DepthPlane",
    "DepthPlanesOptions",
    "DerotatedFlow",
    "FlowError",
    "FlowOptions",
    "FlowVectors",
    "GravityPoseOptions",
    "GravityPoseResult",
    "HomographyFit",
    "HomographyMotion",
    "Horizon",
    "HorizonOptions",
    "InterpolationFlowOptions",
    "KeyPixelFlowOptions",
    "LabelledImage",
    "LateralBalance",
    "LucasKanadeOptions",
    "ManhattanFrame",
    "MarkerDetector",
    "MarkerDetectorOptions",
    "MarkerObservation",
    "MarkerPose",
    "MarkerPoses",
    "MatchedPoints",
    "MotionFromPlanesOptions",
    "MotionFromPlanesResult",
    "OrientationMap",
    "OrientationMapOptions",
    "PlanarRegion",
    "PlanarRegionsOptions",
    "PlanarRegionsResult",
    "Plane",
    "PlaneTrack",
    "PlaneTracker",
    "PlaneTrackerOptions",
    "PlanesReading",
    "PointCloud",
    "Pose3d2dOptions",
    "Pose3d2dResult",
    "Pose3d3dOptions",
    "Pose3d3dResult",
    "RelativePose",
    "RelativePoseOptions",
    "SceneDirectionOptions",
    "SceneDirections",
    "SceneModel",
    "SegmentDetectorOptions",
    "TimeToContact",
    "VanishingPoint",
    "VentralMotion",
    "WideMatcherOptions",
    "affine_flow",
    "align",
    "classify_surfaces",
    "compute_orientation_map",
    "decompose_homography",
    "derotate",
    "detect_segments",
    "estimate_circular_motion",
    "estimate_horizon",
    "estimate_marker_poses",
    "estimate_pose_3d2d",
    "estimate_pose_3d3d",
    "estimate_pose_with_gravity",
    "estimate_relative_pose",
    "find_cloud_planes",
    "find_corners",
    "find_cuboids",
    "find_depth_planes",
    "find_planar_regions",
    "find_scene_directions",
    "flow_error",
    "flow_methods",
    "homography_from_plane",
    "homography_through",
    "indoor_surfaces",
    "interpolation_flow",
    "key_pixel_flow",
    "label_jointly",
    "lateral_balance",
    "lucas_kanade",
    "marker_dictionaries",
    "match_wide",
    "motion_from_homography",
    "motion_from_planes",
    "optical_flow",
    "refine_homography",
    "sampled_flow",
    "time_to_contact",
    "umeyama",
    "ventral_motion",
]
