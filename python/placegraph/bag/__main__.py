"""python -m placegraph.bag BAG --out SEQUENCE"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from .. import _core
from .convert import convert_by_command
from .topics import Topics, list_topics


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m placegraph.bag",
        description="Write a bag of ROS 1 or 2 (SQLite, MCAP) as a sequence for placegraph.")
    parser.add_argument("bag", nargs="+", type=Path,
                        help="a bag: FILE.bag (several that follow each other), a folder of ROS 2, "
                        "FILE.mcap or FILE.db3")
    parser.add_argument("-o", "--out", type=Path, help="folder for the sequence")
    parser.add_argument("--list", action="store_true", help="print the topics and end")
    for name, text in (("image", "images of the left or only camera"),
                       ("right", "images of the right camera"), ("depth", "depth images"),
                       ("imu", "inertial measurements")):
        parser.add_argument(f"--{name}", default="", metavar="TOPIC",
                            help=f"topic of the {text}; none: left out")
    parser.add_argument("--truth", default="", metavar="TOPIC",
                        help="topic of the true poses, or tf:PARENT:CHILD; none: left out")
    parser.add_argument("--calib", type=Path, metavar="FILE",
                        help="calibration of the cameras, for bags without camera_info")
    parser.add_argument("--force", action="store_true", help="replace an existing sequence")
    return parser


def main(arguments: list[str] | None = None) -> int:
    """Runs the command; 0, or 2 for wrong arguments and bags that cannot be converted."""
    parser = _parser()
    given = parser.parse_args(arguments)
    if not given.list and given.out is None:
        parser.error("--out is needed, or --list")
    try:
        if given.list:
            for name, (msgtype, count) in list_topics(given.bag).items():
                print(f"{name}  {msgtype}  {count}")
            return 0
        topics = Topics(given.image, given.right, given.depth, given.imu, given.truth)
        result = convert_by_command(given.bag, given.out, topics, calibration=given.calib,
                                    force=given.force)
    except (_core.Error, ImportError, OSError) as error:
        print(f"{parser.prog}: {' '.join(str(error).split())}", file=sys.stderr)
        return 2
    for note in result.notes:
        print(f"note: {note}", file=sys.stderr)
    print(f"{result.path}: {result.frames} frames, {result.layout}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
