"""Maps: their parts against the files that the program writes, and localization in them."""

from __future__ import annotations

import gc
import json
import pathlib
from collections.abc import Iterator

import numpy as np
import pytest

import placegraph as pg
from checks import assert_read_only


@pytest.fixture(scope="module")
def opened(run_folder: pathlib.Path) -> pg.Map:
    return pg.Map.open(run_folder)


def test_trajectories_are_those_of_the_program(opened: pg.Map, run_folder: pathlib.Path) -> None:
    for name, trajectory in (("optimized", opened.trajectory()),
                             ("online", opened.trajectory_online)):
        written = pg.Trajectory.read(str(run_folder / f"trajectory_{name}.kitti"))
        np.testing.assert_allclose(trajectory.poses, written.poses, atol=1e-8)
    main = opened.components.set_index("main").loc[True]
    assert np.array_equal(opened.trajectory(int(main["number"])).poses, opened.trajectory().poses)
    assert main["posed"] == opened.trajectory().posed


def test_online_trajectory_outlives_its_map(run_folder: pathlib.Path) -> None:
    trajectory = pg.Map.open(run_folder).trajectory_online
    poses = trajectory.poses.copy()
    gc.collect()
    assert np.array_equal(trajectory.poses, poses, equal_nan=True)


def test_arrays_of_a_map_cannot_be_written_to(opened: pg.Map) -> None:
    assert_read_only(opened)
    assert len(opened.landmarks) > 0
    for key, column in opened.tables.landmarks.items():
        assert not isinstance(column, np.ndarray) or not column.flags.writeable, key


def test_places_are_those_of_the_program(opened: pg.Map, run_folder: pathlib.Path) -> None:
    written = json.loads((run_folder / "places.json").read_text())
    places = opened.places
    assert list(places.nodes) == [place["id"] for place in written["places"]]
    for place in written["places"]:
        node = places.nodes[place["id"]]
        assert node["anchor_keyframe"] == place["anchor_keyframe"]
        assert node["keyframes"] == [member["keyframe"] for member in place["members"]]
    pairs = {frozenset((edge["from"], edge["to"])) for edge in written["edges"]}
    assert {frozenset(edge) for edge in places.edges} == pairs


def test_keyframes_stand_on_the_trajectory(opened: pg.Map) -> None:
    table = opened.tables.keyframes
    frames = opened.tables.frames["frame"].tolist()
    poses = opened.trajectory().poses[[frames.index(frame) for frame in table["frame"]]]
    np.testing.assert_allclose(table["pose"], poses, atol=1e-9)
    assert opened.keyframes["stamp_ns"].is_monotonic_increasing


def test_landmarks_are_seen_where_they_are_projected(opened: pg.Map) -> None:
    calibration = opened.calibration
    assert calibration is not None
    landmarks, keyframes = opened.tables.landmarks, opened.tables.keyframes
    position_of = dict(zip(landmarks["id"].tolist(), landmarks["position"]))
    pose_of = dict(zip(keyframes["id"].tolist(), keyframes["pose"]))
    seen = opened.tables.observations
    errors = []
    K = np.asarray(calibration.camera.K())
    for keyframe, landmark, px, camera in zip(seen["keyframe"].tolist(), seen["landmark"].tolist(),
                                              seen["px"], seen["camera"].tolist()):
        if landmark in position_of and camera == 0:
            T = np.linalg.inv(pose_of[keyframe])
            p = K @ (T[:3, :3] @ position_of[landmark] + T[:3, 3])
            errors.append(np.hypot(*(p[:2] / p[2] - px)))
    assert len(errors) > 200
    assert np.median(errors) < 1.0


def test_covariances_are_symmetric_and_positive(opened: pg.Map) -> None:
    table = opened.tables.landmarks
    known = np.isfinite(table["covariance"][:, 0, 0])
    covariance = table["covariance"][known]
    assert len(covariance) > 100
    np.testing.assert_allclose(covariance, covariance.transpose(0, 2, 1), rtol=1e-6)
    assert (np.linalg.eigvalsh(covariance) > 0).all()
    assert opened.landmarks.shape == (len(table["id"]), 3)
    assert table["rgb"].dtype == np.uint8


def test_loops_are_those_of_the_program(opened: pg.Map, run_folder: pathlib.Path) -> None:
    import pandas

    written = pandas.read_csv(run_folder / "loops.csv")
    assert len(written) > 0
    for theirs, ours in (("query", "query_frame"), ("match", "match_frame"), ("stage", "stage"),
                         ("inliers", "inliers"), ("accepted", "accepted")):
        assert written[theirs].tolist() == opened.loops[ours].tolist()
    assert opened.loops["probability"].tolist() == pytest.approx(written["probability"], rel=1e-5)
    refused = opened.explain(int(written["query"][0])).refused
    assert int(written["match"][0]) in [loop.match_frame for loop in refused]


def test_explanation(opened: pg.Map) -> None:
    explanation = opened.explain(35)
    assert_read_only(explanation)
    assert explanation.frame == 35 and explanation.posed
    assert explanation.T_map_cam is not None
    np.testing.assert_allclose(explanation.T_map_cam.matrix(), opened.trajectory().poses[35],
                               atol=1e-12)
    assert explanation.place in opened.places
    assert explanation.keyframe in opened.keyframes["id"].tolist()
    assert explanation.inliers == opened.frames["inliers"][35]
    assert explanation.covariance is not None
    assert (np.linalg.eigvalsh(explanation.covariance) > -1e-12).all()
    assert "frame 35" in repr(explanation)


def test_judgement(opened: pg.Map, run_folder: pathlib.Path) -> None:
    written = json.loads((run_folder / "result.json").read_text())["judgement"]
    judgement = opened.judgement
    assert judgement is not None
    assert judgement.verdict == written["verdict"]
    assert judgement.metric == written["metric"] == opened.metric
    assert [finding.text for finding in judgement.findings] == [
        finding["text"] for finding in written["findings"]]


def test_saved_map_is_the_same(opened: pg.Map, tmp_path: pathlib.Path) -> None:
    opened.save(tmp_path / "copy.db")
    copy = pg.Map.open(tmp_path / "copy.db")
    assert np.array_equal(copy.trajectory().poses, opened.trajectory().poses)
    assert np.array_equal(copy.landmarks, opened.landmarks)
    assert copy.options.to_yaml() == opened.options.to_yaml()
    assert copy.path == str(tmp_path / "copy.db")


def test_features_and_thumbnails(opened: pg.Map) -> None:
    keyframe = int(opened.tables.keyframes["id"][0])
    features = opened.tables.features(keyframe)
    assert features["descriptor"].shape == (len(features["px"]), 32)
    assert len(features["px"]) == opened.explain(0).features
    picture = opened.tables.thumbnail(keyframe)
    assert picture is not None and picture.startswith(b"\xff\xd8")


def test_exports_are_those_of_the_program(opened: pg.Map, run_folder: pathlib.Path, program: str,
                                          tmp_path: pathlib.Path) -> None:
    import subprocess

    forms = {"ply": "a.ply", "tum": "a.tum", "gltf": "a.glb", "graphml": "a.graphml"}
    opened.export(ply=tmp_path / "a.ply", tum=tmp_path / "a.tum", gltf=tmp_path / "a.glb",
                  graphml=tmp_path / "a.graphml")
    other = tmp_path / "program"
    other.mkdir()
    flags = [part for form, name in forms.items() for part in (f"--{form}", str(other / name))]
    subprocess.run([program, "map", "export", str(run_folder), *flags], check=True,
                   capture_output=True)
    for name in forms.values():
        assert (tmp_path / name).read_bytes() == (other / name).read_bytes(), name
    assert set(forms) < set(pg.Map.export_forms())


def test_images_of_the_drive_are_localized(opened: pg.Map, drive: pathlib.Path) -> None:
    dataset = pg.open_dataset(str(drive))
    frames = [dataset.frame(i, pg.Sensor.STEREO) for i in range(0, 70, 7)]
    localizer = pg.Localizer(opened)
    truth = opened.trajectory().poses[::7]
    posed = 0
    for frame, at, pose in zip(frames, localizer.localize_all(frames), truth):
        assert at.stage != "" and 0 <= at.probability <= 1
        if at.T_map_cam is not None:
            posed += 1
            assert np.linalg.norm(at.T_map_cam.translation - pose[:3, 3]) < 0.1
    assert posed > 0
    blank = opened.localize(np.zeros_like(frames[0].image))
    assert not blank.placed and blank.T_map_cam is None
    assert blank.stage in repr(blank)


def test_images_are_localized_as_they_come(opened: pg.Map, drive: pathlib.Path) -> None:
    frames = list(pg.open_dataset(str(drive)).frames())[:40]
    localizer = pg.Localizer(opened)
    taken: list[int] = []

    def stream(end: int) -> Iterator[pg.Frame]:
        for frame in frames:
            if frame.id == end:
                raise KeyboardInterrupt
            taken.append(frame.id)
            yield frame

    results = localizer.localize_all(stream(-1))
    assert taken == list(range(40))
    for index in (0, 33, 39):  # the same bits as alone
        assert results[index].probability == localizer.localize(frames[index]).probability
        assert results[index].keyframe == localizer.localize(frames[index]).keyframe
    taken.clear()
    with pytest.raises(KeyboardInterrupt):
        localizer.localize_all(stream(35))
    assert len(taken) == 35
    assert len(localizer.localize_all(stream(-1), sequence=True)) == 40
    assert localizer.localize_all([]) == []


def test_map_of_a_run_in_this_process(drive: pathlib.Path, opened: pg.Map) -> None:
    result = pg.run(str(drive))
    assert np.array_equal(result.trajectory().poses, opened.trajectory().poses)
    assert result.path == ""


def test_map_without_views_localizes_nothing(drive: pathlib.Path) -> None:
    options = pg.RunOptions()
    options.views.enabled = False
    options.max_frames = 10
    result = pg.run(str(drive), options)
    with pytest.raises(pg.NoResult, match="views"):
        result.localize(np.zeros((180, 240), np.uint8))
