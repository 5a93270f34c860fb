"""Evaluation of trajectories: against formulas in numpy and the program's output."""

import json
import pathlib
import shutil
import subprocess

import matplotlib
import matplotlib.pyplot
import numpy as np
import pytest
from checks import some, wrong
from numpy.typing import NDArray

import placegraph as pg
from placegraph import _core

matplotlib.use("agg")
Array = NDArray[np.float64]


def motion(count: int = 300) -> tuple[Array, Array]:
    """Poses of a truth and of an estimate in another frame and scale, with noise."""
    random = np.random.default_rng(4)
    angle = np.linspace(0, 5, count)
    truth = np.stack([pg.SE3.exp([0, 0, 0, 0, a, 0]).matrix() for a in angle])
    truth[:, :3, 3] = np.stack([60 * np.sin(angle), np.sin(3 * angle), 60 * (1 - np.cos(angle))], 1)
    frame = pg.SE3.exp([3, -2, 1, 0.3, -0.2, 0.5]).matrix()
    estimate = frame @ truth
    estimate[:, :3, 3] *= 0.8
    estimate[:, :3, 3] += random.normal(0, 0.1, (count, 3))
    return truth, estimate


def trajectory(poses: Array) -> pg.Trajectory:
    stamps = np.arange(len(poses), dtype=np.int64) * 100_000_000
    return pg.Trajectory.from_arrays(stamps, poses)


def similarity(source: Array, target: Array, with_scale: bool) -> tuple[float, Array, Array]:
    """Umeyama 1991 in numpy."""
    a, b = source - source.mean(0), target - target.mean(0)
    U, D, Vt = np.linalg.svd(b.T @ a / len(a))
    S = np.diag([1, 1, np.sign(np.linalg.det(U @ Vt))])
    R = U @ S @ Vt
    scale = float(np.trace(np.diag(D) @ S) / (a**2).sum() * len(a)) if with_scale else 1.0
    return scale, R, target.mean(0) - scale * R @ source.mean(0)


@pytest.mark.parametrize("align", ["se3", "sim3", "none", "origin"])
def test_ate_is_that_of_numpy(align: str) -> None:
    truth, estimate = motion()
    result = pg.evaluate(trajectory(truth), trajectory(estimate), align=align)
    moved = estimate[:, :3, 3]
    if align in ("se3", "sim3"):
        scale, R, t = similarity(moved, truth[:, :3, 3], align == "sim3")
        moved = scale * moved @ R.T + t
        assert result.alignment.scale == pytest.approx(scale, rel=1e-12)
        np.testing.assert_allclose(result.alignment.R_truth_estimate, R, atol=1e-12)
    elif align == "origin":
        T = truth[0] @ np.linalg.inv(estimate[0])
        moved = moved @ T[:3, :3].T + T[:3, 3]
    errors = np.linalg.norm(moved - truth[:, :3, 3], axis=1)
    assert result.ape_m is not None
    assert result["ate_rmse_m"] == pytest.approx(np.sqrt((errors**2).mean()), rel=1e-9)
    assert result.ape_m.median == pytest.approx(np.median(errors), rel=1e-9)
    assert result.ape_m.max == pytest.approx(errors.max(), rel=1e-9)
    np.testing.assert_allclose(result.frames["error_m"], errors, rtol=1e-7, atol=1e-12)
    np.testing.assert_allclose(result.frame_table()["estimate"][:, :3, 3], moved, atol=1e-9)


def test_rpe_is_that_of_numpy() -> None:
    truth, estimate = motion()
    result = pg.evaluate(trajectory(truth), trajectory(estimate), align="se3")
    steps = [np.linalg.inv(a[:-1]) @ a[1:] for a in (truth, estimate)]
    error = np.linalg.inv(steps[0]) @ steps[1]
    assert result.rpe_m is not None and result.rpe_m.count == len(truth) - 1
    assert result.rpe_m.rmse == pytest.approx(
        np.sqrt((error[:, :3, 3]**2).sum(1).mean()), rel=1e-9)


def relative(truth: Array, estimate: Array, steps: list[tuple[int, int]]) -> Array:
    """The pose errors of steps."""
    moved = [np.linalg.inv(each[[i for i, _ in steps]]) @ each[[j for _, j in steps]]
             for each in (truth, estimate)]
    return np.linalg.inv(moved[0]) @ moved[1]


def test_relative_errors_over_steps_are_those_of_numpy() -> None:
    truth, estimate = motion()
    path = np.append(0, np.cumsum(np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1)))
    chains: dict[str, list[tuple[int, int]]] = {"10f": [], "2s": [], "25m": []}
    for delta, ends in (("10f", lambda i: i + 10), ("2s", lambda i: i + 20),
                        ("25m", lambda i: int(np.searchsorted(path, path[i] + 25)))):
        i = 0
        while ends(i) < len(truth):
            chains[delta].append((i, ends(i)))
            i = ends(i)
    result = pg.evaluate(trajectory(truth), trajectory(estimate), deltas=list(chains))
    for delta, steps in chains.items():
        error = relative(truth, estimate, steps)
        table = result.steps(delta)
        np.testing.assert_array_equal(table[["first_frame", "last_frame"]], steps)
        lengths = np.linalg.norm(error[:, :3, 3], axis=1)
        np.testing.assert_allclose(table["translation_m"], lengths, rtol=1e-9)
        row = result.errors.loc[f"rpe_{delta}_trans_m"]
        assert row["rmse"] == pytest.approx(np.sqrt((lengths**2).mean()), rel=1e-9)
        assert row["std"] == pytest.approx(np.std(lengths), rel=1e-9)
        assert row["p90"] == pytest.approx(np.quantile(lengths, 0.9), rel=1e-9)
        assert result[f"rpe_{delta}_trans_m"] == pytest.approx(row["rmse"], rel=1e-12)
    every = pg.evaluate(trajectory(truth), trajectory(estimate), deltas="10f", all_pairs=True)
    assert len(every.steps("10f")) == len(truth) - 10
    assert len(every.steps()) == len(truth) - 1
    with pytest.raises(pg.ArgumentError, match="was not among the deltas"):
        every.steps("3f")
    with pytest.raises(pg.ArgumentError, match="delta '0s'"):
        pg.evaluate(trajectory(truth), trajectory(estimate), deltas="0s")


def test_shares_below_bounds_and_parts_of_rotations_are_those_of_numpy() -> None:
    truth, estimate = motion()
    result = pg.evaluate(trajectory(truth), trajectory(estimate), below=["0.2m", "1deg"])
    errors = result.frames["error_m"].to_numpy()
    assert result["below_0.2m_frames"] == pytest.approx((errors < 0.2).mean(), abs=1e-12)
    below = errors < 0.2
    steps = np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1)
    share = steps[below[1:] & below[:-1]].sum() / steps.sum()
    assert result["below_0.2m_path"] == pytest.approx(share, abs=1e-9)
    assert result["below_1deg_frames"] == (result.frames["error_deg"] < 1).mean()
    with pytest.raises(pg.ArgumentError, match="no bound of errors"):
        pg.evaluate(trajectory(truth), trajectory(estimate), below="1s")
    pairs = [(i, i + 1) for i in range(len(truth) - 1)]
    error = relative(truth, estimate, pairs)[:, :3, :3]
    in_world = truth[1:, :3, :3] @ error @ np.linalg.inv(truth[1:, :3, :3])
    inclination = np.degrees(np.arccos(np.clip(in_world[:, 1, 1], -1, 1)))  # y
    table = result.steps()
    np.testing.assert_allclose(table["inclination_deg"], inclination, atol=1e-5)
    half = np.arctan2(in_world[:, 0, 2] - in_world[:, 2, 0], in_world[:, 0, 0] + in_world[:, 2, 2])
    np.testing.assert_allclose(table["heading_deg"], np.degrees(np.abs(half)), atol=1e-6)
    assert result.rpe_heading_deg is not None
    assert result.rpe_heading_deg.rmse == pytest.approx(result["rpe_heading_deg"])


def test_rotation_errors_and_components_are_those_of_numpy() -> None:
    truth, estimate = motion()
    result = pg.evaluate(trajectory(truth), trajectory(estimate), align="sim3")
    aligned = result.frame_table()["estimate"]
    error = np.linalg.inv(truth) @ aligned
    cosine = np.clip((np.trace(error[:, :3, :3], axis1=1, axis2=2) - 1) / 2, -1, 1)
    angles = np.degrees(np.arccos(cosine))
    np.testing.assert_allclose(result.frames["error_deg"], angles, atol=1e-5)
    assert result.are_deg is not None
    assert result.are_deg.rmse == pytest.approx(np.sqrt((angles**2).mean()), rel=1e-5)
    parts = result.frames[["along_m", "across_m", "up_m"]].to_numpy()
    np.testing.assert_allclose(np.linalg.norm(parts, axis=1), result.frames["error_m"], rtol=1e-9)
    np.testing.assert_allclose(parts[:, 2], aligned[:, 1, 3] - truth[:, 1, 3], atol=1e-12)
    assert result.by("distance")["frames"].sum() == len(truth)
    assert result.worst["largest_m"].iloc[0] == pytest.approx(result.frames["error_m"].max())
    with pytest.raises(pg.ArgumentError, match="speed"):
        result.by("colour")


def test_alignment_over_a_part_and_by_heading() -> None:
    truth, estimate = motion()
    options = pg.EvaluationOptions()
    options.align_over.unit = "poses"
    options.align_over.end = 50
    result = pg.evaluate(trajectory(truth), trajectory(estimate), align="sim3", options=options)
    scale, R, t = similarity(estimate[:50, :3, 3], truth[:50, :3, 3], True)
    moved = scale * estimate[:, :3, 3] @ R.T + t
    errors = np.linalg.norm(moved - truth[:, :3, 3], axis=1)
    assert result["ate_rmse_m"] == pytest.approx(np.sqrt((errors**2).mean()), rel=1e-9)
    assert result.protocol["align_over"] == "poses 0:50"
    turned = pg.SE3.exp([5, 6, 7, 0, 1.1, 0]).matrix() @ truth
    by_yaw = pg.evaluate(trajectory(truth), trajectory(turned), align="yaw")
    assert some(by_yaw["ate_max_m"]) < 1e-9
    assert by_yaw.protocol["vertical"] == "y (estimated)"


def test_estimates_of_different_frames_are_compared_on_common_ones() -> None:
    truth, estimate = motion()
    half = estimate.copy()
    half[150:] = np.nan
    with pytest.warns(pg.Doubt, match="different frames"):
        both = pg.compare(trajectory(truth), {"whole": trajectory(estimate),
                                              "half": trajectory(half)})
    assert both.common is not None
    assert both.common["whole"]["ate_rmse_m"] == both.common["half"]["ate_rmse_m"]
    assert both["half"]["ate_rmse_m"] == pytest.approx(both.common["half"]["ate_rmse_m"])
    assert json.loads(both.to_json())["common"][0]["posed"] == 150
    assert pg.compare(trajectory(truth), [trajectory(estimate)] * 2).common is None


def test_a_failure_leaves_no_mean(tmp_path: pathlib.Path) -> None:
    truth, estimate = motion()
    for folder in ("truth", "estimate"):
        (tmp_path / folder).mkdir()
    for sequence in ("00.txt", "01.txt"):
        write(tmp_path / "truth", sequence, truth)
    write(tmp_path / "estimate", "00.txt", estimate)
    write(tmp_path / "estimate", "01.txt", np.full_like(estimate, np.nan))
    with pytest.warns(pg.Doubt, match="no mean over all"):
        compared = pg.compare(tmp_path / "truth", tmp_path / "estimate")
    assert compared.average["failed"] == 1
    assert compared.average["ate_rmse_m"] is None
    assert compared.average["of_the_others"]["ate_rmse_m"] == compared["00"]["ate_rmse_m"]


def test_lost_frames_have_no_error() -> None:
    truth, estimate = motion()
    estimate[40:50] = np.nan
    result = pg.evaluate(trajectory(truth), trajectory(estimate))
    error = result.frames["error_m"]
    assert error.isna().sum() == 10 and error[40:50].isna().all()
    assert result["coverage"] == pytest.approx(290 / 300)


def test_segments_and_their_means_agree() -> None:
    truth, estimate = motion()
    result = pg.evaluate(trajectory(truth), trajectory(estimate), align="sim3")
    segments = result.segments
    assert set(segments["length_m"]) == {100.0, 200.0, 300.0}
    assert result["t_rel_percent"] == pytest.approx(segments["t_percent"].mean(), rel=1e-12)
    by_length = segments.groupby("length_m")["t_percent"].mean()
    np.testing.assert_allclose(result.lengths["t_percent"], by_length, rtol=1e-12)
    assert result.speeds["segments"].sum() == len(segments)


def test_trajectories_in_a_list_have_numbers(tmp_path: pathlib.Path) -> None:
    truth, estimate = motion()
    true, estimated = trajectory(truth), trajectory(estimate)
    file = write(tmp_path, "mine.txt", estimate)
    both = pg.compare(true, [estimated, file, true])
    assert [each.name for each in both] == ["estimate 1", "mine.txt", "estimate 3"]
    assert both["estimate 1"]["ate_rmse_m"] == pg.evaluate(true, estimated)["ate_rmse_m"]
    assert some(both["estimate 3"]["ate_rmse_m"]) < 1e-9
    assert [each.name for each in pg.compare(true, estimated)] == ["estimate 1"]


def test_datasets_and_maps_are_evaluated(drive: pathlib.Path, run_folder: pathlib.Path,
                                         tmp_path: pathlib.Path) -> None:
    dataset, opened = pg.open_dataset(drive), pg.Map.open(run_folder)
    expected = pg.evaluate(some(dataset.ground_truth), opened.trajectory())
    assert pg.evaluate(dataset, opened).to_json() == expected.to_json()
    assert pg.compare(dataset, {"mine": opened})["mine"].values == expected.values
    assert pg.compare(dataset, [opened])["estimate 1"].values == expected.values
    with pytest.raises(pg.ArgumentError, match="estimate: .* not Dataset"):
        pg.evaluate(dataset, wrong(dataset))
    with pytest.raises(pg.ArgumentError, match="truth: .* not Map"):
        pg.evaluate(wrong(opened), opened)
    untrue = shutil.copytree(drive, tmp_path / "untrue", ignore=shutil.ignore_patterns("poses.txt"))
    with pytest.raises(pg.ArgumentError, match="truth: the dataset untrue has no ground truth"):
        pg.evaluate(pg.open_dataset(untrue), opened)


def test_a_refused_evaluation_says_why() -> None:
    truth, estimate = motion(10)
    other = pg.Trajectory.from_arrays(np.arange(10, dtype=np.int64) + 10**15, estimate)
    with pytest.raises(pg.NoResult, match="stamps"):
        pg.evaluate(trajectory(truth), other)
    with pytest.raises(pg.NoResult, match="late: .*stamps"):
        pg.compare(trajectory(truth), {"late": other})
    with pytest.warns(pg.Doubt, match="late has no figures, so that there is no mean"):
        both = pg.compare(trajectory(truth), {"late": other, "right": trajectory(truth)})
    assert not both["late"] and "stamps" in both["late"].reason
    with pytest.raises(pg.NoResult, match="late: .*stamps"):
        both["late"]["ate_rmse_m"]


def write(folder: pathlib.Path, name: str, poses: Array) -> str:
    path = folder / name
    np.savetxt(path, poses[:, :3].reshape(-1, 12), fmt="%.9f")
    return str(path)


def printed(*command: str) -> str:
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def test_json_is_that_of_the_program(program: str, tmp_path: pathlib.Path) -> None:
    truth, estimate = motion()
    files = [write(tmp_path, "truth.txt", truth), write(tmp_path, "estimate.txt", estimate)]
    result = pg.evaluate(*files, align="sim3")
    assert result.to_json() == printed(program, "eval", *files, "--align", "sim3", "--json")


def test_a_run_is_evaluated_against_its_sequence(
    program: str, drive: pathlib.Path, run_folder: pathlib.Path
) -> None:
    result = pg.evaluate(drive, run_folder, align="se3")
    assert result.protocol["association"] == "time"
    assert result.to_json() == printed(program, "eval", str(drive), str(run_folder), "--json")


def test_comparison_of_files_and_of_folders(program: str, tmp_path: pathlib.Path) -> None:
    truth, estimate = motion()
    for folder in ("truth", "estimate"):
        (tmp_path / folder).mkdir()
    for sequence, part in (("00.txt", slice(0, 300)), ("01.txt", slice(100, 300))):
        write(tmp_path / "truth", sequence, truth[part])
        write(tmp_path / "estimate", sequence, estimate[part])
    folders = [str(tmp_path / "truth"), str(tmp_path / "estimate")]
    compared = pg.compare(*folders, align="se3")
    assert compared.own_truths and [each.name for each in compared] == ["00", "01"]
    assert compared.to_json() == printed(program, "eval", *folders, "--align", "se3", "--json")
    assert compared.table.loc["01", "ate_rmse_m"] == compared["01"]["ate_rmse_m"]
    mean = np.mean([each["ate_rmse_m"] or 0 for each in compared])
    assert compared.average["ate_rmse_m"] == pytest.approx(mean, rel=1e-12)

    files = [str(tmp_path / "truth" / "00.txt"), str(tmp_path / "estimate" / "00.txt")]
    several = pg.compare(files[0], [files[1], files[0]])
    text = printed(program, "eval", files[0], files[1], files[0], "--json")
    assert several.to_json() == text
    assert [each["name"] for each in json.loads(text)["results"]] == [e.name for e in several]
    assert several.to_csv().startswith("name,record") and "toprule" in several.to_latex()


@pytest.mark.parametrize("kind", _core.evaluation_plots())
def test_plots_show_the_numbers(kind: str) -> None:
    truth, estimate = motion()
    result = pg.evaluate(trajectory(truth), trajectory(estimate))
    picture = result.picture(kind)
    figure = result.plot(kind)
    assert "<svg" in picture.to_svg()
    bars = sum(panel["scale"] is not None for panel in picture.panels)
    assert len(figure.axes) == len(picture.panels) + bars
    for axes, panel in zip([a for a in figure.axes if a.get_label() != "<colorbar>"],
                           picture.panels):
        assert axes.get_xlabel() == panel["x"]["label"]
    if kind == "xyz":
        line = figure.axes[0].get_lines()[0].get_xydata()
        np.testing.assert_allclose(np.asarray(line)[:, 1], truth[:, 0, 3])
    if kind == "rpe":
        steps = np.linalg.inv(truth[:-1]) @ truth[1:], np.linalg.inv(estimate[:-1]) @ estimate[1:]
        error = np.linalg.norm((np.linalg.inv(steps[0]) @ steps[1])[:, :3, 3], axis=1)
        line = figure.axes[0].get_lines()[0].get_xydata()
        np.testing.assert_allclose(np.asarray(line)[:, 1], error, rtol=1e-9)
    matplotlib.pyplot.close(figure)


def test_the_picture_is_shown_in_a_notebook() -> None:
    truth, estimate = motion()
    both = pg.compare(trajectory(truth), {"a": trajectory(estimate), "b": trajectory(truth)})
    assert both._repr_html_().startswith("<svg") and "ATE" in both._repr_html_()


def test_errors_of_edges_are_those_of_their_covariances() -> None:
    random = np.random.default_rng(8)
    sigma = np.array([0.1, 0.2, 0.1, 0.01, 0.02, 0.01])
    poses = [pg.SE3.exp(random.normal(0, 1, 6)) for _ in range(400)]
    graph = pg.PoseGraph()
    for node, pose in enumerate(poses):
        graph.add_node(node, pose)
    squares = []
    for node in range(399):
        error = random.normal(0, sigma)
        true = poses[node].inverse() * poses[node + 1]
        graph.add_edge(node, node + 1, true * pg.SE3.exp(-error), np.diag(sigma**-2.0))
        squares.append(np.sum((error / sigma) ** 2) / 6)
    truth = dict(enumerate(poses[:-1]))  # the last edge has no true pose
    found = pg.edge_consistency(graph, truth)["odometry"]
    assert (found.edges, found.unknown) == (398, 1)
    assert found.mean_nees == pytest.approx(np.mean(squares[:-1]), rel=1e-6)
    assert found.median_nees == pytest.approx(np.median(squares[:-1]), rel=1e-6)
    assert found.by_stated.mean == found.with_truth.mean == found.mean_nees
    assert found.mean_nees == pytest.approx(1, abs=0.1)
    assert found.interval_95[0] < 1 < found.interval_95[1]
    assert (found.verdict, found.truth_share) == ("hold", 0)
    assert found.sentence().startswith("The covariances of the odometry hold: NEES ")
    assert [axis.name for axis in found.axes][4] == "rotation about y"
    assert found.axes[4].stated == pytest.approx(sigma[4])
    with pytest.raises(ValueError, match="source: 'some'"):
        found.sentence("some")


def test_noise_of_the_truth_is_found_and_taken_into_account() -> None:
    random = np.random.default_rng(9)
    sigma = np.array([2e-3, 1e-3, 3e-3, 1e-3, 5e-4, 2e-3])
    frames = 600
    poses = [pg.SE3()]
    for frame in range(1, frames):
        step = np.array([0, 0, 0.5, 0, 0.02 * np.sin(0.03 * frame), 0])
        poses.append(poses[-1] * pg.SE3.exp(step))
    graph = pg.PoseGraph()
    for frame, pose in enumerate(poses):
        graph.add_node(frame, pose)
    for frame in range(frames - 1):
        step_taken = poses[frame].inverse() * poses[frame + 1]
        graph.add_edge(frame, frame + 1, step_taken, np.eye(6) * 1e8)
    matrices = [(pose * pg.SE3.exp(random.normal(0, sigma))).matrix() for pose in poses]
    trajectory = pg.Trajectory.from_arrays(np.arange(frames), np.array(matrices))
    noise = pg.estimate_truth_noise(trajectory)
    assert noise.ok and noise.interpolated == ()
    assert noise.sigma == pytest.approx(sigma, rel=0.3)
    assert noise.direction[0].frames == 1
    truth = {frame: pg.SE3(matrix) for frame, matrix in enumerate(matrices)}
    found = pg.edge_consistency(graph, truth, noise, {n: n for n in range(frames)})["odometry"]
    assert found.verdict == "not testable"
    assert found.mean_nees > 100 > 3 > found.with_truth.mean
    assert found.truth_share > 0.5
    assert not pg.estimate_truth_noise(pg.Trajectory()).ok
    white = pg.TruthNoise.white(0.01, 0.002)
    assert white.covariance(pg.SE3(), 1) == pytest.approx(2 * np.diag(white.sigma**2))


def test_mount_of_the_truth_is_fitted() -> None:
    random = np.random.default_rng(10)
    mount = pg.SE3.exp(np.array([0.02, -0.01, 0.03, 0.004, -0.006, 0.003]))
    poses = [pg.SE3.exp(random.normal(0, 1, 6)) for _ in range(60)]
    graph = pg.PoseGraph()
    for node, pose in enumerate(poses):
        graph.add_node(node, pose)
    for node in range(59):
        graph.add_edge(node, node + 1, poses[node].inverse() * poses[node + 1], np.eye(6) * 1e6)
    truth = {node: pose * mount.inverse() for node, pose in enumerate(poses)}
    fitted = pg.fit_mount(graph, truth)
    assert fitted.T_truth_cam.matrix() == pytest.approx(mount.matrix(), abs=1e-5)
    assert fitted.parameters == pytest.approx(6, abs=0.01)
    assert pg.edge_consistency(graph, truth)["odometry"].mean_nees > 10
    assert pg.edge_consistency(graph, truth, mount=fitted)["odometry"].mean_nees < 0.1
