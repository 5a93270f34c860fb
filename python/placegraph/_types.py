"""Types of arguments that several modules take."""

from __future__ import annotations

import os
from typing import Literal, TypeAlias, Union

from . import _core

Path: TypeAlias = Union[str, "os.PathLike[str]"]
SensorName: TypeAlias = Literal["mono", "stereo", "rgbd"]


def sensor_of(sensor: _core.Sensor | SensorName | None) -> _core.Sensor | None:
    """The sensor of a name; None as it is."""
    if sensor is None or isinstance(sensor, _core.Sensor):
        return sensor
    sensors = {each.name.lower(): each for each in _core.Sensor}
    if not isinstance(sensor, str) or sensor not in sensors:
        raise _core.ArgumentError(
            f"sensor: a Sensor or one of {', '.join(sensors)} is needed, not {sensor!r}")
    return sensors[sensor]
