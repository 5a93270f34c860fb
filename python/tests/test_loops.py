"""Scores of place recognizers: against definitions in numpy and the program's output."""

import json
import pathlib
import subprocess

import matplotlib
import matplotlib.pyplot
import numpy as np
import pandas
import pytest
from numpy.typing import NDArray

import placegraph as pg
from placegraph import loops

matplotlib.use("agg")


def example() -> tuple[pandas.DataFrame, dict[int, list[int]]]:
    """Best candidates of 60 queries, two thirds of them right."""
    random = np.random.default_rng(2)
    truth = {query: [query - 50, query - 49] for query in range(50, 100)}
    truth.update({query: [] for query in range(100, 110)})
    query = np.repeat(np.arange(50, 110), 2)
    right = random.random(len(query)) < 0.6
    candidate = np.where(right, query - 50, random.integers(0, 50, len(query)))
    candidate[1::2] = (candidate[::2] + 7) % 50  # no pair twice
    score = np.where(right, random.uniform(0.3, 1, len(query)), random.uniform(0, 0.8, len(query)))
    return pandas.DataFrame({"query": query, "candidate": candidate, "score": score}), truth


def test_curve_is_that_of_the_definition() -> None:
    table, lists = example()
    result = loops.score(table, loops.LoopTruth(lists))
    best = table.loc[table.groupby("query")["score"].idxmax()]
    hit = np.array([c in lists[q] for q, c in zip(best["query"], best["candidate"])])
    order = np.argsort(-best["score"].to_numpy())
    hits, misses = np.cumsum(hit[order]), np.cumsum(~hit[order])
    curve = result.curve
    np.testing.assert_array_equal(curve["threshold"], best["score"].to_numpy()[order])
    np.testing.assert_array_equal(curve["hits"], hits)
    np.testing.assert_allclose(curve["precision"], hits / (hits + misses))
    recall = hits / 50
    np.testing.assert_allclose(curve["recall"], recall)
    average = np.sum(np.diff(recall, prepend=0) * hits / (hits + misses))
    assert result["ap"] == pytest.approx(average, rel=1e-12)
    assert result["r_at_1"] == pytest.approx(hit.sum() / 50)
    assert result["positives"] == 50
    queries = result.queries.set_index("query")
    assert (queries.loc[best["query"], "verdict"] == np.where(hit, "hit", "miss")).all()


@pytest.mark.parametrize("tolerance", [0, 2])
def test_figures_are_those_of_the_program(program: str, tmp_path: pathlib.Path,
                                          tolerance: int) -> None:
    table, lists = example()
    predictions, truth = tmp_path / "predictions.txt", tmp_path / "truth.txt"
    np.savetxt(predictions, table.to_numpy(), fmt="%d %d %.17g")
    truth.write_text("".join(f"{q} {' '.join(map(str, m))}\n" for q, m in lists.items() if m))
    command = [program, "eval", "loops", "--predictions", str(predictions), "--truth", str(truth),
               "--min-age", "5", "--tolerance", str(tolerance), "--json"]
    printed = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    result = loops.score(predictions, truth, min_age=5, tolerance=tolerance)
    assert result.metrics == {key: printed[key] for key in result.metrics}
    assert loops.read_predictions(predictions)["query"].tolist() == table["query"].tolist()


def test_loops_of_a_run_are_those_of_the_program(
    program: str, drive: pathlib.Path, run_folder: pathlib.Path
) -> None:
    predictions = run_folder / "loops.csv"
    command = [program, "eval", "loops", "--predictions", str(predictions), "--format", "run",
               "--true-poses", str(drive / "poses.txt"), "--min-age", "20", "--json"]
    printed = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    truth = pg.Trajectory.read(str(drive / "poses.txt"))
    result = loops.score(predictions, truth, format="run", min_age=20)
    assert result.metrics == {key: printed[key] for key in result.metrics}
    assert result.reliability["calibration_error"] == printed["calibration_error"]


def test_truth_of_poses_is_that_of_distances() -> None:
    angle = np.linspace(0, 4 * np.pi, 200)  # two rounds
    poses = np.stack([pg.SE3.exp([0, 0, 0, 0, a, 0]).matrix() for a in angle])
    poses[:, 0, 3], poses[:, 2, 3] = 20 * np.sin(angle), 20 * np.cos(angle)
    poses[150] = np.nan
    trajectory = pg.Trajectory.from_arrays(np.arange(200, dtype=np.int64) * 10**8, poses)
    options = loops.RevisitOptions()
    options.min_age, options.same.radius_m, options.same.heading_deg = 50, 3.0, 40.0
    truth = loops.LoopTruth.from_poses(trajectory, options)
    position = poses[:, :3, 3]
    apart = np.linalg.norm(position[:, None] - position, axis=2)
    heading = np.abs((angle[:, None] - angle + np.pi) % (2 * np.pi) - np.pi)
    near = (apart <= 3.0) & (heading <= np.radians(40))
    expected = {q: [m for m in range(q - 49) if near[q, m]] for q in range(200) if q != 150}
    assert truth.matches == expected

    table, _ = example()
    by_poses = loops.score(table, trajectory, options=options)
    assert by_poses.metrics == loops.score(table, truth).metrics


def test_a_square_matrix_is_of_one_drive_or_of_two_sets() -> None:
    matrix = np.eye(30, dtype=bool) | np.eye(30, k=1, dtype=bool) | np.eye(30, k=-1, dtype=bool)
    query = np.arange(30)
    with pytest.raises(pg.ArgumentError, match="may be of one drive or of queries and a database"):
        loops.score((query, query, np.linspace(1, 2, 30)), loops.LoopTruth.from_matrix(matrix))
    for truth in (loops.LoopTruth.from_matrix(matrix, within=False),
                  loops.LoopTruth.from_matrix(matrix, min_age=0)):
        two = loops.score((query, query, np.linspace(1, 2, 30)), truth)
        assert two["r_at_1"] == two["ap"] == 1
        assert two.protocol.startswith("queries against a database")
    one = loops.score((query[1:], query[:-1], np.linspace(1, 2, 29)),
                      loops.LoopTruth.from_matrix(matrix, within=True))
    assert one["positives"] == 29 and one["r_at_1"] == 1
    assert one.protocol.startswith("within one drive")


@pytest.mark.parametrize("form", ["arrays", "table", "search", "matrix"])
@pytest.mark.parametrize("suffix", ["", ".npy", ".npz"])
def test_two_sets_have_one_result_in_every_form(tmp_path: pathlib.Path, form: str,
                                                suffix: str) -> None:
    random = np.random.default_rng(4)
    matches = random.random((12, 40)) < 0.08
    matches[np.arange(12), random.integers(0, 40, 12)] = True
    scores = random.random((12, 40)) + matches * random.random((12, 40))
    best = np.argsort(-scores, axis=1)[:, :40]
    query = np.repeat(np.arange(12), 40)
    predictions = {
        "arrays": (query, best.ravel(), np.take_along_axis(scores, best, 1).ravel()),
        "table": pandas.DataFrame({"query": query, "candidate": best.ravel(), "distance":
                                   -np.take_along_axis(scores, best, 1).ravel()}),
        "search": (best, np.take_along_axis(scores, best, 1)),
        "matrix": scores,
    }[form]
    truth: object = matches
    if suffix == ".npy":
        np.save(tmp_path / "truth.npy", matches)
    elif suffix == ".npz":
        np.savez(tmp_path / "truth.npz", matches=matches)
    if suffix:
        truth = tmp_path / f"truth{suffix}"
    result = loops.score(predictions, truth)  # type: ignore[arg-type]
    right = np.take_along_axis(matches, best, 1)
    for k in (1, 5, 10, 20):
        assert result[f"r_at_{k}"] == pytest.approx(right[:, :k].any(axis=1).mean())
    assert result.protocol.startswith("queries against a database")
    assert loops.score(predictions, loops.truth_of_lists(
        [(q, np.flatnonzero(row).tolist()) for q, row in enumerate(matches)])).metrics == result.metrics


def reference_curve(hit: np.ndarray, score: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Precision and recall of scikit-learn's precision_recall_curve, written out."""
    threshold = np.unique(score)
    precision = [hit[score >= t].mean() for t in threshold]
    recall = [hit[score >= t].sum() / hit.sum() for t in threshold]
    return np.array([*precision, 1.0]), np.array([*recall, 0.0])


@pytest.mark.parametrize("seed", range(20))
def test_figures_are_those_of_scikit_learn_and_vpr_bench(seed: int) -> None:
    random = np.random.default_rng(seed)
    n = int(random.integers(5, 60))
    matches = random.random((n, 30)) < 0.1
    candidate = random.integers(0, 30, n)
    candidate[::2] = [np.flatnonzero(row)[0] if row.any() else 0 for row in matches[::2]]
    hit = matches[np.arange(n), candidate]
    if not hit.any():
        pytest.skip("no hit")
    score = np.round(random.random(n) + 0.3 * hit, 1)  # with ties
    result = loops.score((np.arange(n), candidate, score), matches)
    precision, recall = reference_curve(hit, score)
    assert result["ap_of_answers"] == pytest.approx(-np.sum(np.diff(recall) * precision[:-1]))
    area = -np.sum(np.diff(recall) * (precision[1:] + precision[:-1]) / 2)
    assert result["auc_of_answers"] == pytest.approx(area)
    assert result["r_at_1_of_all"] == pytest.approx(hit.mean())
    assert result["r_at_1"] == pytest.approx(hit.sum() / matches.any(axis=1).sum())
    assert result["ap"] == pytest.approx(
        result["ap_of_answers"] * hit.sum() / matches.any(axis=1).sum())


def test_objects_of_python_are_not_unpickled(tmp_path: pathlib.Path) -> None:
    rows = np.empty((2, 2), dtype=object)
    for query, found in ((0, [1, 2]), (1, [2])):
        rows[query] = query, found
    np.save(tmp_path / "ground_truth_new.npy", rows)
    with pytest.raises(pg.FileError, match="objects of Python"):
        loops.LoopTruth.read(tmp_path / "ground_truth_new.npy")
    with pytest.raises(pg.FileError, match="not unpickled"):
        loops.read_array(tmp_path / "ground_truth_new.npy")
    assert loops.truth_of_lists(rows).matches == {0: [1, 2], 1: [2]}


def test_two_sets_by_their_positions(program: str, tmp_path: pathlib.Path) -> None:
    random = np.random.default_rng(1)
    database = np.column_stack([np.arange(80.0), np.zeros(80)])
    queries = database[10:70:3] + random.normal(0, 0.4, (20, 2))
    for name, rows in (("queries.csv", queries), ("database.csv", database)):
        pandas.DataFrame(rows, columns=["easting", "northing"]).to_csv(tmp_path / name, index=False)
    candidate = np.round(queries[:, 0]).astype(int) + random.integers(-3, 4, 20)
    pandas.DataFrame({"query": np.arange(20), "candidate": candidate,
                      "distance": random.random(20)}).to_csv(tmp_path / "found.csv")
    options = loops.RevisitOptions()
    options.same.radius_m, options.same.heading_deg = 2, 180
    truth = loops.LoopTruth.between(loops.ImageSet.read(tmp_path / "queries.csv"),
                                    loops.ImageSet.read(tmp_path / "database.csv"), options)
    apart = np.linalg.norm(queries[:, None] - database, axis=2)
    assert truth.matches == {q: np.flatnonzero(row <= 2).tolist() for q, row in enumerate(apart)}
    result = loops.score(tmp_path / "found.csv", truth)
    command = [program, "loops", "--predictions", str(tmp_path / "found.csv"), "--queries",
               str(tmp_path / "queries.csv"), "--database", str(tmp_path / "database.csv"),
               "--radius", "2", "--heading", "180", "--json"]
    printed = json.loads(subprocess.run(command, check=True, capture_output=True).stdout)
    assert printed["scores"] == "distance" and printed["protocol"].startswith("queries against")
    assert result.metrics == {key: printed[key] for key in result.metrics}


def test_reliability_of_probabilities() -> None:
    query, right = np.arange(100, 300), np.arange(200) % 4 != 0
    candidate = np.where(right, 0, 50)
    truth = loops.LoopTruth({int(q): [0] for q in query})
    result = loops.score((query, candidate, np.full(200, 0.75)), truth)
    table = result.reliability
    assert table["candidates"].sum() == 200 and table["candidates"][7] == 200
    assert table["share_right"][7] == pytest.approx(0.75)
    assert table["calibration_error"] == pytest.approx(0, abs=1e-12)


def test_the_plot_has_the_points_of_the_curve() -> None:
    table, lists = example()
    result = loops.score(table, loops.LoopTruth(lists), name="mine")
    axes = result.plot()
    line = np.asarray(axes.get_lines()[0].get_xydata())
    np.testing.assert_allclose(line[1::2, 0], result.curve["recall"])
    np.testing.assert_allclose(line[1::2, 1], result.curve["precision"])
    assert "mine" in str(axes.get_lines()[0].get_label())
    matplotlib.pyplot.close("all")


def test_match_finds_the_nearest_older_image_of_each() -> None:
    random = np.random.default_rng(8)
    places = random.integers(0, 256, (20, 24, 32, 3), dtype=np.uint8)
    noise = random.integers(0, 20, (20, 24, 32, 3), dtype=np.uint8)
    images = [*places, *(places // 2 + noise)]

    def describe(image: NDArray[np.uint8]) -> NDArray[np.float64]:
        values = image.astype(np.float64).ravel()
        return np.asarray(values - values.mean())

    found = loops.match(iter(images), describe, min_age=20)
    assert found["query"].tolist() == list(range(20, 40))
    assert found["candidate"].tolist() == list(range(20))
    vectors = np.array([describe(image) for image in images])
    vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    expected = (vectors[:20] * vectors[20:]).sum(axis=1)
    np.testing.assert_allclose(found["score"], expected, atol=1e-5)
    truth = loops.LoopTruth({q: [q - 20] if q >= 20 else [] for q in range(40)})
    assert loops.score(found, truth, min_age=None)["r_at_1"] == 1
    with pytest.raises(pg.ArgumentError, match="min_age"):
        loops.match(images, describe, min_age=0)
    with pytest.raises(pg.ArgumentError, match="recognizer: there is none"):
        loops.match(images, None)  # type: ignore[arg-type]
