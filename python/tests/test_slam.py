"""Slam and run: the same results by every way, callbacks, lifetimes, threads."""

from __future__ import annotations

import _thread
import gc
import pathlib
import shutil
import subprocess
import sys
import threading
import weakref
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from checks import assert_read_only, some, wrong
from numpy.typing import NDArray

import placegraph as pg

FRAMES = 40
World = pg.synthetic.World
Frames = list[pg.Frame]
Image = NDArray[np.uint8]


@pytest.fixture(scope="module")
def world() -> World:
    return pg.synthetic.World("corridor-loop", frames=FRAMES, size=(320, 240))


@pytest.fixture(scope="module")
def frames(world: World) -> Frames:
    return list(world.frames(pg.Sensor.RGBD))


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> pg.Dataset:
    folder = tmp_path_factory.mktemp("drive") / "sequence"
    return pg.synthetic.render("corridor-loop", folder, frames=FRAMES, size=(320, 240))


def rgbd(world: World, **inputs: Any) -> pg.Slam:
    return pg.Slam(world.calibration(pg.Sensor.RGBD), **inputs)


def bits(m: pg.Map) -> tuple[bytes, bytes]:
    return m.trajectory().poses.tobytes(), m.trajectory_online.poses.tobytes()


@pytest.fixture(scope="module")
def reference(world: World, frames: Frames) -> pg.Map:
    slam = rgbd(world)
    for frame in frames:
        slam.add_frame(frame)
    return slam.finish()


def test_run_gives_the_files_of_the_program(drive: pg.Dataset, program: str,
                                            tmp_path: pathlib.Path) -> None:
    out = tmp_path / "out"
    subprocess.run([program, "run", drive.path, "--out", out, "--quiet"], check=True)
    result = pg.run(drive, map_file=tmp_path / "map.db")
    result.trajectory().write(str(tmp_path / "optimized.tum"))
    result.trajectory_online.write(str(tmp_path / "online.tum"))
    for mine, theirs in [("optimized", "trajectory_optimized"), ("online", "trajectory_online")]:
        assert (tmp_path / f"{mine}.tum").read_bytes() == (out / f"{theirs}.tum").read_bytes()
    saved, written = pg.Map.open(str(tmp_path / "map.db")), pg.Map.open(str(out / "map.db"))
    assert np.array_equal(saved.landmarks, written.landmarks)
    assert saved.tables.keyframes["pose"].tobytes() == written.tables.keyframes["pose"].tobytes()
    said, meant = some(result.judgement), some(written.judgement)
    assert some(saved.judgement).verdict == meant.verdict
    assert said.verdict == meant.verdict and said.why_metric == meant.why_metric
    assert said.expected_drift_m == meant.expected_drift_m
    assert [note.text for note in said.findings] == [note.text for note in meant.findings]


def test_frames_and_arrays_give_the_same(world: World, frames: Frames, reference: pg.Map) -> None:
    slam = rgbd(world)
    image, depth = np.empty((240, 320), np.uint8), np.empty((240, 320), np.float32)
    for frame in frames:
        image[:] = frame.image
        depth[:] = some(frame.depth)
        result = slam.add_frame(image, frame.stamp_ns / 1e9, depth=depth)
        assert result.frame == frame.id
        image.fill(255)  # arrays are copied: the caller may use them again
        depth.fill(np.nan)
    assert bits(slam.finish()) == bits(reference)


def test_the_poses_are_those_of_the_world(world: World, reference: pg.Map) -> None:
    truth = world.ground_truth.poses[:, :3, 3]
    error = np.linalg.norm(reference.trajectory().poses[:, :3, 3] - truth, axis=1)
    assert error.max() < 0.05 and world.ground_truth.path_length > 1
    assert some(reference.judgement).verdict == "good" and reference.metric


def test_images_of_frames_are_views_that_live_on(world: World) -> None:
    frame = world.frame(0)
    image = frame.image
    copy = image.copy()
    assert not image.flags.owndata and not image.flags.writeable
    assert np.shares_memory(image, frame.image)
    del frame
    gc.collect()
    assert np.array_equal(image, copy)


def test_events_come_in_their_order(world: World, frames: Frames) -> None:
    events: list[pg.Event] = []
    slam = rgbd(world, on_event=events.append)
    results = [slam.add_frame(frame) for frame in frames]
    slam.finish()
    told = [e for e in events if isinstance(e, pg.FrameResult)]
    assert [e.frame for e in told] == list(range(FRAMES))
    assert [e.T_map_cam is None for e in told] == [r.T_map_cam is None for r in results]
    keyframes = [e.keyframe for e in events if isinstance(e, pg.KeyframeAdded)]
    assert len(keyframes) > 3 and keyframes == sorted(keyframes)
    assert any(r.keyframe for r in results)
    first = events.index(next(e for e in events if isinstance(e, pg.PlaceAdded)))
    assert isinstance(events[first - 1], pg.KeyframeAdded)
    match events[first]:
        case pg.PlaceAdded(place=place, anchor=anchor):
            assert place == 0 and anchor == keyframes[0]
    assert repr(events[first]) == "PlaceAdded(place=0, anchor=0, component=0)"


def test_moves_name_the_places_and_their_poses(drive: pg.Dataset) -> None:
    moves: list[pg.MapMoved] = []
    places: dict[int, NDArray[np.float64]] = {}
    began = 0

    def listen(event: pg.Event) -> None:
        nonlocal began
        match event:
            case pg.RunBegan():
                began += 1
            case pg.PlaceAdded():
                places[event.place] = event.T_map_place.matrix()
            case pg.MapMoved():
                moves.append(event)

    pg.run(drive, on_event=listen)
    assert began == 1 and places
    for move in moves:
        assert len(move.poses) == move.places
        for pose in move.poses.values():
            assert np.isclose(np.cbrt(np.linalg.det(pose[:3, :3])), 1)


class Special(Exception):
    pass


def fail(*_: object) -> None:
    raise Special("from the callback")


def test_an_exception_of_a_callback_ends_slam(world: World, frames: Frames) -> None:
    slam = rgbd(world, on_event=fail)
    with pytest.raises(Special, match="from the callback"):
        slam.add_frame(frames[0])
    with pytest.raises(pg.ArgumentError, match="earlier call threw"):
        slam.add_frame(frames[1])
    with pytest.raises(pg.ArgumentError, match="earlier call threw"):
        slam.finish()


@pytest.mark.parametrize("name", ["on_event", "on_frame", "stop"])
def test_an_exception_of_a_callback_ends_run(drive: pg.Dataset, name: str) -> None:
    with pytest.raises(Special, match="from the callback"):
        pg.run(drive, **wrong({name: fail}))


def test_a_loss_is_told(world: World, frames: Frames) -> None:
    """The log tells that a new component begins; an exception of its function is raised."""
    black = np.zeros_like(frames[0].image)

    def lose(log: Callable[[str, str], object]) -> None:
        slam = rgbd(world, on_log=log)
        for i, frame in enumerate(frames[:10]):
            slam.add_frame(frame)
        results = [slam.add_frame(black, 10 + 0.1 * i, depth=frames[0].depth) for i in range(5)]
        assert all(r.state == pg.TrackingState.LOST and not r.ok and r.reason for r in results[1:])
        for i, frame in enumerate(frames[::-1]):
            slam.add_frame(frame.image, 20 + 0.1 * i, depth=frame.depth)

    messages: list[tuple[str, str]] = []
    lose(lambda level, text: messages.append((level, text)))
    assert messages and {level for level, _ in messages} <= {"debug", "info", "warning"}
    assert any("frame" in text for _, text in messages)
    with pytest.raises(Special, match="from the callback"):
        lose(fail)


def test_callbacks_must_not_call_slam(world: World, frames: Frames) -> None:
    caught: list[object] = []

    def listen(_: object) -> None:
        for call in (slam.snapshot, slam.finish, slam.view, lambda: slam.add_frame(frames[5])):
            with pytest.raises(pg.ArgumentError, match="during another call"):
                call()
            caught.append(call)

    slam = rgbd(world, on_event=listen)
    slam.add_frame(frames[0])
    assert len(caught) >= 4
    assert slam.snapshot().trajectory_online.posed == 1


def test_a_wrong_frame_is_ignored(world: World, frames: Frames, reference: pg.Map) -> None:
    slam = rgbd(world)
    for frame in frames:
        slam.add_frame(frame)
        with pytest.raises(pg.ArgumentError, match="must increase"):
            slam.add_frame(frame)
    assert bits(slam.finish()) == bits(reference)
    with pytest.raises(pg.ArgumentError, match="after finish"):
        slam.add_frame(frames[0])
    with pytest.raises(pg.ArgumentError, match="called twice"):
        slam.finish()


def test_cycles_through_callbacks_are_collected(world: World, frames: Frames) -> None:
    class Listener:
        def __init__(self) -> None:
            self.slam = rgbd(world, on_event=self.listen, on_log=self.listen, recognizer=self)

        def listen(self, *_: object) -> None:
            pass

        def clear(self) -> None:
            pass

        def add(self, image: Image) -> None:
            pass

        def query(self, image: Image, first: int, last: int) -> list[tuple[int, float]]:
            return []

    listener = Listener()
    listener.slam.add_frame(frames[0])
    gone = weakref.ref(listener)
    del listener
    gc.collect()
    assert gone() is None


def test_the_view_shows_the_tracks_of_the_last_frame(world: World, frames: Frames) -> None:
    slam = rgbd(world)
    for frame in frames[:10]:
        slam.add_frame(frame)
    view = slam.view()
    assert_read_only(view)
    assert len(view) > 50 and view.px.shape == (len(view), 2)
    assert len(set(view.track_ids.tolist())) == len(view)
    assert (view.px >= -0.5).all() and (view.px < [319.5, 239.5]).all()
    known = ~np.isnan(view.points_cam[:, 2])
    assert known.sum() > 20
    c = world.calibration(pg.Sensor.RGBD).camera
    p = view.points_cam[known]
    projected = p[:, :2] / p[:, 2:] * [c.fx, c.fy] + [c.cx, c.cy]
    assert np.allclose(projected, view.px_projected[known], atol=1e-6)
    assert np.median(np.linalg.norm(projected - view.px[known], axis=1)) < 1
    px = view.px
    copy = px.copy()
    assert not px.flags.owndata and not px.flags.writeable
    del view, slam
    gc.collect()
    assert np.array_equal(px, copy)


def test_snapshots_are_copies(world: World, frames: Frames) -> None:
    slam = rgbd(world)
    for frame in frames[:10]:
        slam.add_frame(frame)
    early = slam.snapshot()
    before = bits(early)
    for frame in frames[10:]:
        slam.add_frame(frame)
    assert bits(early) == before and early.trajectory_online.posed == 10
    assert slam.snapshot().trajectory_online.posed == FRAMES
    assert sum(calls for _, calls in slam.stages().values()) > FRAMES
    assert slam.notes() == [] and slam.overlay_mask() is None
    assert slam.lens().k1 == pytest.approx(0, abs=0.05)


def test_two_in_two_threads_give_what_each_gives_alone(world: World, frames: Frames,
                                                       reference: pg.Map) -> None:
    maps: dict[str, pg.Map] = {}

    def work(name: str) -> None:
        slam = rgbd(world)
        for frame in frames:
            slam.add_frame(frame)
        maps[name] = slam.finish()

    threads = [threading.Thread(target=work, args=(name,)) for name in ("first", "second")]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert bits(maps["first"]) == bits(reference) and bits(maps["second"]) == bits(reference)


def test_calls_from_two_threads_at_once_are_refused(world: World, frames: Frames) -> None:
    """The second call raises, and the first one is not disturbed."""
    inside, go_on = threading.Event(), threading.Event()
    results: list[pg.FrameResult] = []

    def listen(event: pg.Event) -> None:
        inside.set()
        go_on.wait()

    slam = rgbd(world, on_event=listen)
    thread = threading.Thread(target=lambda: results.append(slam.add_frame(frames[0])))
    thread.start()
    inside.wait()
    for call in (slam.notes, slam.finish, lambda: slam.add_frame(frames[1])):
        with pytest.raises(pg.ArgumentError, match="during another call"):
            call()
    go_on.set()
    thread.join()
    assert results[0].T_map_cam is not None
    assert slam.add_frame(frames[1]).frame == 1


def test_stop_and_resume(drive: pg.Dataset, tmp_path: pathlib.Path) -> None:
    path = tmp_path / "map.db"
    seen: list[int] = []
    first = pg.run(drive, map_file=path, on_frame=lambda done, total, r: seen.append(done),
                   stop=lambda: len(seen) == 25)
    assert first.stopped and first.trajectory_online.posed == 25 and seen == list(range(1, 26))
    rest = pg.run(drive, map_file=path, resume=True)
    assert not rest.stopped and 0 < some(rest.resumed_at) <= 25
    assert rest.trajectory().posed == FRAMES
    again = pg.run(drive, map_file=path, resume=True)  # it is finished
    assert bits(again) == bits(rest)
    # The same by Slam, which reads the frames itself.
    seen.clear()
    pg.run(drive, map_file=path, on_frame=lambda done, total, r: seen.append(done),
           stop=lambda: len(seen) == 25)
    saved = pg.Map.open(str(path))
    last = int(saved.tables.keyframes["frame"][-1])
    slam = pg.Slam(drive.calibration())
    slam.resume(saved, drive.frame(last))
    for frame in drive.frames(start=last + 1):
        slam.add_frame(frame)
    assert bits(slam.finish()) == bits(rest)


def test_ctrl_c_ends_run(drive: pg.Dataset) -> None:
    frames = 0

    def interrupt() -> None:
        _thread.interrupt_main()

    def count(done: int, total: int, result: pg.FrameResult) -> None:
        nonlocal frames
        frames = done
        if done == 5:
            timer = threading.Thread(target=interrupt)
            timer.start()
            timer.join()

    with pytest.raises(KeyboardInterrupt):
        pg.run(drive, on_frame=count)
    assert frames in (5, 6)


def test_run_result_tells_of_the_run(drive: pg.Dataset) -> None:
    result = pg.run(drive.path)
    assert_read_only(result)
    assert result.sensor == pg.Sensor.RGBD and result.lens_k1 == 0
    assert result.broken_off is None and not result.stopped and result.resumed_at is None
    assert result.unposed == () and "reading" in result.stages
    assert isinstance(result, pg.Map) and result.trajectory().posed == FRAMES


def test_an_unreadable_frame_breaks_off(drive: pg.Dataset, tmp_path: pathlib.Path) -> None:
    folder = tmp_path / "broken"
    shutil.copytree(drive.path, folder)
    (folder / "image_0" / "000020.png").write_bytes(b"no image")
    result = pg.run(folder)
    assert "000020.png" in some(result.broken_off) and result.trajectory_online.posed == 20


def test_measured_motion_gives_the_scale(world: World) -> None:
    frames = list(world.frames(pg.Sensor.MONO))
    truth = world.ground_truth
    motion = pg.MeasuredMotion(truth)
    T, covariance = some(motion.between(int(truth.stamps_ns[3]), int(truth.stamps_ns[9])))
    expected = np.linalg.inv(truth.poses[3]) @ truth.poses[9]
    assert np.allclose(T.matrix(), expected, atol=1e-9)
    assert np.allclose(covariance, covariance.T) and (np.linalg.eigvalsh(covariance) > 0).all()
    assert motion.between(int(truth.stamps_ns[9]), int(truth.stamps_ns[3])) is None
    stamps = truth.stamps_ns
    steps = np.linalg.inv(truth.poses[:-1]) @ truth.poses[1:]
    same = pg.MeasuredMotion.from_arrays(stamps[:-1], stamps[1:], steps,
                                         np.tile(1e-4 * np.eye(6), (len(steps), 1, 1)))
    assert len(same) == len(motion) == FRAMES - 1
    shifted = motion.seen_from(pg.SE3())
    assert len(shifted) == len(motion)
    calibration = pg.Calibration(world.calibration(pg.Sensor.MONO).camera)
    for measured in (motion, same):
        slam = pg.Slam(calibration, motion=measured)
        for frame in frames:
            slam.add_frame(frame)
        m = slam.finish()
        assert m.metric and m.trajectory().path_length == pytest.approx(truth.path_length, rel=0.1)


def test_many_frames_keep_no_references(world: World, frames: Frames) -> None:
    """Arrays and results are let go; python/bench/many_frames.py measures the memory."""
    slam = rgbd(world)
    image, depth = frames[0].image.copy(), some(frames[0].depth).copy()
    counts = (0, 0, 0)
    for i in range(300):
        slam.add_frame(image, i * 0.1, depth=depth)
        if i == 100:
            gc.collect()
            counts = sys.getrefcount(image), sys.getrefcount(depth), len(gc.get_objects())
    gc.collect()
    assert (sys.getrefcount(image), sys.getrefcount(depth)) == counts[:2]
    assert abs(len(gc.get_objects()) - counts[2]) < 50


def test_images_are_localized_in_the_map_of_frames(frames: Frames, reference: pg.Map) -> None:
    assert reference.localize(frames[-1]).placed
