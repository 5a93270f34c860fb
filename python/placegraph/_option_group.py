"""Groups of options, whose names, types and texts are those of the C++ library."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any, TypeVar

from . import _core

if TYPE_CHECKING:
    from typing_extensions import Self

Value = bool | int | float | str | list[float]


@functools.cache
def _tree(kind: type[_core.OptionSet]) -> dict[str, dict[str, _core.OptionEntry]]:
    """The entries of a kind of options by group ("", "loops.", ...) and name, with the defaults."""
    tree: dict[str, dict[str, _core.OptionEntry]] = {}
    for entry in kind().entries():
        group, dot, name = entry.path.rpartition(".")
        tree.setdefault(group + dot, {})[name] = entry
    return tree


def _restored(group: type[OptionGroup], kind: type[_core.OptionSet], yaml: str, path: str,
              version: str = "(older)") -> OptionGroup:
    """Options that a version of the package pickled."""
    _core.require_own_version(version, group.__name__)
    options = kind()
    options.read_yaml(yaml, "pickle")
    return group._of(options, path)


class OptionGroup:
    """A group of options; `dir(group)` lists them, `group.help("name")` explains one.

    Groups are equal if all their options are. A copy, and what pickle restores, is independent of
    the options that the group belongs to.
    """

    __slots__ = ("_path", "_set")
    _set: _core.OptionSet
    _path: str

    def __init__(self, options: _core.OptionSet, path: str) -> None:
        object.__setattr__(self, "_set", options)
        object.__setattr__(self, "_path", path)

    @classmethod
    def _of(cls, options: _core.OptionSet, path: str) -> Self:
        group = cls.__new__(cls)
        OptionGroup.__init__(group, options, path)
        return group

    def _children(self) -> dict[str, _core.OptionEntry]:
        kind: Any = type(self._set)  # the type of a type is no Hashable for mypy
        return _tree(kind).get(self._path, {})

    def _child(self, name: str) -> _core.OptionEntry:
        entry = self._children().get(name)
        if entry is None:
            raise AttributeError(f"{self._path}{name}: no such option")
        return entry

    def _values(self) -> list[tuple[str, str]]:
        """Paths and present values, as YAML writes them."""
        return [(entry.path, entry.value) for entry in self._set.entries()
                if entry.path.startswith(self._path) and entry.type != "group"]

    if not TYPE_CHECKING:  # type checkers know the options of each kind, see options.kinds

        def __getattr__(self, name: str) -> OptionGroup | Value:
            if name.startswith("_"):  # no option; also asked for before __init__
                raise AttributeError(name)
            entry = self._child(name)
            if entry.type == "group":
                return OptionGroup(self._set, entry.path + ".")
            return self._set.get(entry.path)

        def __setattr__(self, name: str, value: Value) -> None:
            entry = self._child(name)
            if entry.type == "group":
                raise AttributeError(f"{entry.path}: a group of options, not a value")
            self._set.set(entry.path, value)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self._children()})

    def help(self, name: str) -> str:
        """The meaning of an option, its range and its present value, in one line."""
        entry = self._child(name)
        text = f"{entry.path}: {entry.doc}"
        if entry.type == "group":
            return text
        low, high = entry.range
        if entry.choices:
            text += f"; one of {', '.join(entry.choices)}"
        elif low != float("-inf") or high != float("inf"):
            text += f"; in [{low:g}, {high:g}]"
        return f"{text}; {dict(self._values())[entry.path]}"

    def __repr__(self) -> str:
        return "\n".join(f"{path}: {value}" for path, value in self._values())

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, OptionGroup):
            return NotImplemented
        return type(self._set) is type(other._set) and self._values() == other._values()

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> Self:
        return self._of(self._set.copy(), self._path)

    def __deepcopy__(self, memo: object) -> Self:
        return self._of(self._set.copy(), self._path)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), type(self._set), self._set.to_yaml(), self._path,
                           _core.version)


class Options(OptionGroup):
    """All options of one kind."""

    __slots__ = ()
    _kind: type[_core.OptionSet]

    def __init__(self) -> None:
        super().__init__(self._kind(), "")

    @classmethod
    def from_yaml(cls, text: str, name: str = "text") -> Self:
        """The defaults, changed by what a YAML text names; `name` stands for it in messages."""
        options = cls()
        options._set.read_yaml(text, name)
        return options

    def to_yaml(self) -> str:
        """All options as YAML, which `placegraph run --config` and `from_yaml` read."""
        return self._set.to_yaml()

    def check(self) -> None:
        """Raises ArgumentError if options contradict each other."""
        self._set.check()


Kind = TypeVar("Kind", bound=Options)


def given_or_default(options: Kind | None, kind: type[Kind]) -> Kind:
    """The argument `options` of a function, or the defaults in place of None."""
    if options is None:
        return kind()
    if not isinstance(options, kind):
        raise _core.ArgumentError(
            f"options: {kind.__name__} are needed, not {type(options).__name__}")
    return options
