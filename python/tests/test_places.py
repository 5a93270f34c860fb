"""The recognizer of places finds images again, with the scores of its parts."""

import threading

import numpy as np
import pytest

import placegraph as pg

from pictures import grey, texture, warped

IMAGES = [grey(texture(120, 160, 100.0, seed)) for seed in range(12)]


def filled() -> pg.PlaceRecognizer:
    recognizer = pg.PlaceRecognizer()
    assert [recognizer.add(image) for image in IMAGES] == list(range(12))
    return recognizer


def test_every_image_is_found_again_from_nearby() -> None:
    recognizer = filled()
    assert len(recognizer) == 12
    for seed in range(12):
        moved = texture(120, 160, 100.0, seed)
        shift = np.array([[1, 0, 4.0], [0, 1, -2.0], [0, 0, 1]])
        matches = recognizer.match(grey(0.8 * warped(moved, shift) + 20))
        assert matches[0][0] == seed
        scores = [score for _, score in matches]
        assert scores == sorted(scores, reverse=True) and scores[0] > 1.2 * scores[1]


def test_scores_are_similarities_of_two_images() -> None:
    recognizer = filled()
    query = recognizer.describe(IMAGES[5], query=True)
    for index, score in recognizer.match(query):
        assert score == recognizer.similarity(query, IMAGES[index])
        assert score == recognizer.similarity(IMAGES[5], recognizer.view(index))


def test_the_range_and_the_count_limit_the_list() -> None:
    recognizer = filled()
    assert {index for index, _ in recognizer.match(IMAGES[5], 2, 4)} == {2, 3, 4}
    assert len(recognizer.match(IMAGES[5], count=2)) == 2
    assert recognizer.match(IMAGES[5], 12) == []
    assert pg.PlaceRecognizer().match(IMAGES[0]) == []


def test_options_choose_the_cues() -> None:
    options = pg.PlaceRecognizerOptions()
    for cue in ("colour", "gradients", "corners", "gabor"):
        setattr(options.cues, cue, 0.0)
    recognizer = pg.PlaceRecognizer(options)
    view = recognizer.describe(IMAGES[0])
    assert view.tiny is not None and view.tiny.shape[1] == 24
    assert view.gradients is None and view.gabor is None and view.corners == 0
    # The weight of the one cue that is left.
    assert recognizer.similarity(IMAGES[0], IMAGES[0]) == pytest.approx(options.cues.tiny, rel=1e-3)


def test_colour_tells_places_apart() -> None:
    recognizer = pg.PlaceRecognizer()
    layers = [np.stack([IMAGES[0]] * 3, -1) // 2 for _ in range(3)]
    for channel, image in enumerate(layers):
        image[..., channel] += 90
        recognizer.add(image)
    for channel, image in enumerate(layers):
        assert recognizer.match(image)[0][0] == channel


def test_views_keep_their_values() -> None:
    recognizer = filled()
    thumbnail = recognizer.describe(IMAGES[3]).thumbnail
    np.testing.assert_array_equal(thumbnail, recognizer.view(3).thumbnail)
    assert not thumbnail.flags.writeable


def test_two_threads_use_one_recognizer() -> None:
    recognizer = filled()
    expected = [recognizer.match(image, 0, 11) for image in IMAGES]
    found: dict[int, list[list[tuple[int, float]]]] = {}

    def work(thread: int) -> None:
        found[thread] = []
        for image in IMAGES:
            recognizer.add(image)
            found[thread].append(recognizer.match(image, 0, 11))

    threads = [threading.Thread(target=work, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == {0: expected, 1: expected} and len(recognizer) == 36


def test_the_past_decides_between_equal_images() -> None:
    images = [*IMAGES[:6], IMAGES[2]]  # view 6 looks like view 2
    recognizer, sequence = pg.PlaceRecognizer(), pg.SequenceFilter()
    for image in images:
        recognizer.add(image)
    for index in (0, 1, 2):
        matches = recognizer.match(IMAGES[index])
        scores = sequence.update(matches, 0, 6)
    assert {view for view, _ in matches[:2]} == {2, 6} and matches[0][1] == matches[1][1]
    assert scores[0][0] == 2 and scores[0][1] > dict(scores)[6]
    assert 0 < sequence.confidence(*scores[0], matches) <= matches[0][1]
    sequence.restart()
    assert sequence.update(matches, 0, 6)[0][1] == pytest.approx(matches[0][1])
