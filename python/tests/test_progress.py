"""Progress of the calls that last: functions, bars of tqdm, lines on stderr."""

import pathlib
import sys
import types
from collections.abc import Callable
from typing import Any

import pytest

import placegraph as pg
from graph_samples import ring
from placegraph import synthetic

Calls = dict[str, Callable[[Any], object]]


@pytest.fixture(scope="module")
def calls(tmp_path_factory: pytest.TempPathFactory) -> Calls:
    """Every function that has a progress, by its name."""
    folder = tmp_path_factory.mktemp("progress")

    def rendered(progress: Any) -> pg.Dataset:
        return synthetic.render("corridor-loop", folder / "drive", frames=80, size=(160, 120),
                                force=True, progress=progress)

    dataset = rendered(None)
    drive = pg.run(dataset)
    localizer = pg.Localizer(drive)
    images = [frame.image for frame in dataset.frames(stop=3)]
    factors = pg.FactorGraph()
    factors.add(pg.Factor.relative_pose(pg.SE3.exp([1, 0, 0, 0, 0, 0.1]), sigma=0.1),
                [factors.add_variable(pg.SE3(), True), factors.add_variable(pg.SE3())])
    graph = ring(noise=0.05)
    return {
        "render": rendered,
        "run": lambda progress: pg.run(dataset, progress=progress),
        "optimize": lambda progress: pg.optimize(graph, progress=progress),
        "landmarks": lambda progress: pg.optimize(pg.LandmarkGraph(graph), progress=progress),
        "factors": lambda progress: pg.optimize_factors(factors, progress=progress),
        "localize": lambda progress: localizer.localize_all(images, progress=progress),
    }


NAMES = ["render", "run", "optimize", "landmarks", "factors", "localize"]
TOTALS = {"render": 80, "run": 80, "localize": 3}


@pytest.mark.parametrize("name", NAMES)
def test_a_function_is_told_how_far_a_call_is(calls: Calls, name: str) -> None:
    told: list[pg.Progress] = []
    calls[name](told.append)
    done = [each.done for each in told]
    assert done == sorted(done) and done[-1] > 0
    assert {each.total for each in told} == {TOTALS.get(name)}
    if name in TOTALS:
        assert done[-1] == TOTALS[name]
    else:
        assert any("cost" in each.text for each in told)


@pytest.mark.parametrize("name", NAMES)
def test_an_exception_of_it_ends_the_call(calls: Calls, name: str) -> None:
    told: list[pg.Progress] = []

    def refuse(progress: pg.Progress) -> None:
        told.append(progress)
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        calls[name](refuse)
    assert len(told) == 1 or name == "render"  # frames that other threads render are told of, too
    with pytest.raises(pg.ArgumentError, match="progress: True, False or a function"):
        calls[name](3)


@pytest.mark.parametrize("name", NAMES)
def test_without_tqdm_it_is_a_line(calls: Calls, name: str, monkeypatch: pytest.MonkeyPatch,
                                   capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setitem(sys.modules, "tqdm", None)
    calls[name](None)
    calls[name](False)
    assert capsys.readouterr() == ("", "")
    calls[name](True)
    out, err = capsys.readouterr()
    last = err.split("\r")[-1]
    assert out == "" and err.startswith("\r") and err.count("\n") == 1 and last.endswith("\n")
    if name in TOTALS:
        assert f"{TOTALS[name]} of {TOTALS[name]}" in last
    else:
        assert "cost" in last or "chi2" in last


class Bar:
    """What is used of a bar of tqdm."""

    made: "list[Bar]" = []

    def __init__(self, *, desc: str, unit: str, file: object) -> None:
        self.n, self.desc, self.closed, self.texts = 0, desc, False, [""]
        self.total: int | None = None
        Bar.made.append(self)

    def set_postfix_str(self, text: str, refresh: bool) -> None:
        self.texts.append(text)

    def update(self, more: int) -> None:
        self.n += more

    def close(self) -> None:
        self.closed = True


@pytest.mark.parametrize("name", NAMES)
def test_with_tqdm_it_is_a_bar(calls: Calls, name: str, monkeypatch: pytest.MonkeyPatch,
                               capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setitem(sys.modules, "tqdm", types.SimpleNamespace(tqdm=Bar))
    monkeypatch.setattr(Bar, "made", [])
    calls[name](True)
    (bar,) = Bar.made
    assert bar.closed and bar.n > 0 and bar.total == TOTALS.get(name)
    assert name in TOTALS or "cost" in bar.texts[-1] or "cost" in "".join(bar.texts)
    assert capsys.readouterr() == ("", "")


def test_the_installed_tqdm_takes_it(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    pg.optimize(ring(noise=0.05), progress=True)
    assert "optimize" in capsys.readouterr().err


def test_a_line_is_told_of_frames_without_a_pose(tmp_path: pathlib.Path) -> None:
    told: list[pg.Progress] = []
    results: list[pg.FrameResult] = []
    dataset = synthetic.render("corridor-loop", tmp_path / "d", frames=10, size=(160, 120))
    pg.run(dataset, progress=told.append,
           on_frame=lambda done, total, result: results.append(result))
    assert [each.text for each in told] == [each.reason for each in results]
