"""JSON as a list of values with their keys and their places in the text. Numbers stay text, so that every digit counts."""
import re
from dataclasses import dataclass

TOKEN = re.compile(r'\s*(?:("(?:[^"\\]|\\.)*")|([-+]?[\w.+-]+)|([\[\]{}:,]))', re.DOTALL)


@dataclass(frozen=True)
class Value:
    path: tuple  # keys and indices
    text: str
    begin: int  # in the text of the file
    end: int

    @property
    def key(self):
        """The last name on the way to the value."""
        return next((part for part in reversed(self.path) if isinstance(part, str)), "")

    @property
    def name(self):
        return "".join(f"[{p}]" if isinstance(p, int) else "." + p for p in self.path).lstrip(".") or "(whole)"


def tokens_of(text):
    at, end = 0, len(text.rstrip())
    while at < end:
        match = TOKEN.match(text, at)
        if not match:
            raise ValueError(f"no JSON at character {at}")
        kind = match.lastindex
        yield kind, match.group(kind), match.start(kind), match.end(kind)
        at = match.end()


def read_values(text):
    """All scalars, in their order; an empty list or object counts as one. Throws ValueError on what is no JSON."""
    values, path, containers = [], [], []  # a container is [bracket, number of values]
    pending_key = None
    for kind, token, begin, end in tokens_of(text):
        if token == ":" and kind == 3:
            if pending_key is None:
                raise ValueError("a colon without a key")
            path[-1] = pending_key[1:-1]
            pending_key = None
        elif token == "," and kind == 3:
            if not containers:
                raise ValueError("a comma outside")
            containers[-1][1] += 1
            path[-1] = containers[-1][1] if containers[-1][0] == "[" else None
        elif kind == 3 and token in "[{":
            containers.append([token, 0, begin, len(values)])
            path.append(0 if token == "[" else None)
        elif kind == 3:
            if not containers:
                raise ValueError("a bracket that closes nothing")
            opened = containers.pop()
            path.pop()
            if len(values) == opened[3]:
                values.append(Value(tuple(path), opened[0] + token, opened[2], end))
        elif containers and containers[-1][0] == "{" and path[-1] is None:
            if kind != 1:
                raise ValueError("a key that is no string")
            pending_key = token
        else:
            values.append(Value(tuple(path), token, begin, end))
    if containers or not values:
        raise ValueError("no whole JSON")
    return values


def masked_text(text, values, keys, mask):
    """The text with the values of the keys replaced, and how many there were."""
    result, at, count = [], 0, 0
    for value in values:
        if value.key in keys:
            result += [text[at: value.begin], mask]
            at = value.end
            count += 1
    return "".join(result) + text[at:], count


def renamed(values, names):
    """The values with the keys in their new spelling, and how many paths changed. Keys are names, or a.b for b in a."""
    plain = {old: new for old, new in names.items() if "." not in old}
    nested = {tuple(old.split(".")): new for old, new in names.items() if "." in old}
    result, changed = [], 0
    for value in values:
        strings = [part for part in value.path if isinstance(part, str)]
        seen, path = [], []
        for part in value.path:
            if not isinstance(part, str):
                path.append(part)
                continue
            seen.append(part)
            new = next((n for old, n in nested.items() if tuple(seen[-len(old):]) == old), plain.get(part, part))
            path.append(new)
        changed += [p for p in path if isinstance(p, str)] != strings
        result.append(Value(tuple(path), value.text, value.begin, value.end))
    return result, changed


def sort_key(value):
    return [(0, part, "") if isinstance(part, int) else (1, 0, part or "") for part in value.path]
