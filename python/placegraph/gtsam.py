"""Pose graphs as those of gtsam, and back.

    factors, values = placegraph.gtsam.to_gtsam(graph)
    result = gtsam.LevenbergMarquardtOptimizer(factors, values).optimize()
    graph.set_poses(placegraph.gtsam.from_gtsam(factors, result).poses)

Both errors are logarithms on the right, so costs are equal: chi2 of a graph is twice the error of
its factors. Tangents are [translation, rotation] here and [rotation, translation] in gtsam's
Pose3. Similarities are not converted.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _core
from ._optional import optional
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
    measurement, which no constraint of a pose graph can express. Raises ArgumentError, which names
    the factor and the key, for such a prior and for a factor of another kind.
    """
    import numpy as np

    gtsam = _gtsam()
    graph = PoseGraph()
    terms = [factors.at(i) for i in range(factors.size())]
    fixed = _fixed(gtsam, terms)
    for key in sorted(values.keys()):
        graph.add_node(key, _row(gtsam, values, key), key in fixed)
    for i, term in enumerate(terms):
        if isinstance(term, _holding(gtsam)):
            continue
        keys = term.keys()
        if isinstance(term, (gtsam.BetweenFactorPose2, gtsam.BetweenFactorPose3)):
            information, kernel = _noise(gtsam, term.noiseModel(), f"factors: factor {i}")
            order = _ORDER["SE2" if information.shape[0] == 3 else "SE3"]
            source = "odometry" if keys[1] == keys[0] + 1 else "loop"
            graph.add_edge(keys[0], keys[1], _row_of(gtsam, term.measured()),
                           information[np.ix_(order, order)], source, kernel)
        elif isinstance(term, gtsam.GPSFactor):
            information, kernel = _noise(gtsam, term.noiseModel(), f"factors: factor {i}")
            graph.add_position(keys[0], term.measurementIn(), information, None, kernel)
        else:
            raise _core.ArgumentError(
                f"factors: factor {i}, a {type(term).__name__}, is not converted")
    graph.check()
    _require_holds(gtsam, terms, values, graph)
    return graph


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
        if type(value) is not type(term.prior()) or not value.equals(term.prior(), _EQUAL):
            reason = "differs from the value of its node"
        elif _largest_sigma(gtsam, term.noiseModel()) > _TIGHT:
            reason = f"has standard deviations above {_TIGHT:g}"
        elif ties.count(component[key]) > 1:
            reason = "is not all that ties its component to the world"
        else:
            continue
        raise _core.ArgumentError(
            f"factors: factor {i}, a {type(term).__name__} of {gtsam.DefaultKeyFormatter(key)}, "
            f"{reason}: it is a measurement, and is not converted (an equality holds a node)")


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
    return optional("gtsam", "gtsam")


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
    raise _core.ArgumentError(f"values: the value of {key} is not a Pose2 or Pose3")


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
    import re

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
