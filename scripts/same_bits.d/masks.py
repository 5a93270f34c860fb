"""The values that may differ between two runs of one program (masked.txt)."""
import fnmatch
import re
from dataclasses import dataclass

FIGURE = r"[-+]?(?:\d+\.?\d*(?:[eE][-+]?\d+)?|nan|inf)"
PLACES = {"<N>": f"({FIGURE})", "<V>": r"(\d+\.\d+\.\d+\S*)", "<n>": r"\d+", "<w>": r"[^\W\d][\w .,:/-]*?"}
KINDS = ("key", "text", "drop")
MASKED = "<masked>"


def compile_template(template):
    """A template of masked.txt as a regular expression whose groups are the masked figures."""
    parts = re.split(r"(<[NVnw]>| +|^\^|\$$)", template)
    pattern = ""
    for part in parts:
        if part in PLACES:
            pattern += PLACES[part]
        elif part.strip(" ") == "" and part:
            pattern += " +"
        elif part in ("^", "$"):
            pattern += part
        else:
            pattern += re.escape(part)
    # A figure at an end of the template is a whole one.
    if template.startswith("<N>"):
        pattern = r"(?<![\w.+-])" + pattern
    if template.endswith("<N>"):
        pattern += r"(?![\w.])"
    return re.compile(pattern)


@dataclass(frozen=True)
class Mask:
    kind: str
    cases: str  # a pattern of case names
    pattern: object  # the name of a key, or a regular expression


class CaseMasks:
    """The masks that hold for one case."""

    def __init__(self, masks):
        self.keys = {m.pattern for m in masks if m.kind == "key"}
        self.texts = [m.pattern for m in masks if m.kind == "text"]
        self.drops = [m.pattern for m in masks if m.kind == "drop"]

    def drops_line(self, line):
        return any(pattern.search(line) for pattern in self.drops)

    def mask_line(self, line):
        """The line with its masked figures replaced, and how many there were."""
        count = 0
        for pattern in self.texts:
            match = pattern.search(line)
            if not match:
                continue
            for group in range(pattern.groups, 0, -1):
                line = line[: match.start(group)] + MASKED + line[match.end(group):]
                count += 1
        return line, count


class Masks:
    def __init__(self, masks):
        self.masks = masks

    def of_case(self, name):
        return CaseMasks([m for m in self.masks if fnmatch.fnmatchcase(name, m.cases)])


def read_masks(path):
    masks = []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            head, _, rest = line.partition(" ")
            kind, _, cases = head.partition("@")
            rest = rest.rstrip("\n")
            if kind not in KINDS or not rest.strip():
                raise ValueError(f"{path}:{number}: expected KIND[@CASES] PATTERN, KIND one of {', '.join(KINDS)}")
            pattern = rest.strip() if kind == "key" else compile_template(rest)
            masks.append(Mask(kind, cases or "*", pattern))
    return Masks(masks)
