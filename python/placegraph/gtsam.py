"""Pose graphs as those of gtsam, and back, and its factors as factor graphs.

    factors, values = placegraph.gtsam.to_gtsam(graph)
    result = gtsam.LevenbergMarquardtOptimizer(factors, values).optimize()
    graph.set_poses(placegraph.gtsam.from_gtsam(factors, result).poses)

Both errors are logarithms on the right, so costs are equal: chi2 of a graph is twice the error of
its factors. gtsam 4.3 or later is needed, because the planar error of 4.2 is another one. Tangents
are [translation, rotation] here and [rotation, translation] in gtsam's Pose3. Similarities are not
converted. `factor_graph_from_gtsam` also takes priors that are measurements, ranges and landmarks.
"""

from __future__ import annotations

import re
from importlib import metadata
from typing import TYPE_CHECKING, Any

from . import _core
from ._optional import optional
from .factor_graph import SE2, Factor, FactorGraph
from .graphs import PoseGraph, RobustKernel

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

# Position of our coordinates in the tangent of gtsam.
_ORDER = {"SE2": [0, 1, 2], "SE3": [3, 4, 5, 0, 1, 2]}
_EQUAL = 1e-6  # difference of a prior and its node that accuracy explains
_TIGHT = 1e-3  # largest standard deviation of a prior that holds its node [m, rad]
_ESTIMATORS = {"huber": "Huber", "cauchy": "Cauchy", "tukey": "Tukey"}


def to_gtsam(graph: PoseGraph, *, hold: bool = True) -> tuple[Any, Any]:
    """The factors of a pose graph (a gtsam.NonlinearFactorGraph), and its poses (gtsam.Values).

    Keys are the ids. Fixed nodes become equalities, and so does, with `hold`, the first node of
    every component without one, as `optimize` holds it. Raises ArgumentError for what gtsam has no
    factor for: similarities, measured positions in the plane, other kernels than Huber's, Cauchy's
    and Tukey's.
    """
    if not isinstance(graph, PoseGraph):
        raise _core.ArgumentError(f"graph: a PoseGraph is needed, not {type(graph).__name__}")
    gtsam = _gtsam()
    kind = graph.kind
    if kind not in _ORDER:
        raise _core.ArgumentError(f"graph: poses of {kind} are not converted")
    if graph.ids.size and graph.ids.min() < 0:
        raise _core.ArgumentError("graph: keys of gtsam are not negative, but there is a node "
                                  f"{graph.ids.min()}")
    values = gtsam.Values()
    poses = {node: _pose(gtsam, row) for node, row in zip(graph.ids.tolist(), graph.poses)}
    for node, pose in poses.items():
        values.insert(node, pose)
    factors = gtsam.NonlinearFactorGraph()
    for node in _held(graph) if hold else graph.fixed.tolist():
        equality = gtsam.NonlinearEqualityPose2 if kind == "SE2" else gtsam.NonlinearEqualityPose3
        factors.add(equality(node, poses[node]))
    _add_edges(gtsam, graph, factors)
    _add_positions(gtsam, graph, factors)
    return factors, values


def from_gtsam(factors: Any, values: Any) -> PoseGraph:
    """The pose graph of gtsam's factors and values, which to_gtsam can make.

    Nodes are ordered by their keys. Edges between consecutive keys are odometry, others loops. A
    node becomes a fixed one by an equality, and by a prior that takes away the freedom of its
    component alone: its standard deviations are at most 1e-3 (m, rad), the value of the node is
    that of the prior, and nothing else ties the component to the world. Any other prior is a
    measurement, which no constraint of a pose graph can express; `factor_graph_from_gtsam` takes
    it. Raises ArgumentError, which names the factor and its keys, for such a prior and for a factor
    of another kind.
    """
    gtsam = _gtsam()
    graph = PoseGraph()
    terms = _terms(gtsam, factors, values)
    fixed = _fixed(gtsam, terms)
    for key in sorted(values.keys()):
        row = _row(gtsam, values, key)
        try:
            graph.add_node(key, row, key in fixed)
        except _core.ArgumentError as error:  # of another kind than the others
            name = gtsam.DefaultKeyFormatter(key)
            raise _core.ArgumentError(f"values: the value of {name}: {error}") from None
    for i, term in enumerate(terms):
        if isinstance(term, _holding(gtsam)):
            continue
        keys = term.keys()
        if isinstance(term, (gtsam.BetweenFactorPose2, gtsam.BetweenFactorPose3)):
            information, kernel = _pose_noise(gtsam, term, _name(gtsam, i, term))
            source = "odometry" if keys[1] == keys[0] + 1 else "loop"
            graph.add_edge(keys[0], keys[1], _row_of(gtsam, term.measured()), information, source,
                           kernel)
        elif isinstance(term, (gtsam.GPSFactor, gtsam.GPSFactorArm)):
            information, kernel = _noise(gtsam, term.noiseModel(), _name(gtsam, i, term))
            graph.add_position(keys[0], term.measurementIn(), information,
                               _lever_arm(gtsam, term), kernel)
        else:
            raise _core.ArgumentError(f"{_name(gtsam, i, term)}, is not converted")
    graph.check()
    _require_holds(gtsam, terms, values, graph)
    return graph


def factor_graph_from_gtsam(factors: Any, values: Any) -> tuple[FactorGraph, dict[int, int]]:
    """The factor graph of gtsam's factors and values, and the variable of each key.

    Values are Pose2, Pose3 and Point3. Equalities and priors of constrained noise hold a variable.
    Converted are also: PriorFactor and BetweenFactor of Pose2 and Pose3, GPSFactor, GPSFactorArm,
    RangeFactorPose3, and GenericProjectionFactorCal3_S2 without skew whose camera is the body.
    Raises ArgumentError, which names the factor and its keys, for any other.
    """
    gtsam = _gtsam()
    terms = _terms(gtsam, factors, values)
    graph, variables = FactorGraph(), {}
    held = {term.keys()[0] for term in terms if _is_equality(gtsam, term)}
    for key in sorted(values.keys()):
        variables[key] = graph.add_variable(_variable(gtsam, values, key), key in held)
    for i, term in enumerate(terms):
        name = _name(gtsam, i, term)
        if _is_equality(gtsam, term):
            if hasattr(term, "prior") and not max(map(abs, term.unwhitenedError(values))) <= _EQUAL:
                raise _core.ArgumentError(f"{name}, differs from the value of its node")
            continue
        factor, kernel = _factor(gtsam, term, name)
        graph.add(factor, [variables[key] for key in term.keys()], kernel)
    return graph, variables


def _is_equality(gtsam: Any, term: Any) -> bool:
    """Whether a factor holds a variable where it is."""
    if isinstance(term, (gtsam.NonlinearEqualityPose2, gtsam.NonlinearEqualityPose3,
                         gtsam.NonlinearEqualityPoint3)):
        return True
    prior = isinstance(term, (gtsam.PriorFactorPose2, gtsam.PriorFactorPose3))
    return prior and _largest_sigma(gtsam, term.noiseModel()) == 0


def _variable(gtsam: Any, values: Any, key: int) -> Any:
    try:
        return values.atPoint3(key)
    except RuntimeError:  # of another kind
        row = _row(gtsam, values, key)
    return _motion(row)


def _motion(row: NDArray[np.float64]) -> Any:
    """The SE2 or SE3 of a row."""
    if len(row) == 3:
        return SE2(*row)
    return _core.SE3.from_quaternion_xyzw(row[3:], row[:3])


def _factor(gtsam: Any, term: Any, name: str) -> tuple[Factor, RobustKernel]:
    """The factor of one of gtsam's, and its kernel."""
    import numpy as np

    if isinstance(term, (gtsam.BetweenFactorPose2, gtsam.BetweenFactorPose3)):
        information, kernel = _pose_noise(gtsam, term, name)
        measured = _motion(_row_of(gtsam, term.measured()))
        return Factor.relative_pose(measured, information=information), kernel
    if isinstance(term, (gtsam.PriorFactorPose2, gtsam.PriorFactorPose3)):
        information, kernel = _pose_noise(gtsam, term, name)
        measured = _motion(_row_of(gtsam, term.prior()))
        return Factor.pose_prior(measured, information=information), kernel
    information, kernel = (_noise(gtsam, term.noiseModel(), name)
                           if hasattr(term, "noiseModel") else (np.eye(0), RobustKernel()))
    if isinstance(term, (gtsam.GPSFactor, gtsam.GPSFactorArm)):
        return Factor.position(term.measurementIn(), information=information,
                               lever_arm=_lever_arm(gtsam, term)), kernel
    if isinstance(term, gtsam.RangeFactorPose3):
        return Factor.distance(term.measured(), float(information[0, 0] ** -0.5)), kernel
    if isinstance(term, gtsam.GenericProjectionFactorCal3_S2):
        K = term.calibration()
        if K.skew() != 0 or "sensor pose" in repr(term):  # no method tells that pose
            raise _core.ArgumentError(f"{name}, has skew or a camera beside the body, and is not "
                                      "converted")
        camera = _core.Camera(max(1, round(2 * K.px())), max(1, round(2 * K.py())), K.fx(), K.fy(),
                              K.px(), K.py())
        covariance = np.linalg.inv(information)
        return Factor.reprojection(camera, term.measured(),
                                   covariance=(covariance + covariance.T) / 2), kernel
    raise _core.ArgumentError(f"{name}, is not converted")


def _holding(gtsam: Any) -> tuple[Any, ...]:
    """The kinds of factors that hold a node."""
    return (gtsam.NonlinearEqualityPose2, gtsam.NonlinearEqualityPose3, gtsam.PriorFactorPose2,
            gtsam.PriorFactorPose3)


def _fixed(gtsam: Any, terms: list[Any]) -> set[int]:
    """Keys of the nodes that equalities and priors hold."""
    return {term.keys()[0] for term in terms if isinstance(term, _holding(gtsam))}


def _require_holds(gtsam: Any, terms: list[Any], values: Any, graph: PoseGraph) -> None:
    """Refuses a prior that is a measurement: that does more than to take away a freedom."""
    component = dict(zip(graph.ids.tolist(), graph.components()))
    ties = [component[node] for node in graph.position_nodes.tolist()]
    ties += [component[term.keys()[0]] for term in terms if isinstance(term, _holding(gtsam))]
    for i, term in enumerate(terms):
        if not isinstance(term, (gtsam.PriorFactorPose2, gtsam.PriorFactorPose3)):
            continue
        key = term.keys()[0]
        value = _pose(gtsam, _row(gtsam, values, key))
        exact = _largest_sigma(gtsam, term.noiseModel()) == 0
        if type(value) is not type(term.prior()) or not value.equals(term.prior(), _EQUAL):
            reason = "differs from the value of its node"
        elif _largest_sigma(gtsam, term.noiseModel()) > _TIGHT:
            reason = f"has standard deviations above {_TIGHT:g}"
        elif not exact and ties.count(component[key]) > 1:
            reason = "is not all that ties its component to the world"
        else:
            continue
        raise _core.ArgumentError(
            f"{_name(gtsam, i, term)}, {reason}: it is a measurement, and is not converted (an "
            "equality holds a node; factor_graph_from_gtsam takes measurements)")


def _largest_sigma(gtsam: Any, model: Any) -> float:
    """The largest standard deviation of a noise model in any direction."""
    import numpy as np

    if model is None or isinstance(model, gtsam.noiseModel.Robust):
        return float("inf")
    if model.isConstrained():
        return float(model.sigmas().max())
    root = np.array([model.whiten(unit) for unit in np.eye(model.dim())])
    smallest = float(np.linalg.svd(root, compute_uv=False).min())
    return 1 / smallest if smallest > 0 else float("inf")


def _gtsam() -> Any:
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


def _name(gtsam: Any, i: int, term: Any) -> str:
    """A factor in messages: its number, class and keys, as gtsam prints these."""
    keys = ", ".join(gtsam.DefaultKeyFormatter(key) for key in term.keys())
    return f"factors: factor {i}, a {type(term).__name__} of {keys}"


def _terms(gtsam: Any, factors: Any, values: Any) -> list[Any]:
    """The factors; ArgumentError for wrong keys and for an equality of another value."""
    known = set(values.keys())
    terms = [factors.at(i) for i in range(factors.size())]
    for i, term in enumerate(terms):
        if len(set(term.keys())) < len(term.keys()):
            raise _core.ArgumentError(f"{_name(gtsam, i, term)}, has a key twice")
        for key in term.keys():
            if key not in known:
                raise _core.ArgumentError(f"{_name(gtsam, i, term)}: there is no value of "
                                          f"{gtsam.DefaultKeyFormatter(key)}")
        if type(term).__name__.startswith("NonlinearEquality"):
            if not max(map(abs, term.unwhitenedError(values))) <= _EQUAL:
                raise _core.ArgumentError(
                    f"{_name(gtsam, i, term)}, differs from the value of its node")
    return terms


def _pose_noise(gtsam: Any, term: Any, name: str) -> tuple[NDArray[np.float64], RobustKernel]:
    """The information of an error of poses in the order of our tangent, and its kernel."""
    import numpy as np

    information, kernel = _noise(gtsam, term.noiseModel(), name)
    order = _ORDER["SE2" if information.shape[0] == 3 else "SE3"]
    return information[np.ix_(order, order)], kernel


def _lever_arm(gtsam: Any, term: Any) -> NDArray[np.float64] | None:
    """The lever arm of a measured position, which no method of gtsam tells."""
    if not isinstance(term, gtsam.GPSFactorArm):
        return None
    arm: NDArray[np.float64] = term.evaluateError(gtsam.Pose3()) + term.measurementIn()
    return arm


def _pose(gtsam: Any, row: NDArray[np.float64]) -> Any:
    if len(row) == 3:
        return gtsam.Pose2(*row)
    x, y, z, w = row[3:]
    return gtsam.Pose3(gtsam.Rot3.Quaternion(w, x, y, z), row[:3])


def _row(gtsam: Any, values: Any, key: int) -> NDArray[np.float64]:
    for read in (values.atPose3, values.atPose2):
        try:
            return _row_of(gtsam, read(key))
        except RuntimeError:  # of another kind
            continue
    raise _core.ArgumentError(
        f"values: the value of {gtsam.DefaultKeyFormatter(key)} is not a Pose2 or Pose3")


def _row_of(gtsam: Any, pose: Any) -> NDArray[np.float64]:
    import numpy as np

    if isinstance(pose, gtsam.Pose2):
        return np.array([pose.x(), pose.y(), pose.theta()])
    q = pose.rotation().toQuaternion()
    return np.array([*pose.translation(), q.x(), q.y(), q.z(), q.w()])


def _held(graph: PoseGraph) -> list[int]:
    """Ids of the fixed nodes and the first ones of components that nothing else holds."""
    ids = graph.ids.tolist()
    component = dict(zip(ids, graph.components()))
    fixed: list[int] = graph.fixed.tolist()
    held = {component[node] for node in fixed}
    held.update(component[node] for node in graph.position_nodes.tolist())
    for node in ids:
        if component[node] not in held:
            held.add(component[node])
            fixed.append(node)
    return fixed


def _model(gtsam: Any, information: NDArray[np.float64], kernel: RobustKernel) -> Any:
    model = gtsam.noiseModel.Gaussian.Information(information)
    if kernel.kind == "none":
        return model
    if kernel.kind not in _ESTIMATORS:
        raise _core.ArgumentError(f"graph: the kernel '{kernel.kind}' is not converted")
    estimator = getattr(gtsam.noiseModel.mEstimator, _ESTIMATORS[kernel.kind])
    return gtsam.noiseModel.Robust.Create(estimator.Create(kernel.width), model)


def _add_edges(gtsam: Any, graph: PoseGraph, factors: Any) -> None:
    import numpy as np

    kernels = graph.kernels
    between = gtsam.BetweenFactorPose2 if graph.kind == "SE2" else gtsam.BetweenFactorPose3
    inverse = np.argsort(_ORDER[graph.kind])
    rows = zip(graph.edge_constraints.tolist(), graph.edges.tolist(), graph.measurements,
               graph.information)
    for i, (begin, end), measurement, information in rows:
        model = _model(gtsam, information[np.ix_(inverse, inverse)], kernels[i])
        factors.add(between(begin, end, _pose(gtsam, measurement), model))


def _add_positions(gtsam: Any, graph: PoseGraph, factors: Any) -> None:
    nodes = graph.position_nodes.tolist()
    if nodes and graph.kind == "SE2":
        raise _core.ArgumentError("graph: measured positions in the plane are not converted")
    edges = set(graph.edge_constraints.tolist())
    kernels = [kernel for i, kernel in enumerate(graph.kernels) if i not in edges]
    rows = zip(nodes, graph.positions, graph.lever_arms, graph.position_information, kernels)
    for node, position, lever_arm, information, kernel in rows:
        model = _model(gtsam, information, kernel)
        if lever_arm.any():
            factors.add(gtsam.GPSFactorArm(node, position, lever_arm, model))
        else:
            factors.add(gtsam.GPSFactor(node, position, model))


def _noise(gtsam: Any, model: Any, name: str) -> tuple[NDArray[np.float64], RobustKernel]:
    """The information of a noise model, and its kernel."""
    import numpy as np

    kernel = RobustKernel()
    if isinstance(model, gtsam.noiseModel.Robust):
        estimator = model.robust()
        kind = type(estimator).__name__.lower()
        width = re.search(r"\(([^()]*)\)", repr(estimator))  # no method tells it
        if kind not in _ESTIMATORS or width is None:
            raise _core.ArgumentError(f"{name}: its robust estimator is not converted")
        kernel = RobustKernel(kind, float(width.group(1)))
        model = model.noise()
    if model is None or model.isConstrained():
        raise _core.ArgumentError(f"{name}: its noise model is constrained")
    root = np.array([model.whiten(unit) for unit in np.eye(model.dim())]).T
    return root.T @ root, kernel
