"""Two texts line by line: plain text, YAML, CSV, JSON."""
import itertools
import re
from dataclasses import dataclass

import json_text
from masks import MASKED

YAML_ENTRY = re.compile(r"^(\s*(?:- )*)([A-Za-z_][\w.-]*)(:(?:\s.*)?)$")
YAML_FLOW_KEY = re.compile(r"(?<=[{,] )([A-Za-z_]\w*)(?=: )|(?<=\{)([A-Za-z_]\w*)(?=: )")


@dataclass
class Finding:
    """What the comparison of two files says: nothing, or where they differ first."""
    difference: str = ""
    masked: int = 0


def clipped(line, at):
    """A piece of the line around a character."""
    begin = max(0, at - 40)
    piece = line[begin: at + 60]
    return ("..." if begin else "") + piece + ("..." if at + 60 < len(line) else "")


def difference_of(where, a, b):
    if a is None or b is None:
        return f"{where}: only in {'present' if a is None else 'base'}: {clipped(b if a is None else a, 0)!r}"
    at = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
    return f"{where}: base {clipped(a, at)!r}, present {clipped(b, at)!r}"


class TextComparison:
    """Compares texts of one case. `folders` are the output folders of the base and of the present program."""

    def __init__(self, masks, renames, folders=()):
        self.masks = masks
        self.renames = renames
        self.folders = [folder for folder in folders if folder]

    def without_folders(self, text):
        count = 0
        for folder in self.folders:
            count += text.count(folder)
            text = text.replace(folder, "<output>")
        return text, count

    def compare(self, name, base, present):
        """`name` is the path of the output; printed text is called stdout_N.txt or stderr_N.txt."""
        (base, masked), (present, _) = self.without_folders(base), self.without_folders(present)
        printed = name.startswith(("stdout_", "stderr_"))
        if name.endswith((".json", ".geojson")) or (printed and base.lstrip()[:1] in ("{", "[")):
            finding = self.compare_json(base, present)
            if finding:
                finding.masked += masked
                return finding
        finding = self.compare_lines(base, present, self.kind_of(name, printed))
        finding.masked += masked
        return finding

    @staticmethod
    def kind_of(name, printed):
        if printed:
            return "printed"
        return "yaml" if name.endswith((".yaml", ".yml")) else "csv" if name.endswith(".csv") else "text"

    def compare_lines(self, base, present, kind):
        base_lines, present_lines = self.kept(base), self.kept(present)
        masked = 0
        for i, (a, b) in enumerate(itertools.zip_longest(base_lines, present_lines)):
            if a is None or b is None:
                return Finding(self.at_line(i, base_lines, present_lines, a, b), masked)
            a, b = a[1], b[1]
            plain_a, count = self.masked_line(a, kind)
            plain_b, other = self.masked_line(b, kind)
            masked += count
            if plain_a == plain_b:
                continue
            renamed_a, _ = self.masked_line(self.renamed_line(a, kind, i == 0), kind)
            if renamed_a != plain_b:
                return Finding(self.at_line(i, base_lines, present_lines, renamed_a, plain_b), masked)
        return Finding("", masked)

    @staticmethod
    def at_line(i, base_lines, present_lines, a, b):
        lines = present_lines if i < len(present_lines) else base_lines
        text = lambda line: line[1] if isinstance(line, tuple) else line
        return difference_of(f"line {lines[i][0]}", text(a), text(b))

    def kept(self, text):
        """(number, line) of the lines that are compared."""
        return [(i, line) for i, line in enumerate(text.split("\n"), 1) if not self.masks.drops_line(line)]

    def masked_line(self, line, kind):
        entry = YAML_ENTRY.match(line) if kind == "yaml" else None
        if entry and entry[2] in self.masks.keys:
            return f"{entry[1]}{entry[2]}: {MASKED}", 1
        return self.masks.mask_line(line) if kind == "printed" else (line, 0)

    def renamed_line(self, line, kind, is_first):
        keys = self.renames.keys
        if kind == "yaml":
            entry = YAML_ENTRY.match(line)
            if entry:
                line = entry[1] + keys.get(entry[2], entry[2]) + entry[3]
            return YAML_FLOW_KEY.sub(lambda m: keys.get(m[0], m[0]), line)
        if kind == "csv" and is_first:
            return ",".join(keys.get(field, field) for field in line.split(","))
        return self.renames.present_text(line) if kind == "printed" else line

    def compare_json(self, base, present):
        """Nothing where one of the texts is no JSON."""
        try:
            base_values, present_values = json_text.read_values(base), json_text.read_values(present)
        except ValueError:
            return None
        base_masked, masked = json_text.masked_text(base, base_values, self.masks.keys, MASKED)
        present_masked, _ = json_text.masked_text(present, present_values, self.masks.keys, MASKED)
        if base_masked == present_masked:
            return Finding("", masked)
        base_values, renamed = json_text.renamed(base_values, self.renames.keys)
        if renamed:  # keys may stand in another order then
            base_values.sort(key=json_text.sort_key)
            present_values.sort(key=json_text.sort_key)
        for a, b in itertools.zip_longest(base_values, present_values):
            found = self.different_value(a, b, present)
            if found:
                return Finding(found, masked)
        if renamed:
            return Finding("", masked)
        return self.compare_lines(base_masked, present_masked, "text")  # only the layout differs

    def different_value(self, a, b, present):
        if a is None or b is None:
            return f"{(a or b).name}: only in {'present' if a is None else 'base'}"
        where = f"line {present.count(chr(10), 0, b.begin) + 1}"
        if a.path != b.path:
            return f"{where}: base {a.name}: {clipped(a.text, 0)}, present {b.name}: {clipped(b.text, 0)}"
        if a.key in self.masks.keys or a.text == b.text:
            return None
        return difference_of(f"{where}, {a.name}", a.text, b.text)
