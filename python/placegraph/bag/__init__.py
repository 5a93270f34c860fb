"""ROS bags as sequences: `python -m placegraph.bag BAG --out SEQUENCE`.

Bags of ROS 1, and of ROS 2 as SQLite and MCAP, are read by the package rosbags. Images,
camera_info, inertial measurements and the true trajectory are written in the layout that fits,
which `open_dataset` and the program read.
"""

from .convert import Conversion, convert
from .topics import Topics, list_topics
from .trajectories import read_trajectory

__all__ = ["Conversion", "Topics", "convert", "list_topics", "read_trajectory"]
