"""Terms, values and noise models of gtsam, as poses, information and kernels."""

from __future__ import annotations

import re
from importlib import metadata
from typing import TYPE_CHECKING, Any

from . import _core
from ._optional import optional
from .graphs import RobustKernel

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

# Position of our coordinates in the tangent of gtsam.
ORDER = {"SE2": [0, 1, 2], "SE3": [3, 4, 5, 0, 1, 2]}
EQUAL = 1e-6  # difference of a prior and its node that accuracy explains
ESTIMATORS = {"huber": "Huber", "cauchy": "Cauchy", "tukey": "Tukey"}


def gtsam_module() -> Any:
    """The module gtsam; ImportError names its version if that is too old."""
    gtsam = optional("gtsam", "gtsam")
    try:
        version = metadata.version("gtsam")
    except metadata.PackageNotFoundError:  # built from its sources
        return gtsam
    numbers = re.match(r"(\d+)\.(\d+)", version)
    if numbers and (int(numbers[1]), int(numbers[2])) < (4, 3):
        raise ImportError(f"gtsam {version} is installed, whose planar errors are others; 4.3 or "
                          "later is needed: pip install 'placegraph[gtsam]'", name="gtsam")
    return gtsam


def name_of(gtsam: Any, i: int, term: Any) -> str:
    """A factor in messages: its number, class and keys, as gtsam prints these."""
    keys = ", ".join(gtsam.DefaultKeyFormatter(key) for key in term.keys())
    return f"factors: factor {i}, a {type(term).__name__} of {keys}"


def terms_of(gtsam: Any, factors: Any, values: Any) -> list[Any]:
    """The factors; ArgumentError for wrong keys and for an equality of another value."""
    known = set(values.keys())
    terms = [factors.at(i) for i in range(factors.size())]
    for i, term in enumerate(terms):
        if len(set(term.keys())) < len(term.keys()):
            raise _core.ArgumentError(f"{name_of(gtsam, i, term)}, has a key twice")
        for key in term.keys():
            if key not in known:
                raise _core.ArgumentError(f"{name_of(gtsam, i, term)}: there is no value of "
                                          f"{gtsam.DefaultKeyFormatter(key)}")
        if type(term).__name__.startswith("NonlinearEquality"):
            if not max(map(abs, term.unwhitenedError(values))) <= EQUAL:
                raise _core.ArgumentError(
                    f"{name_of(gtsam, i, term)}, differs from the value of its node")
    return terms


def pose_noise_of(gtsam: Any, term: Any, name: str) -> tuple[NDArray[np.float64], RobustKernel]:
    """The information of an error of poses in the order of our tangent, and its kernel."""
    import numpy as np

    information, kernel = noise_of(gtsam, term.noiseModel(), name)
    order = ORDER["SE2" if information.shape[0] == 3 else "SE3"]
    return information[np.ix_(order, order)], kernel


def noise_of(gtsam: Any, model: Any, name: str) -> tuple[NDArray[np.float64], RobustKernel]:
    """The information of a noise model, and its kernel."""
    import numpy as np

    kernel = RobustKernel()
    if isinstance(model, gtsam.noiseModel.Robust):
        estimator = model.robust()
        kind = type(estimator).__name__.lower()
        width = re.search(r"\(([^()]*)\)", repr(estimator))  # no method tells it
        if kind not in ESTIMATORS or width is None:
            raise _core.ArgumentError(f"{name}: its robust estimator is not converted")
        kernel = RobustKernel(kind, float(width.group(1)))
        model = model.noise()
    if model is None or model.isConstrained():
        raise _core.ArgumentError(f"{name}: its noise model is constrained")
    root = np.array([model.whiten(unit) for unit in np.eye(model.dim())]).T
    return root.T @ root, kernel


def lever_arm_of(gtsam: Any, term: Any) -> NDArray[np.float64] | None:
    """The lever arm of a measured position, which no method of gtsam tells."""
    if not isinstance(term, gtsam.GPSFactorArm):
        return None
    arm: NDArray[np.float64] = term.evaluateError(gtsam.Pose3()) + term.measurementIn()
    return arm


def pose_of_row(gtsam: Any, row: NDArray[np.float64]) -> Any:
    if len(row) == 3:
        return gtsam.Pose2(*row)
    x, y, z, w = row[3:]
    return gtsam.Pose3(gtsam.Rot3.Quaternion(w, x, y, z), row[:3])


def row_of_value(gtsam: Any, values: Any, key: int) -> NDArray[np.float64]:
    for read in (values.atPose3, values.atPose2):
        try:
            return row_of_pose(gtsam, read(key))
        except RuntimeError:  # of another kind
            continue
    raise _core.ArgumentError(
        f"values: the value of {gtsam.DefaultKeyFormatter(key)} is not a Pose2 or Pose3")


def row_of_pose(gtsam: Any, pose: Any) -> NDArray[np.float64]:
    import numpy as np

    if isinstance(pose, gtsam.Pose2):
        return np.array([pose.x(), pose.y(), pose.theta()])
    q = pose.rotation().toQuaternion()
    return np.array([*pose.translation(), q.x(), q.y(), q.z(), q.w()])


def noise_model(gtsam: Any, information: NDArray[np.float64], kernel: RobustKernel) -> Any:
    model = gtsam.noiseModel.Gaussian.Information(information)
    if kernel.kind == "none":
        return model
    if kernel.kind not in ESTIMATORS:
        raise _core.ArgumentError(f"graph: the kernel '{kernel.kind}' is not converted")
    estimator = getattr(gtsam.noiseModel.mEstimator, ESTIMATORS[kernel.kind])
    return gtsam.noiseModel.Robust.Create(estimator.Create(kernel.width), model)


def largest_sigma(gtsam: Any, model: Any) -> float:
    """The largest standard deviation of a noise model in any direction."""
    import numpy as np

    if model is None or isinstance(model, gtsam.noiseModel.Robust):
        return float("inf")
    if model.isConstrained():
        return float(model.sigmas().max())
    root = np.array([model.whiten(unit) for unit in np.eye(model.dim())])
    smallest = float(np.linalg.svd(root, compute_uv=False).min())
    return 1 / smallest if smallest > 0 else float("inf")
