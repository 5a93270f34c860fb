"""Factor graphs: variables of several kinds, ready factors, and factors written in Python.

    graph = pg.FactorGraph()
    a = graph.add_variable(pg.SE3(), held=True)
    b = graph.add_variable(pg.SE3())
    graph.add(pg.Factor.distance(2.0, sigma_m=0.1), [a, b])
    graph.add_residual(lambda T_a, T_b: T_b.translation[:2], [a, b], sigma=0.5)
    report = pg.optimize_factors(graph)

A variable is a float, SE2, SE3, Sim3, SO3, three numbers, Line3, Plane3 or Marker.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from . import _core
from ._progress import ProgressArgument, counted, reporting
from .graphs import RobustKernel
from .options import given_or_default, kinds

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

Factor = _core.Factor
FactorGraph = _core.FactorGraph
FactorGraphReport = _core.FactorGraphReport
Line3 = _core.Line3
Marker = _core.Marker
Plane3 = _core.Plane3
SE2 = _core.SE2
SO3 = _core.SO3
Sim3 = _core.Sim3

Function = Callable[..., Any]


class FactorGraphOptions(kinds.FactorGraphOptions):
    """Options of `optimize_factors` and `FixedLagSmoother`."""

    __slots__ = ()
    _kind = _core.FactorGraphOptionSet


def optimize_factors(
    graph: FactorGraph,
    options: FactorGraphOptions | None = None,
    *,
    progress: ProgressArgument = None,
) -> FactorGraphReport:
    """Minimizes the cost of a factor graph, which stays as it is.

    `progress` counts steps, with their costs (see Progress). An exception of a factor written in
    Python ends the optimization and is raised here.
    """
    chosen = given_or_default(options, FactorGraphOptions)
    with reporting(progress, "optimize", "steps") as report:
        on_step = None if report is None else counted(report)
        return _core.optimize_factor_graph(graph, chosen._set, on_step)


class FixedLagSmoother:
    """Estimates the latest variables of a factor graph that grows without end.

    Every variable has a time, in any unit: seconds, or the number of its frame. `update` optimizes
    the window and then marginalizes the variables that are more than `lag` older than the latest
    one into a linear prior.
    """

    def __init__(self, lag: float, options: FactorGraphOptions | None = None) -> None:
        chosen = given_or_default(options, FactorGraphOptions)
        self._core = _core.FixedLagSmootherCore(lag, chosen._set)

    def add_variable(self, time: float, value: Any, held: bool = False) -> int:
        """Adds a variable and returns its number; numbers count from 0 and never repeat."""
        return self._core.add_variable(time, value, held)

    def add(
        self, factor: Factor, variables: Sequence[int], kernel: RobustKernel | None = None
    ) -> None:
        """Adds a factor of variables in the window, in the order that it takes."""
        self._core.add(factor, list(variables), kernel or RobustKernel())

    def add_residual(
        self,
        residual: Function,
        variables: Sequence[int],
        *,
        jacobian: Function | None = None,
        sigma: ArrayLike | None = None,
        information: ArrayLike | None = None,
        kernel: RobustKernel | None = None,
        name: str = "",
    ) -> None:
        """Adds a factor written in Python, see `Factor.custom`."""
        factor = Factor.custom(residual, [self.value(i) for i in variables], jacobian, sigma,
                               information, name)
        self.add(factor, variables, kernel)

    def touch(self, variable: int, time: float) -> None:
        """Gives a variable a later time, as for a landmark that is observed again."""
        self._core.touch(variable, time)

    def update(self) -> _core.FixedLagStep:
        """Optimizes the window and marginalizes what is too old."""
        return self._core.update()

    @property
    def variables(self) -> tuple[int, ...]:
        """Numbers of the variables in the window, ascending."""
        return self._core.variables

    def value(self, variable: int) -> Any:
        """The value of a variable in the window."""
        return self._core.value(variable)

    def covariance(self, variables: Sequence[int]) -> NDArray[np.float64]:
        """Joint covariance of the tangents of variables in the window, in their order."""
        import numpy as np

        return np.asarray(self._core.covariance(list(variables)))

    def window(self) -> FactorGraph:
        """A copy of the window: variables in the order of `variables`, and all terms."""
        return self._core.window()
