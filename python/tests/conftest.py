"""What the tests of the Python package share."""

import os
import pathlib
import subprocess

import pytest


@pytest.fixture(scope="session")
def research_data() -> pathlib.Path:
    """The folder of research data beside the repository; tests that need it skip without."""
    data = pathlib.Path(__file__).resolve().parents[3] / "shared" / "data"
    if not data.is_dir():
        pytest.skip(f"{data} is absent")
    return data


@pytest.fixture(scope="session")
def program() -> str:
    """The program placegraph: $PLACEGRAPH, or that of the release build."""
    built = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "placegraph"
    path = os.environ.get("PLACEGRAPH", str(built))
    if not os.access(path, os.X_OK):
        pytest.skip(f"{path} is absent")
    return path


@pytest.fixture(scope="session")
def drive(program: str, tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """A rendered stereo drive with ground truth and depth, of 70 frames."""
    out = tmp_path_factory.mktemp("drive") / "corridor"
    subprocess.run([program, "synth", "sequence", "corridor-loop", "--frames", "70", "--stereo",
                    "--size", "240x180", "--out", str(out)], check=True, capture_output=True)
    return out


@pytest.fixture(scope="session")
def run_folder(program: str, drive: pathlib.Path,
               tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """What the program writes of a run of that drive."""
    out = tmp_path_factory.mktemp("run") / "corridor-run"
    subprocess.run([program, "run", str(drive), "--out", str(out)], check=True,
                   capture_output=True)
    return out
