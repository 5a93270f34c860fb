"""Tolerances of figures: reads scripts/results.d/tolerances.txt and judges two figures by its rules."""

import dataclasses
import math
import re

DIRECTIONS = ("lower", "higher", "equal", "info", "time")


class BadRule(Exception):
    """A line of the tolerances that cannot be understood."""


@dataclasses.dataclass(frozen=True)
class Rule:
    """lower: less is better; higher: more is better; equal: a change either way is worse; info: told
    only; time: told only, beside the reference runs."""

    direction: str
    relative: float = 0.0
    absolute: float = 0.0
    total: bool = False  # the whole of a fraction is held to this rule as well

    def __str__(self):
        parts = [f"{100 * self.relative:g} %"] if self.relative else []
        parts += [f"{self.absolute:g}"] if self.absolute else []
        return self.direction if self.direction in ("info", "time") else f"{self.direction} {', '.join(parts) or '0'}"

    def allowed(self, before):
        return max(self.relative * abs(before), self.absolute)


@dataclasses.dataclass(frozen=True)
class Judgement:
    verdict: str  # better, worse, same, info, new
    change: str = ""


def pattern(text):
    """`*` stands for anything, all else for itself."""
    return re.compile("(.*)".join(re.escape(part) for part in text.strip().split("*")), re.DOTALL)


@dataclasses.dataclass
class Rules:
    lines: list = dataclasses.field(default_factory=list)  # (section, row, column, part, rule)
    renames: list = dataclasses.field(default_factory=list)  # (section, row or None, column or None, new)

    def of(self, section, row, column, part):
        """The first line that fits; without one no change at all is allowed."""
        for sections, rows, columns, wanted, rule in self.lines:
            if (sections.fullmatch(section) and rows.fullmatch(row) and columns.fullmatch(column)
                    and wanted in (None, part)):
                return rule
        return Rule("equal")

    def renamed_section(self, section):
        return self._renamed(section, None, None, section)

    def renamed_row(self, section, row):
        return self._renamed(section, row, None, row)

    def renamed_column(self, section, row, column):
        return self._renamed(section, row, column, column)

    def _renamed(self, section, row, column, old):
        """The new name, in which each `*` is what that of the old one stood for; None where it is known to be gone."""
        for sections, rows, columns, new in self.renames:
            if (rows is None) != (row is None) or (columns is None) != (column is None):
                continue
            if (sections.fullmatch(section) and (row is None or rows.fullmatch(row))
                    and (column is None or columns.fullmatch(column))):
                if new == "(gone)":
                    return None
                stood = iter((columns or rows or sections).fullmatch(old).groups())
                return re.sub(r"\*", lambda _: next(stood, "*"), new)
        return old


def parse_rule(text, where):
    words = text.replace(",", " ").split()
    if not words or words[0] not in DIRECTIONS:
        raise BadRule(f"{where}: '{text}' does not begin with one of {', '.join(DIRECTIONS)}")
    relative = absolute = 0.0
    amounts = [word for word in words[1:] if word != "whole"]
    try:
        while amounts:
            value = float(amounts.pop(0))
            if amounts and amounts[0] == "%":
                amounts.pop(0)
                relative = value / 100
            else:
                absolute = value
            if not 0 <= value < math.inf:
                raise ValueError
    except ValueError:
        raise BadRule(f"{where}: '{text}' is no rule; one is 'lower 2 % 0.001'") from None
    return Rule(words[0], relative, absolute, "whole" in words)


def parse_rename(text, where):
    if " -> " not in text:
        raise BadRule(f"{where}: a rename is 'rename SECTION | ROW | COLUMN -> NEW NAME'")
    old, new = text.split(" -> ", 1)
    names = [name.strip() for name in old.split("|")]
    if len(names) > 3 or not all(names) or not new.strip():
        raise BadRule(f"{where}: a rename is 'rename SECTION | ROW | COLUMN -> NEW NAME'")
    patterns = [pattern(name) for name in names] + [None] * (3 - len(names))
    return (*patterns, new.strip())


def parse_rules(text, source):
    """Lines `SECTION | ROW | COLUMN | RULE`, COLUMN#2 for the second figure of its cells; `rename ...`."""
    rules = Rules()
    for number, line in enumerate(text.splitlines(), 1):
        line, where = line.strip(), f"{source}:{number}"
        if not line or line.startswith("# ") or line == "#":
            continue
        if line.startswith("rename "):
            rules.renames.append(parse_rename(line[len("rename "):], where))
            continue
        fields = [field.strip() for field in line.split("|")]
        if len(fields) != 4 or not all(fields):
            raise BadRule(f"{where}: a line is 'SECTION | ROW | COLUMN | RULE'")
        column, part = fields[2], None
        told = re.fullmatch(r"(.*)#(\d+)", column)
        if told:
            column, part = told[1], int(told[2])
        rule = parse_rule(fields[3], where)
        rules.lines.append((pattern(fields[0]), pattern(fields[1]), pattern(column), part, rule))
    return rules


def change_of(before, after):
    difference = after - before
    if difference == 0:
        return "0"
    if before == 0:
        return f"{difference:+.4g}"
    return f"{100 * difference / abs(before):+.3g} %"


def judge_numbers(before, after, rule, references=(None, None)):
    """Two numbers by a rule; references are the reference runs of their sittings [s]."""
    if not math.isfinite(after):
        return Judgement("same" if not math.isfinite(before) else "worse", "no number any more")
    if not math.isfinite(before):
        return Judgement("new", "no number before")
    change = change_of(before, after)
    if rule.direction == "time" and None not in references and before != 0 and 0 not in references:
        ratio = (after / references[1]) / (before / references[0]) - 1
        change += f" ({100 * ratio:+.3g} % by the reference runs)"
    if rule.direction in ("info", "time"):
        return Judgement("info", change)
    # Digits of a decimal fraction cannot hold the bound exactly.
    room = rule.allowed(before) + 1e-9 * max(abs(before), abs(after), rule.absolute)
    difference = after - before
    if abs(difference) <= room:
        return Judgement("same", change)
    if rule.direction == "equal":
        return Judgement("worse", change)
    return Judgement("worse" if (difference > 0) == (rule.direction == "lower") else "better", change)


def judge_fractions(before, after, rule):
    """By the first number where the whole is the same, else by the ratio."""
    if before.total == after.total:
        return judge_numbers(before.value, after.value, rule)
    if rule.direction not in ("info", "time") and not rule.total:
        return Judgement("worse", f"of {after.total:g} in place of {before.total:g}")
    ratios = [f.value / f.total if f.total else math.nan for f in (before, after)]
    if not any(map(math.isfinite, ratios)):
        return judge_numbers(before.value, after.value, rule)
    return judge_numbers(*ratios, dataclasses.replace(rule, absolute=0.0))


def judge(before, after, rule, references=(None, None)):
    """Two figures of one place. A verdict or a number that is lost is worse under any rule."""
    if before.kind == "missing" and after.kind == "missing":
        return Judgement("same")
    if before.kind == "missing":
        return Judgement("new", "no figure before")
    if after.kind == "missing":
        return Judgement("worse", "no figure any more")
    if before.kind != after.kind:
        return Judgement("info" if rule.direction == "info" else "worse", "of another kind")
    if before.kind == "verdict":
        if before.value == after.value:
            return Judgement("same")
        return Judgement("better" if after.value > before.value else "worse", f"{before.text} -> {after.text}")
    if before.kind == "fraction":
        return judge_fractions(before, after, rule)
    return judge_numbers(before.value, after.value, rule, references)
