"""Options as nested objects: the defaults, ranges and texts of the library."""

import copy
import pickle
from typing import Any

import pytest

import placegraph as pg
from placegraph import loops, options as kinds, vision


def test_groups_are_attributes_and_are_listed() -> None:
    options = pg.RunOptions()
    assert {"loops", "places", "odometry"} <= set(dir(options))
    assert "window" in dir(options.odometry)
    assert isinstance(options.loops.enabled, bool)
    assert options.odometry.help("window").startswith("odometry.window: ")


def test_a_value_is_checked_when_it_is_assigned() -> None:
    options = pg.RunOptions()
    before = options.threads
    with pytest.raises(pg.ArgumentError, match="threads"):
        options.threads = -1
    assert options.threads == before
    options.threads = before + 1
    assert options.threads == before + 1


def test_yaml_has_every_option_and_is_read_again() -> None:
    options = pg.RunOptions()
    options.loops.enabled = not options.loops.enabled
    again = pg.RunOptions.from_yaml(options.to_yaml())
    assert again.loops.enabled == options.loops.enabled
    assert again.to_yaml() == options.to_yaml()
    assert again == options
    assert again != pg.RunOptions()


def test_an_unknown_key_of_yaml_is_named_with_its_line() -> None:
    with pytest.raises(pg.FileError, match=r"mine\.yaml:2: .*no_such_key"):
        pg.RunOptions.from_yaml("threads: 1\nno_such_key: 3\n", "mine.yaml")


def test_a_key_that_is_a_constant_now_is_named_and_changes_nothing() -> None:
    text = "odometry:\n  tracker:\n    min_sigma_px: 2\n"
    with pytest.warns(RuntimeWarning, match=r"mine\.yaml:3: .*min_sigma_px' is a constant now, 0\.25"):
        options = pg.RunOptions.from_yaml(text, "mine.yaml")
    assert options == pg.RunOptions()


def test_a_copy_is_independent() -> None:
    options = pg.RunOptions()
    other = copy.deepcopy(options)
    other.loops.enabled = not options.loops.enabled
    assert other.loops.enabled != options.loops.enabled


COPIES = [copy.copy, copy.deepcopy, lambda given: pickle.loads(pickle.dumps(given))]


@pytest.mark.parametrize("copied", COPIES, ids=["copy", "deepcopy", "pickle"])
def test_options_and_groups_are_copied(copied: Any) -> None:
    options = pg.RunOptions()
    options.loops.enabled = not options.loops.enabled
    options.camera_height_m = 1.1 / 3
    for given in (options, options.loops):
        other = copied(given)
        assert other == given and type(other) is type(given) and repr(other) == repr(given)
    other = copied(options.loops)
    other.enabled = not other.enabled
    assert other != options.loops and options.loops.enabled != pg.RunOptions().loops.enabled
    assert copied(options).camera_height_m == options.camera_height_m


def test_groups_are_equal_if_their_options_are() -> None:
    options, other = pg.RunOptions(), pg.RunOptions()
    other.threads = options.threads + 1
    assert options.loops == other.loops and options != other
    other.loops.enabled = not other.loops.enabled
    assert options.loops != other.loops and options.loops != options.odometry
    assert options.loops != 3


def all_kinds() -> list[type[kinds.Options]]:
    modules = (kinds, vision, loops, pg)
    found = {kind for module in modules for kind in vars(module).values()
             if isinstance(kind, type) and issubclass(kind, kinds.Options)}
    return sorted(found - {kinds.Options}, key=lambda kind: kind.__name__)


@pytest.mark.parametrize("kind", all_kinds())
def test_options_are_listed_beside_their_methods(kind: type[kinds.Options]) -> None:
    options = kind()
    assert {"help", "to_yaml", "from_yaml", "check"} <= set(dir(options))
    names = {entry.path for entry in options._set.entries()}
    top = {name for name in names if "." not in name}
    assert top <= set(dir(options))
    assert not {part for name in names for part in name.split(".")} & set(dir(kinds.Options))
    for name in names:
        value: Any = options
        for part in name.split("."):
            value = getattr(value, part)
        if not isinstance(value, kinds.OptionGroup):
            assert value == options._set.get(name)
    assert pickle.loads(pickle.dumps(options)) == options


def test_help_tells_the_present_value() -> None:
    options = pg.RunOptions()
    options.threads = 7
    assert options.help("threads").endswith("; 7")
