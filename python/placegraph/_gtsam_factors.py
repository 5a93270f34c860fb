"""Factor graphs as those of gtsam, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _core
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
    row_of_pose,
    row_of_value,
    terms_of,
)
from .factor_graph import SE2, SO3, Factor, FactorGraph
from .graphs import RobustKernel

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def factor_graph_from_gtsam(factors: Any, values: Any) -> tuple[FactorGraph, dict[int, int]]:
    """The factor graph of gtsam's factors and values, and the variable of each key.

    Values are Pose2, Pose3 and Point3. Equalities and priors of constrained noise hold a variable.
    Converted are also: PriorFactor and BetweenFactor of Pose2 and Pose3, GPSFactor, GPSFactorArm,
    RangeFactorPose2, RangeFactorPose3, and GenericProjectionFactorCal3_S2 without skew whose camera
    is the body. Raises ArgumentError, which names the factor and its keys, for any other.
    """
    gtsam = gtsam_module()
    terms = terms_of(gtsam, factors, values)
    graph, variables = FactorGraph(), {}
    held = {term.keys()[0] for term in terms if _is_equality(gtsam, term)}
    for key in sorted(values.keys()):
        variables[key] = graph.add_variable(_variable(gtsam, values, key), key in held)
    for i, term in enumerate(terms):
        name = name_of(gtsam, i, term)
        if _is_equality(gtsam, term):
            if hasattr(term, "prior") and not max(map(abs, term.unwhitenedError(values))) <= EQUAL:
                raise _core.ArgumentError(f"{name}, differs from the value of its node")
            continue
        factor, kernel = _factor(gtsam, term, name)
        graph.add(factor, [variables[key] for key in term.keys()], kernel)
    return graph, variables


def factor_graph_to_gtsam(graph: FactorGraph) -> tuple[Any, Any]:
    """The terms of a factor graph (a gtsam.NonlinearFactorGraph), and its variables (gtsam.Values).

    Keys are the numbers of the variables. SE2, SE3, SO3 and points become Pose2, Pose3, Rot3 and
    Point3, held ones with an equality; scalars become vectors of one entry, held ones with a prior
    of constrained noise. Every term is a gtsam.CustomFactor that evaluates ours with its
    derivatives, so that costs are equal and any factor is taken. Raises ArgumentError for variables
    of another kind, for other kernels than Huber's, Cauchy's and Tukey's, and, while gtsam
    evaluates them, for terms that have no residual.
    """
    import numpy as np

    if not isinstance(graph, FactorGraph):
        raise _core.ArgumentError(f"graph: a FactorGraph is needed, not {type(graph).__name__}")
    gtsam = gtsam_module()
    factors, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
    for key in range(len(graph)):
        value = _value(gtsam, graph, key)
        values.insert(key, value)
        if not graph.is_held(key):
            continue
        if graph.kind(key) == "scalar":
            factors.add(gtsam.PriorFactorVector(key, value, gtsam.noiseModel.Constrained.All(1)))
        else:
            kind = _KINDS[graph.kind(key)]
            factors.add(getattr(gtsam, f"NonlinearEquality{kind}")(key, value))
    for i in range(graph.terms):
        factor, variables, kernel = graph.term(i)
        model = noise_model(gtsam, np.eye(factor.residual_size), kernel)
        kinds = [graph.kind(variable) for variable in variables]
        factors.add(gtsam.CustomFactor(model, list(variables), _evaluation(i, factor, kinds)))
    return factors, values


# The classes of gtsam of our kinds of variables.
_KINDS = {"SE2": "Pose2", "SE3": "Pose3", "rotation": "Rot3", "point": "Point3", "scalar": "Vector"}


def _value(gtsam: Any, graph: FactorGraph, key: int) -> Any:
    """The value of a variable as gtsam has it."""
    import numpy as np

    value, kind = graph.value(key), graph.kind(key)
    if kind not in _KINDS:
        raise _core.ArgumentError(f"graph: variable {key} is a {kind}, which is not converted")
    if kind == "SE2":
        return gtsam.Pose2(*value.translation, value.angle)
    if kind == "SE3":
        return gtsam.Pose3(value.matrix())
    if kind == "rotation":
        return gtsam.Rot3(value.matrix())
    return np.atleast_1d(np.asarray(value, float))


def _own_value(values: Any, key: int, kind: str) -> Any:
    """The value of a key as our variable of a kind."""
    value = getattr(values, f"at{_KINDS[kind]}")(key)
    if kind == "SE2":
        return SE2(value.x(), value.y(), value.theta())
    if kind == "SE3":
        return _core.SE3(value.matrix())
    if kind == "rotation":
        return SO3(value.toQuaternion().coeffs())
    return float(value[0]) if kind == "scalar" else value


def _evaluation(i: int, factor: Factor, kinds: list[str]) -> Any:
    """The function of a gtsam.CustomFactor that evaluates one of ours."""
    def evaluate(this: Any, values: Any, jacobians: Any) -> NDArray[np.float64]:
        own = [_own_value(values, key, kind) for key, kind in zip(this.keys(), kinds)]
        residual = factor.residual(*own)
        if residual is None:
            raise _core.ArgumentError(f"graph: term {i} has no residual at these values")
        if jacobians is not None:
            derivatives = factor.jacobians(*own) or []
            for k, (kind, derivative) in enumerate(zip(kinds, derivatives)):
                jacobians[k] = derivative[:, ORDER[kind]] if kind == "SE3" else derivative
        return residual

    return evaluate


def _is_equality(gtsam: Any, term: Any) -> bool:
    """Whether a factor holds a variable where it is."""
    if isinstance(term, (gtsam.NonlinearEqualityPose2, gtsam.NonlinearEqualityPose3,
                         gtsam.NonlinearEqualityPoint3)):
        return True
    prior = isinstance(term, (gtsam.PriorFactorPose2, gtsam.PriorFactorPose3))
    return prior and largest_sigma(gtsam, term.noiseModel()) == 0


def _variable(gtsam: Any, values: Any, key: int) -> Any:
    try:
        return values.atPoint3(key)
    except RuntimeError:  # of another kind
        row = row_of_value(gtsam, values, key)
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
        information, kernel = pose_noise_of(gtsam, term, name)
        measured = _motion(row_of_pose(gtsam, term.measured()))
        return Factor.relative_pose(measured, information=information), kernel
    if isinstance(term, (gtsam.PriorFactorPose2, gtsam.PriorFactorPose3)):
        information, kernel = pose_noise_of(gtsam, term, name)
        measured = _motion(row_of_pose(gtsam, term.prior()))
        return Factor.pose_prior(measured, information=information), kernel
    information, kernel = (noise_of(gtsam, term.noiseModel(), name)
                           if hasattr(term, "noiseModel") else (np.eye(0), RobustKernel()))
    if isinstance(term, (gtsam.GPSFactor, gtsam.GPSFactorArm)):
        return Factor.position(term.measurementIn(), information=information,
                               lever_arm=lever_arm_of(gtsam, term)), kernel
    if isinstance(term, (gtsam.RangeFactorPose2, gtsam.RangeFactorPose3)):
        kind = "SE2" if isinstance(term, gtsam.RangeFactorPose2) else "SE3"
        return Factor.distance(term.measured(), float(information[0, 0] ** -0.5), kind), kernel
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
