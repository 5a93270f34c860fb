"""Pose graphs as those of gtsam, and back, and its factors as factor graphs.

    factors, values = placegraph.gtsam.to_gtsam(graph)
    result = gtsam.LevenbergMarquardtOptimizer(factors, values).optimize()
    graph.set_poses(placegraph.gtsam.from_gtsam(factors, result).poses)

Both errors are logarithms on the right, so costs are equal: chi2 of a graph is twice the error of
its factors. gtsam 4.3 or later is needed, because the planar error of 4.2 is another one. Tangents
are [translation, rotation] here and [rotation, translation] in gtsam's Pose3. Similarities are not
converted. `factor_graph_from_gtsam` also takes priors that are measurements, ranges and landmarks,
and `factor_graph_to_gtsam` takes factors of every kind.
"""

from __future__ import annotations

from typing import Any

from . import _core
from ._gtsam_factors import factor_graph_from_gtsam, factor_graph_to_gtsam
from ._gtsam_terms import (
    EQUAL,
    ORDER,
    gtsam_module,
    largest_sigma,
    lever_arm_of,
    name_of,
    noise_model,
    noise_of,
    pose_noise_of,
    pose_of_row,
    row_of_pose,
    row_of_value,
    terms_of,
)
from .graphs import PoseGraph

__all__ = ["factor_graph_from_gtsam", "factor_graph_to_gtsam", "from_gtsam", "to_gtsam"]

_TIGHT = 1e-3  # largest standard deviation of a prior that holds its node [m, rad]


def to_gtsam(graph: PoseGraph, *, hold: bool = True) -> tuple[Any, Any]:
    """The factors of a pose graph (a gtsam.NonlinearFactorGraph), and its poses (gtsam.Values).

    Keys are the ids. Fixed nodes become equalities, and so does, with `hold`, the first node of
    every component without one, as `optimize` holds it. Raises ArgumentError for what gtsam has no
    factor for: similarities, measured positions in the plane, other kernels than Huber's, Cauchy's
    and Tukey's.
    """
    if not isinstance(graph, PoseGraph):
        raise _core.ArgumentError(f"graph: a PoseGraph is needed, not {type(graph).__name__}")
    gtsam = gtsam_module()
    kind = graph.kind
    if kind not in ORDER:
        raise _core.ArgumentError(f"graph: poses of {kind} are not converted")
    if graph.ids.size and graph.ids.min() < 0:
        raise _core.ArgumentError("graph: keys of gtsam are not negative, but there is a node "
                                  f"{graph.ids.min()}")
    values = gtsam.Values()
    poses = {node: pose_of_row(gtsam, row) for node, row in zip(graph.ids.tolist(), graph.poses)}
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
    gtsam = gtsam_module()
    graph = PoseGraph()
    terms = terms_of(gtsam, factors, values)
    fixed = _fixed(gtsam, terms)
    for key in sorted(values.keys()):
        row = row_of_value(gtsam, values, key)
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
            information, kernel = pose_noise_of(gtsam, term, name_of(gtsam, i, term))
            source = "odometry" if keys[1] == keys[0] + 1 else "loop"
            graph.add_edge(keys[0], keys[1], row_of_pose(gtsam, term.measured()), information, source,
                           kernel)
        elif isinstance(term, (gtsam.GPSFactor, gtsam.GPSFactorArm)):
            information, kernel = noise_of(gtsam, term.noiseModel(), name_of(gtsam, i, term))
            graph.add_position(keys[0], term.measurementIn(), information,
                               lever_arm_of(gtsam, term), kernel)
        else:
            raise _core.ArgumentError(f"{name_of(gtsam, i, term)}, is not converted")
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
        value = pose_of_row(gtsam, row_of_value(gtsam, values, key))
        exact = largest_sigma(gtsam, term.noiseModel()) == 0
        if type(value) is not type(term.prior()) or not value.equals(term.prior(), EQUAL):
            reason = "differs from the value of its node"
        elif largest_sigma(gtsam, term.noiseModel()) > _TIGHT:
            reason = f"has standard deviations above {_TIGHT:g}"
        elif not exact and ties.count(component[key]) > 1:
            reason = "is not all that ties its component to the world"
        else:
            continue
        raise _core.ArgumentError(
            f"{name_of(gtsam, i, term)}, {reason}: it is a measurement, and is not converted (an "
            "equality holds a node; factor_graph_from_gtsam takes measurements)")


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


def _add_edges(gtsam: Any, graph: PoseGraph, factors: Any) -> None:
    import numpy as np

    kernels = graph.kernels
    between = gtsam.BetweenFactorPose2 if graph.kind == "SE2" else gtsam.BetweenFactorPose3
    inverse = np.argsort(ORDER[graph.kind])
    rows = zip(graph.edge_constraints.tolist(), graph.edges.tolist(), graph.measurements,
               graph.information)
    for i, (begin, end), measurement, information in rows:
        model = noise_model(gtsam, information[np.ix_(inverse, inverse)], kernels[i])
        factors.add(between(begin, end, pose_of_row(gtsam, measurement), model))


def _add_positions(gtsam: Any, graph: PoseGraph, factors: Any) -> None:
    nodes = graph.position_nodes.tolist()
    if nodes and graph.kind == "SE2":
        raise _core.ArgumentError("graph: measured positions in the plane are not converted")
    edges = set(graph.edge_constraints.tolist())
    kernels = [kernel for i, kernel in enumerate(graph.kernels) if i not in edges]
    rows = zip(nodes, graph.positions, graph.lever_arms, graph.position_information, kernels)
    for node, position, lever_arm, information, kernel in rows:
        model = noise_model(gtsam, information, kernel)
        if lever_arm.any():
            factors.add(gtsam.GPSFactorArm(node, position, lever_arm, model))
        else:
            factors.add(gtsam.GPSFactor(node, position, model))
