"""Visual SLAM whose backend is a pose graph of topological places.

    import placegraph as pg

    dataset = pg.open_dataset("kitti/sequences/00")
    result = pg.run(dataset)
    print(pg.evaluate(dataset.ground_truth, result.trajectory()))
"""

import importlib as _importlib
import typing as _typing

from . import loops, synthetic, vision
from ._core import version as __version__
from ._core import (
    ArgumentError,
    Calibration,
    Camera,
    ComponentJoined,
    DataNote,
    DepthCamera,
    Distortion,
    Doubt,
    Error,
    EvoResult,
    FigureTable,
    FileError,
    Frame,
    FrameResult,
    FrameView,
    ImuRecording,
    KeyframeAdded,
    LensDistortion,
    LensFound,
    MapMoved,
    MeasuredMotion,
    MotionNoise,
    NoResult,
    OffsetEstimate,
    PlaceAdded,
    PlaceRecognizer,
    PlacesMerged,
    PlaceView,
    RunBegan,
    SE3,
    Sensor,
    SequenceFilter,
    StampedPose,
    TrackingState,
    Trajectory,
    TrajectoryFormat,
    TrajectoryInfo,
    TruthMount,
    TruthNoise,
    edge_consistency,
    estimate_truth_noise,
    filter_steps,
    fit_mount,
    merge_trajectories,
    read_evo_result,
    with_offsets,
)
from ._info import trajectory_info
from ._offsets import estimate_offsets
from ._progress import Progress
from ._show import page_of, show
from .comparison import Comparison, compare, figure_table
from .datasets import Dataset, open_dataset
from .evaluation import Evaluation, evaluate
from .factor_graph import (
    SE2,
    SO3,
    Factor,
    FactorGraph,
    FactorGraphOptions,
    FactorGraphReport,
    FixedLagSmoother,
    Line3,
    Marker,
    Plane3,
    Sim3,
    optimize_factors,
)
from .graphs import (
    IncrementalOptimizer,
    LandmarkGraph,
    OptimizedGraph,
    OptimizedLandmarkGraph,
    PoseGraph,
    PoseMarginals,
    RobustKernel,
    from_networkx,
    marginal_covariances,
    optimize,
    to_networkx,
)
from .kitti import KittiEvaluation, evaluate_kitti
from .maps import (
    Explanation,
    Judgement,
    Localization,
    Localizer,
    LoopRecord,
    Map,
    localizer_options,
)
from .options import (
    EvaluationOptions,
    IncrementalOptions,
    LocalizerOptions,
    PlaceRecognizerOptions,
    PoseGraphOptions,
    RunOptions,
    SequenceFilterOptions,
    SlamOptions,
)
from .records import GateResult, Record, gate, read_record, record
from .slam import Event, Recognizer, RecognizerArgument, RunResult, Slam, run

if _typing.TYPE_CHECKING:
    from . import bag, colmap, gtsam, rerun

# Modules for packages that few need are imported when they are first used.
_BESIDE = ("bag", "colmap", "gtsam", "rerun")

if not _typing.TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        if name in _BESIDE:
            return _importlib.import_module(f"{__name__}.{name}")
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *_BESIDE})


__all__ = [
    "__version__",
    "ArgumentError",
    "Calibration",
    "Camera",
    "Comparison",
    "ComponentJoined",
    "DataNote",
    "Dataset",
    "DepthCamera",
    "Distortion",
    "Doubt",
    "Error",
    "Evaluation",
    "EvaluationOptions",
    "Event",
    "EvoResult",
    "Explanation",
    "Factor",
    "FactorGraph",
    "FactorGraphOptions",
    "FactorGraphReport",
    "FigureTable",
    "FileError",
    "FixedLagSmoother",
    "Frame",
    "FrameResult",
    "FrameView",
    "GateResult",
    "ImuRecording",
    "IncrementalOptimizer",
    "IncrementalOptions",
    "Judgement",
    "KeyframeAdded",
    "KittiEvaluation",
    "LandmarkGraph",
    "LensDistortion",
    "LensFound",
    "Line3",
    "Localization",
    "Localizer",
    "LocalizerOptions",
    "LoopRecord",
    "Map",
    "MapMoved",
    "Marker",
    "NoResult",
    "MeasuredMotion",
    "MotionNoise",
    "OffsetEstimate",
    "OptimizedGraph",
    "OptimizedLandmarkGraph",
    "PlaceAdded",
    "PlaceRecognizer",
    "PlaceRecognizerOptions",
    "PlaceView",
    "PlacesMerged",
    "Plane3",
    "PoseGraph",
    "PoseGraphOptions",
    "PoseMarginals",
    "Progress",
    "Recognizer",
    "RecognizerArgument",
    "Record",
    "RobustKernel",
    "RunBegan",
    "RunOptions",
    "RunResult",
    "SE2",
    "SE3",
    "SO3",
    "Sensor",
    "SequenceFilter",
    "SequenceFilterOptions",
    "Sim3",
    "Slam",
    "SlamOptions",
    "StampedPose",
    "TrackingState",
    "Trajectory",
    "TrajectoryFormat",
    "TrajectoryInfo",
    "TruthMount",
    "TruthNoise",
    "compare",
    "edge_consistency",
    "estimate_offsets",
    "estimate_truth_noise",
    "evaluate",
    "evaluate_kitti",
    "filter_steps",
    "figure_table",
    "fit_mount",
    "from_networkx",
    "gate",
    "localizer_options",
    "loops",
    "marginal_covariances",
    "merge_trajectories",
    "open_dataset",
    "optimize",
    "optimize_factors",
    "page_of",
    "read_evo_result",
    "read_record",
    "record",
    "run",
    "show",
    "synthetic",
    "to_networkx",
    "trajectory_info",
    "vision",
    "with_offsets",
]
