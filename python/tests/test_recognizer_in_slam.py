"""A place recognizer written in Python finds the loops of Slam."""

from __future__ import annotations

import pathlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import placegraph as pg

World = pg.synthetic.World
Frames = list[pg.Frame]
Image = NDArray[np.uint8]
Answer = Callable[[int, int], Any]


class Thumbnails:
    """Correlation of shrunken images."""

    def __init__(self) -> None:
        self.stored: list[NDArray[np.float64]] = []
        self.asked: list[tuple[int, int]] = []
        self.cleared = 0

    def describe(self, image: Image) -> NDArray[np.float64]:
        height, width = image.shape[0] // 8 * 8, image.shape[1] // 8 * 8
        grey = image[:height, :width].reshape(height // 8, 8, width // 8, 8).mean((1, 3)).ravel()
        grey -= grey.mean()
        return np.asarray(grey / np.linalg.norm(grey))

    def clear(self) -> None:
        self.stored.clear()
        self.cleared += 1

    def add(self, image: Image) -> None:
        assert image.dtype == np.uint8 and image.shape == (180, 240) and not image.flags.writeable
        self.stored.append(self.describe(image))

    def query(self, image: Image, first: int, last: int) -> Any:
        assert 0 <= first <= last < len(self.stored)
        self.asked.append((first, last))
        scores = np.array(self.stored[first:last + 1]) @ self.describe(image)
        best = np.argsort(-scores)[:3]
        return [(first + i, scores[i]) for i in best if scores[i] > 0.8]


@pytest.fixture(scope="module")
def world() -> World:
    return pg.synthetic.World("corridor-loop", size=(240, 180))


@pytest.fixture(scope="module")
def loop(world: World) -> Frames:
    """Once around the corridors and on along the first one: every fourth frame."""
    return [world.frame(i, pg.Sensor.RGBD) for i in range(0, 564, 4)]


def drive(world: World, frames: Frames, gap: int = 40, **inputs: Any) -> pg.Slam:
    options = pg.SlamOptions()
    options.loops.min_frame_gap = gap
    slam = pg.Slam(world.calibration(pg.Sensor.RGBD), options, **inputs)
    for frame in frames:
        slam.add_frame(frame)
    return slam


def test_it_finds_the_loop(world: World, loop: Frames) -> None:
    recognizer = Thumbnails()
    loops: list[pg.LoopRecord] = []
    m = drive(world, loop, recognizer=recognizer, on_event=lambda e: loops.append(e)
              if isinstance(e, pg.LoopRecord) else None).finish()
    assert recognizer.cleared == 1
    assert len(recognizer.stored) == len(m.tables.keyframes["id"])
    accepted = [record for record in loops if record.accepted]
    assert len(accepted) >= 2 and recognizer.asked
    truth = world.ground_truth.poses
    for record in accepted:
        assert record.query_frame - record.match_frame > 400 and record.similarity > 0.8
        expected = np.linalg.inv(truth[record.match_frame]) @ truth[record.query_frame]
        assert np.linalg.norm(record.T_match_query.translation - expected[:3, 3]) < 0.1
    rows = m.loops
    assert rows.accepted.sum() == len(accepted)
    assert ((rows.similarity > 0.8) & (rows.similarity <= 1)).all()  # its own scores


def test_without_candidates_there_are_no_loops(world: World, loop: Frames) -> None:
    class Blind(Thumbnails):
        def query(self, image: Image, first: int, last: int) -> Any:
            return []

    recognizer = Blind()
    m = drive(world, loop[:12], gap=5, recognizer=recognizer).finish()
    assert len(m.loops) == 0 and m.trajectory().posed == 12 and len(recognizer.stored) > 5


def test_run_uses_it(tmp_path: pathlib.Path) -> None:
    dataset = pg.synthetic.render("corridor-loop", tmp_path / "drive", frames=12, size=(240, 180))
    recognizer = Thumbnails()
    result = pg.run(dataset, recognizer=recognizer)
    assert recognizer.cleared == 1
    assert len(recognizer.stored) == len(result.tables.keyframes["id"])


def test_a_function_from_an_image_to_a_vector_finds_the_loop(world: World, loop: Frames) -> None:
    loops: list[pg.LoopRecord] = []
    drive(world, loop, recognizer=Thumbnails().describe, on_event=lambda e: loops.append(e)
          if isinstance(e, pg.LoopRecord) else None).finish()
    accepted = [record for record in loops if record.accepted]
    assert len(accepted) >= 2
    for record in accepted:
        assert record.query_frame - record.match_frame > 400 and 0 < record.similarity <= 1


@pytest.mark.parametrize(
    "describe, text",
    [
        (lambda image: None, "recognizer: it must return a vector of numbers, not None"),
        (lambda image: "text", "recognizer: it must return a vector of numbers"),
        (lambda image: np.zeros((2, 2)), "recognizer: it must return a vector of numbers"),
        (lambda image: [], "the descriptor of image [0-9]+ is empty"),
        (lambda image: [1, float("nan")], "a value that is not finite"),
        (lambda image: [0, 0], "is zero"),
    ],
)
def test_what_is_no_vector_is_an_error(world: World, loop: Frames, describe: Any,
                                       text: str) -> None:
    slam = drive(world, [], gap=5, recognizer=describe)
    with pytest.raises(pg.ArgumentError, match=text):
        for frame in loop[:10]:
            slam.add_frame(frame)


def test_descriptors_of_a_file_are_those_of_the_frames(tmp_path: pathlib.Path) -> None:
    dataset = pg.synthetic.render("corridor-loop", tmp_path / "drive", frames=40, size=(240, 180))
    rows = np.random.default_rng(1).normal(size=(40, 8)).astype(np.float32)
    np.save(tmp_path / "rows.npy", rows)
    options = pg.RunOptions()
    options.loops.min_frame_gap = 5
    result = pg.run(dataset, options, recognizer=f"descriptors:{tmp_path / 'rows.npy'}")
    unit = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    assert len(result.loops) > 0
    for _, row in result.loops.iterrows():
        expected = unit[int(row.query_frame)] @ unit[int(row.match_frame)]
        assert abs(row.similarity - expected) < 1e-5
    np.save(tmp_path / "few.npy", rows[:3])
    with pytest.raises(pg.FileError, match="few.npy: has 3 rows, and none for image"):
        pg.run(dataset, options, recognizer=f"descriptors:{tmp_path / 'few.npy'}")


def test_no_options_name_a_recognizer(tmp_path: pathlib.Path) -> None:
    dataset = pg.synthetic.render("corridor-loop", tmp_path / "drive", frames=3, size=(240, 180))
    options = pg.RunOptions()
    options.describer.recognizer = f"exec:touch {tmp_path / 'marker'}"
    with pytest.raises(pg.ArgumentError, match="options: describer.recognizer 'exec:touch"):
        pg.run(dataset, options)
    assert not (tmp_path / "marker").exists()
    with pytest.raises(pg.ArgumentError, match="no-such-program cannot be started"):
        pg.run(dataset, recognizer="exec:no-such-program")


class Wrong(Thumbnails):
    def __init__(self, answer: Answer) -> None:
        super().__init__()
        self.answer = answer

    def query(self, image: Image, first: int, last: int) -> Any:
        return self.answer(first, last)


@pytest.mark.parametrize(
    "answer, error, text",
    [
        (lambda first, last: [(last + 1, 1.0)], pg.ArgumentError, "recognizer: query.* view"),
        (lambda first, last: [(-1, 1.0)], pg.ArgumentError, "view -1, which is not one of 0 to"),
        (lambda first, last: [(first, float("nan"))], pg.ArgumentError, "recognizer.*score nan"),
        (lambda first, last: [(first, 1.0), (first, 2.0)], pg.ArgumentError, "view 0 twice"),
        (lambda first, last: None, pg.ArgumentError, "recognizer: query must return a list"),
        (lambda first, last: 3, pg.ArgumentError, "recognizer: query must return a list"),
        (lambda first, last: [first], pg.ArgumentError, r"recognizer: .*pairs \(view, score\)"),
        (lambda first, last: [("a", "b")], pg.ArgumentError, r"recognizer: .*\(view, score\)"),
        (lambda first, last: [(2**40, 1.0)], pg.ArgumentError, r"recognizer: .*\(view, score\)"),
        (lambda first, last: 1 / 0, ZeroDivisionError, "division by zero"),
    ],
)
def test_a_wrong_answer_is_an_error(world: World, loop: Frames, answer: Answer,
                                    error: type[Exception], text: str) -> None:
    slam = drive(world, [], gap=5, recognizer=Wrong(answer))
    with pytest.raises(error, match=text):
        for frame in loop[:10]:
            slam.add_frame(frame)
    with pytest.raises(pg.ArgumentError, match="earlier call threw"):
        slam.finish()
