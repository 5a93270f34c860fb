"""draw_folders.py ROOT [--check]: see scripts/draw_folders."""
import argparse
import os
import sys

from folder_graph import FolderGraph, figures
from folder_picture import draw

PICTURE = "docs/images/folders.svg"


def main():
    parser = argparse.ArgumentParser(prog="scripts/draw_folders")
    parser.add_argument("root", help=argparse.SUPPRESS)
    parser.add_argument("--check", action="store_true",
                        help="write nothing; exit 1 if the picture is not the one of the sources")
    arguments = parser.parse_args()
    graph = FolderGraph(arguments.root)
    print("\n".join(figures(graph)))
    picture = draw(graph)
    path = os.path.join(arguments.root, PICTURE)
    if arguments.check:
        committed = open(path, encoding="utf-8").read() if os.path.exists(path) else ""
        if committed != picture:
            print(f"{PICTURE}: not the picture of these sources; run scripts/draw_folders")
            return 1
        return 0
    with open(path, "w", encoding="utf-8", newline="\n") as out:
        out.write(picture)
    print(f"written: {PICTURE}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
