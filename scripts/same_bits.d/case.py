"""What a case is made of."""
import re
from dataclasses import dataclass, field

PLACEHOLDER = re.compile(r"\{(\w+)\}")


@dataclass(frozen=True)
class Run:
    """A command line in the old spelling. {NAME} is the output folder of case NAME, {inputs} holds what Make wrote,
    {data} is the research data. Outputs have relative paths."""
    line: str
    exits: int = 0


@dataclass(frozen=True)
class Make:
    """Writes inputs, once for both programs: make(folder, *arguments)."""
    make: object
    folder: str  # in {inputs}; may begin with a placeholder
    arguments: tuple = ()


@dataclass(frozen=True)
class Copy:
    """Gives each program a copy of an output, CASE/PATH, under the relative path `to`. A program gets what it wrote
    itself if the case was identical, and what the base program wrote otherwise: a difference does not spread."""
    output: str
    to: str


@dataclass(frozen=True)
class Case:
    name: str
    about: str
    steps: tuple
    quick: bool = False

    def __post_init__(self):
        object.__setattr__(self, "steps", tuple(Run(s) if isinstance(s, str) else s for s in self.steps))

    def texts(self):
        for step in self.steps:
            if isinstance(step, Run):
                yield step.line
            elif isinstance(step, Copy):
                yield "{" + step.output.partition("/")[0] + "}"
            else:
                yield from (a for a in (step.folder,) + step.arguments if isinstance(a, str))

    def needs(self):
        """Names of the cases whose outputs it reads."""
        found = {name for text in self.texts() for name in PLACEHOLDER.findall(text)}
        return sorted(found - {"inputs", "data"})

    def data_paths(self):
        """What it reads of the research data."""
        return sorted({m for text in self.texts() for m in re.findall(r"\{data\}/([^\s,]+)", text)})
