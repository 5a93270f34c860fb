"""The types of options, as type checkers and editors see them."""

import ast
import pathlib

import pytest
from typing_extensions import assert_type

import placegraph as pg
from placegraph import _core, options as kinds
from test_options import all_kinds

STUB = pathlib.Path(_core.__file__).with_name("_option_types.pyi")
TYPES = {"bool": "bool", "int": "int", "uint": "int", "double": "float", "string": "str",
         "list": "list[float]"}


def declared() -> dict[str, dict[str, tuple[str, str]]]:
    """Type and docstring of each attribute of each class of the stub."""
    classes: dict[str, dict[str, tuple[str, str]]] = {}
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        if not isinstance(node, ast.ClassDef):
            continue
        attributes = classes.setdefault(node.name, {})
        for each, after in zip(node.body, [*node.body[1:], None]):
            if isinstance(each, ast.FunctionDef) and each.returns is not None:
                attributes[each.name] = ast.unparse(each.returns), ast.get_docstring(each) or ""
            elif isinstance(each, ast.AnnAssign) and isinstance(after, ast.Expr):
                text = ast.literal_eval(after.value)
                attributes[ast.unparse(each.target)] = ast.unparse(each.annotation), text
    return classes


DECLARED = declared()


@pytest.mark.parametrize("kind", all_kinds())
def test_every_option_has_an_attribute_of_its_type(kind: type[kinds.Options]) -> None:
    entries = kind()._set.entries()
    types = {"": kind.__name__}
    for entry in entries:
        group, _, name = entry.path.rpartition(".")
        found, doc = DECLARED[types[group]][name]
        assert entry.doc.lower() in " ".join(doc.split()).lower()
        if entry.type == "group":
            types[entry.path] = found
        elif entry.type == "choice":
            assert found == f"Literal[{', '.join(repr(choice) for choice in entry.choices)}]"
        else:
            assert found == TYPES[entry.type]
    assert sum(len(DECLARED[each]) for each in types.values()) == len(entries)


def test_mypy_and_python_see_the_same() -> None:
    options = pg.RunOptions()
    assert isinstance(assert_type(options.odometry.window.max_keyframes, int), int)
    assert isinstance(assert_type(options.loops.enabled, bool), bool)
    assert isinstance(assert_type(options.camera_height_m, float), float)
    assert isinstance(assert_type(options.mask, str), str)
    assert isinstance(assert_type(options.motion.T_cam_body, "list[float]"), list)
    options.camera_height_m = 2
    options.sensor = "stereo"


def test_what_mypy_refuses_python_refuses() -> None:
    options = pg.RunOptions()
    with pytest.raises(AttributeError, match="no_such"):
        options.no_such  # type: ignore[attr-defined]
    with pytest.raises(AttributeError, match="no_such"):
        options.loops.no_such = 1  # type: ignore[attr-defined]
    with pytest.raises(AttributeError, match="a group of options"):
        options.loops = options.loops  # type: ignore[misc]
    with pytest.raises(pg.ArgumentError, match="threads"):
        options.threads = "many"  # type: ignore[assignment]
    with pytest.raises(pg.ArgumentError, match="one of 'auto'"):
        options.sensor = "sonar"  # type: ignore[assignment]
    with pytest.raises(AttributeError):
        pg.no_such_function  # type: ignore[attr-defined]
