"""Pose graphs and their optimization."""

from __future__ import annotations

import operator
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, overload

from . import _core
from ._notebook import figure_html
from ._optional import optional
from ._progress import ProgressArgument, counted, reporting
from .options import IncrementalOptions, PoseGraphOptions, given_or_default

if TYPE_CHECKING:
    import networkx
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

PoseGraph = _core.PoseGraph
LandmarkGraph = _core.LandmarkGraph
PoseMarginals = _core.PoseMarginals
OptimizedGraph = _core.OptimizedGraph
OptimizedLandmarkGraph = _core.OptimizedLandmarkGraph
RobustKernel = _core.RobustKernel

_ROBUST = ("none", "huber", "dcs", "gnc", "pcm", "auto")


@overload
def optimize(graph: PoseGraph, *, robust: str | None = None, certify: bool = False,
             options: PoseGraphOptions | None = None,
             progress: ProgressArgument = None) -> OptimizedGraph: ...


@overload
def optimize(graph: LandmarkGraph, *, robust: str | None = None, certify: bool = False,
             options: PoseGraphOptions | None = None,
             progress: ProgressArgument = None) -> OptimizedLandmarkGraph: ...


def optimize(
    graph: PoseGraph | LandmarkGraph,
    *,
    robust: str | None = None,
    certify: bool = False,
    options: PoseGraphOptions | None = None,
    progress: ProgressArgument = None,
) -> OptimizedGraph | OptimizedLandmarkGraph:
    """Minimizes the sum of squared, whitened errors of a pose graph, which stays as it is.

    `robust`: the method against false loops ('auto' is recommended where there may be some), in
    place of `options.robust.method`; `certify`: also bounds how far the solution is from the global
    minimum of the isotropic chordal problem; `progress` counts steps, with their costs (see
    Progress). Warns with Doubt of
    what speaks against the result (`OptimizedGraph.doubts`); NoResult: there is no minimum. A
    LandmarkGraph takes no robust method and no certificate.
    """
    chosen = given_or_default(options, PoseGraphOptions)._set.copy()
    if robust is not None:
        if robust not in _ROBUST:
            names = ", ".join(_ROBUST)
            raise _core.ArgumentError(f"robust: one of {names} is needed, not {robust!r}")
        chosen.set("robust.method", robust)
    result: OptimizedGraph | OptimizedLandmarkGraph
    if certify and isinstance(graph, LandmarkGraph):
        raise _core.ArgumentError("certify: a graph with priors and points has no certificate")
    with reporting(progress, "optimize", "steps") as report:
        on_step = None if report is None else counted(report)
        if isinstance(graph, LandmarkGraph):
            result = _core.optimize_landmark_graph(graph, chosen, on_step)
        else:
            result = _core.optimize_pose_graph(graph, chosen, certify, on_step)
    for doubt in result.doubts:
        warnings.warn(f"graph: {doubt}", _core.Doubt, stacklevel=2)
    return result


def marginal_covariances(
    graph: PoseGraph | LandmarkGraph,
    nodes: Sequence[int] | None = None,
    *,
    rotation_error: str = "log",
) -> NDArray[np.float64]:
    """Covariances of the poses of an optimized graph, N x D x D, in their right tangents.

    `nodes`: their ids, else all nodes in the order of the graph. Held nodes have none (zeros). Use
    `PoseMarginals` for joint covariances, and those of relative poses and of points. NoResult: the
    constraints leave directions undetermined.
    """
    import numpy as np

    marginals = PoseMarginals(graph, rotation_error)
    if nodes is None:
        return np.asarray(marginals.covariances())
    result = np.array([marginals.covariance(node) for node in nodes])
    result.setflags(write=False)
    return result


class IncrementalOptimizer:
    """Keeps a pose graph optimized while nodes and constraints are added.

    The first node determines the group: SE(2), SE(3) or Sim(3). A node that no constraint connects
    to earlier ones starts a component at its own pose. Constraints are numbered in the order in
    which they are added. After Ctrl-C in a call that changes the graph, every call raises Error.
    """

    def __init__(
        self, options: IncrementalOptions | None = None, graph: PoseGraph | None = None
    ) -> None:
        self._core = _core.IncrementalOptimizerCore(
            given_or_default(options, IncrementalOptions)._set, graph
        )

    def add(self, added: PoseGraph) -> _core.IncrementalStep:
        """Adds nodes and constraints in one step.

        `added` holds the new ones alone, as `PoseGraph.add_node` and `add_edge` collect them; its
        constraints may join nodes that were added before.
        """
        return self._core.add(added)

    def reweight(self, constraints: ArrayLike, weights: ArrayLike) -> _core.IncrementalStep:
        """Gives constraints, by their numbers, new weights >= 0; 0 takes them out."""
        return self._core.reweight(constraints, weights)

    def remove_constraint(self, constraint: int) -> _core.IncrementalStep:
        """Sets the weight of a constraint to 0; `reweight` can undo this."""
        return self._core.remove_constraint(constraint)

    def finish(self) -> _core.IncrementalStep:
        """Iterates to the final accuracy."""
        return self._core.finish()

    @property
    def graph(self) -> PoseGraph:
        """A copy of the present graph: all nodes, and the constraints of positive weight."""
        return self._core.graph

    @property
    def poses(self) -> NDArray[np.float64]:
        """The present poses, one row each, in the order in which the nodes were added."""
        import numpy as np

        return np.asarray(self._core.graph.poses)

    def pose(self, node: int) -> _core.SE2 | _core.SE3 | _core.Sim3:
        """The present pose of a node as an SE2, SE3 or Sim3."""
        pose: _core.SE2 | _core.SE3 | _core.Sim3 = self._core.pose(node)
        return pose

    @property
    def constraints(self) -> int:
        """Number of constraints ever added, including those of weight 0."""
        return self._core.constraints

    @property
    def cost(self) -> float:
        """Sum of the robust squared errors."""
        return self._core.cost

    def covariance(self, ids: ArrayLike) -> NDArray[np.float64]:
        """Joint covariance of the tangents of nodes, in their order."""
        import numpy as np

        return np.asarray(self._core.covariance(ids))

    def relative_covariance(self, from_: int, to: int) -> NDArray[np.float64]:
        """Covariance of the pose T_from_to in its own right tangent."""
        import numpy as np

        return np.asarray(self._core.relative_covariance(from_, to))


def to_networkx(graph: PoseGraph) -> networkx.MultiDiGraph:
    """A pose graph as a networkx graph.

    Nodes are ids with "pose" and "fixed", edges have "measurement", "information" and "source". A
    measured position is one of the dictionaries in the attribute "positions" of its node. Kernels
    are left out.
    """
    if not isinstance(graph, PoseGraph):
        raise _core.ArgumentError(f"graph: a PoseGraph is needed, not {type(graph).__name__}")
    networkx = _networkx()
    result = networkx.MultiDiGraph()
    fixed = set(graph.fixed.tolist())
    for node, pose in zip(graph.ids.tolist(), graph.poses):
        result.add_node(node, pose=pose.copy(), fixed=node in fixed)
    rows = zip(graph.edges.tolist(), graph.measurements, graph.information, graph.sources)
    for (begin, end), measurement, information, source in rows:
        result.add_edge(begin, end, measurement=measurement.copy(),
                        information=information.copy(), source=source)
    measured = zip(graph.position_nodes.tolist(), graph.positions, graph.position_information,
                   graph.lever_arms)
    for node, position, information, lever_arm in measured:
        result.nodes[node].setdefault("positions", []).append(
            {"position": position.copy(), "information": information.copy(),
             "lever_arm": lever_arm.copy()})
    return result


def from_networkx(graph: networkx.MultiDiGraph) -> PoseGraph:
    """The pose graph of such a networkx graph.

    Its nodes are integers, and its edges have a direction: a measurement is the pose of the second
    node in the frame of the first.
    """
    if not isinstance(graph, _networkx().Graph):
        raise _core.ArgumentError(
            f"graph: a graph of networkx is needed, not {type(graph).__name__}")
    if not graph.is_directed():
        raise _core.ArgumentError("graph: its edges have no direction, a DiGraph or MultiDiGraph "
                                  f"is needed, not {type(graph).__name__}")
    result = PoseGraph()
    for node, data in graph.nodes(data=True):
        result.add_node(_id(node), _attribute(data, "pose", f"node {node}"),
                        bool(data.get("fixed", False)))
        for measured in data.get("positions", ()):
            result.add_position(_id(node), measured["position"], measured["information"],
                                measured.get("lever_arm"))
    for begin, end, data in graph.edges(data=True):
        name = f"edge {begin}, {end}"
        result.add_edge(_id(begin), _id(end), _attribute(data, "measurement", name),
                        _attribute(data, "information", name), data.get("source", "other"))
    result.check()
    return result


def _id(node: Any) -> int:
    try:
        return operator.index(node)
    except TypeError:
        raise _core.ArgumentError(f"graph: nodes must be integers, not {node!r}") from None


def _attribute(data: dict[str, Any], key: str, owner: str) -> Any:
    if key not in data:
        raise _core.ArgumentError(f"graph: {owner} has no attribute '{key}'")
    return data[key]


def _networkx() -> Any:
    return optional("networkx", "networkx")


def _graph_html(graph: PoseGraph) -> str:
    rows = [("nodes", str(len(graph))), ("edges", str(len(graph.edges)))]
    return figure_html(rows, _core.pose_graph_picture(graph) if len(graph) else "")


def _optimized_html(report: OptimizedGraph) -> str:
    rejected = [edge.constraint for edge in report.rejected]
    rows = [("nodes", str(len(report.graph))),
            ("chi2", f"{report.chi2_initial:.6g} -> {report.chi2_final:.6g}"),
            ("iterations", str(report.iterations)),
            ("rejected constraints", str(len(rejected)))]
    rows += [("doubt", doubt) for doubt in report.doubts]
    svg = _core.pose_graph_picture(report.graph, None, rejected) if len(report.graph) else ""
    return figure_html(rows, svg)


setattr(PoseGraph, "_repr_html_", _graph_html)
setattr(OptimizedGraph, "_repr_html_", _optimized_html)
