"""The docstrings of the package speak of Python: no words of C++ and no names that it lacks."""

import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterator

import pytest

import placegraph
from placegraph import _core

CPP_WORDS = re.compile(r"\bk[A-Z]\w*|::|\bCV_|\bstd\b|\bnullptr\b|\b[Tt]hrows\b|\bdocs/\w+\.md")


def modules() -> list[object]:
    """The package and those of its modules that need no optional package."""
    found: list[object] = [placegraph, _core]
    for module in pkgutil.walk_packages(placegraph.__path__, "placegraph."):
        if module.name.startswith("placegraph.examples") or module.name.endswith("__main__"):
            continue
        try:
            found.append(importlib.import_module(module.name))
        except ImportError:
            pass
    return found


def documented() -> Iterator[tuple[str, object]]:
    """All modules, classes, functions, methods and properties that have a public name."""
    seen: set[int] = set()
    waiting = [(getattr(module, "__name__"), module) for module in modules()]
    while waiting:
        name, each = waiting.pop()
        if id(each) in seen:
            continue
        seen.add(id(each))
        yield name, each
        if not (inspect.ismodule(each) or inspect.isclass(each)):
            continue
        for member, value in vars(each).items():
            ours = isinstance(value, property) or _is_ours(value)
            public = member == "__init__" or not member.startswith("_")
            if public and ours and not inspect.ismodule(value):
                waiting.append((f"{name}.{member}", value))


def _is_ours(value: object) -> bool:
    value = getattr(value, "__func__", value)
    kind = type(value).__name__
    if kind.startswith("nb_"):
        return str(getattr(value, "__module__", "placegraph")).startswith("placegraph")
    return (inspect.isclass(value) or inspect.isfunction(value)) and \
        str(value.__module__).startswith("placegraph")


def text_of(each: object) -> str:
    """The docstring, without the signatures that nanobind puts before it."""
    each = getattr(each, "__func__", each)
    doc = getattr(each, "__doc__", None) or ""
    if type(each).__name__ in ("nb_func", "nb_method"):
        name = re.escape(getattr(each, "__name__"))
        doc = re.sub(rf"^(?:\d+\. ``)?{name}\(.*\n?", "", doc, flags=re.MULTILINE)
    return str(doc)


EVERYTHING = dict(documented())


def test_the_walk_finds_the_package() -> None:
    for name in (".run", ".Trajectory.read", ".FrameResult.state", ".umeyama", ".SlamCore.resume"):
        assert any(found.endswith(name) for found in EVERYTHING), name
    assert len(EVERYTHING) > 800
    assert sum(bool(text_of(each)) for each in EVERYTHING.values()) > 600


def test_no_docstring_has_words_of_cpp() -> None:
    faults = [f"{name}: {found.group()}" for name, each in sorted(EVERYTHING.items())
              if (found := CPP_WORDS.search(text_of(each)))]
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize("wrong", ["`kTracking` if posed", "Throws FileError.", "see Slam::notes",
                                   "CV_8UC1", "std::string", "nullptr", "see docs/datasets.md"])
def test_words_of_cpp_are_found(wrong: str) -> None:
    assert CPP_WORDS.search(wrong)


def known_names() -> set[str]:
    """Names of everything, members of dataclasses and options included."""
    names = {"None", "True", "False"} | {part for name in EVERYTHING for part in name.split(".")}
    for each in EVERYTHING.values():
        if not inspect.isclass(each):
            continue
        names |= set(dir(each)) | set(getattr(each, "__annotations__", {}))
        if issubclass(each, _core.OptionSet) and each is not _core.OptionSet:
            names |= {part for entry in each().entries() for part in entry.path.split(".")}
    return names


def parameters_of(each: object) -> set[str]:
    each = getattr(each, "__func__", each)
    if inspect.isfunction(each):
        return set(inspect.signature(each).parameters)
    return set(re.findall(r"[(,*]\s*(\w+)(?=[:,)=])", str(getattr(each, "__doc__", ""))))


def test_names_in_backquotes_exist() -> None:
    known = known_names()
    faults = []
    for name, each in sorted(EVERYTHING.items()):
        if inspect.ismodule(each) or inspect.isclass(each) or isinstance(each, property):
            continue
        for quoted in re.findall(r"(?<!`)`([A-Za-z_]\w*)`(?!`)", text_of(each)):
            if quoted not in known | parameters_of(each):
                faults.append(f"{name}: `{quoted}`")
    assert not faults, "\n".join(faults)


def members_of(each: type) -> set[str]:
    """Attributes of a class; for options, those of the set that it holds."""
    names = set(dir(each)) | set(getattr(each, "__annotations__", {}))
    option_set = getattr(_core, re.sub("Options$", "OptionSet", each.__name__), each)
    if issubclass(option_set, _core.OptionSet) and option_set is not _core.OptionSet:
        names |= {entry.path.split(".")[0] for entry in option_set().entries()}
    return names


def test_members_that_are_named_exist() -> None:
    classes = {each.__name__: each for each in EVERYTHING.values() if inspect.isclass(each)}
    faults = []
    for name, each in sorted(EVERYTHING.items()):
        for owner, member in re.findall(r"\b([A-Z]\w+)\.([a-z_]\w*)", text_of(each)):
            if owner in classes and member not in members_of(classes[owner]):
                faults.append(f"{name}: {owner}.{member}")
    assert not faults, "\n".join(faults)
