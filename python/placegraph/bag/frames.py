"""The tree of coordinate frames of a bag."""

from __future__ import annotations

from collections import deque
from typing import Any

import numpy as np

from .messages import Matrix, matrix_of


class FrameTree:
    """Fixed transforms between named frames."""

    def __init__(self) -> None:
        self._edges: dict[str, dict[str, Matrix]] = {}

    def add(self, message: Any, topic: str) -> None:
        """Takes a TransformStamped message; the first one of two frames counts."""
        parent, child = message.header.frame_id.strip("/"), message.child_frame_id.strip("/")
        T = matrix_of(message.transform.translation, message.transform.rotation, topic)
        self._edges.setdefault(parent, {}).setdefault(child, T)
        self._edges.setdefault(child, {}).setdefault(parent, np.asarray(np.linalg.inv(T)))

    def transform(self, parent: str, child: str) -> Matrix | None:
        """T_parent_child; None if no chain of transforms joins the frames."""
        found = {parent: np.eye(4)}
        queue = deque([parent])
        while queue and child not in found:
            here = queue.popleft()
            for there, T in self._edges.get(here, {}).items():
                if there not in found:
                    found[there] = found[here] @ T
                    queue.append(there)
        return found.get(child)
