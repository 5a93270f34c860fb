"""Names that differ between the base revision and the present tree (renamed.txt)."""
import re

KINDS = ("command", "option", "setting", "file", "key", "table", "column", "text")


def replace_parts(parts, old, new):
    """The list with every run of items that equals `old` replaced by `new`."""
    result, i = [], 0
    while i < len(parts):
        if parts[i: i + len(old)] == old:
            result += new
            i += len(old)
        else:
            result.append(parts[i])
            i += 1
    return result


def whole_word(old):
    return re.compile(r"(?<![\w.-])" + re.escape(old) + r"(?![\w-])")


class Renames:
    def __init__(self, rules=()):
        self.rules = {kind: [] for kind in KINDS}
        for kind, old, new in rules:
            self.rules[kind].append((old, new))
        self.keys = dict(self.rules["key"])
        self.tables = dict(self.rules["table"])
        self.columns = dict(self.rules["column"])

    def present_path(self, path):
        """The relative path of an output of the base program under its new name."""
        parts = path.split("/")
        for old, new in self.rules["file"]:
            parts = replace_parts(parts, old.split("/"), new.split("/"))
        return "/".join(parts)

    def present_arguments(self, arguments):
        """A command line of the base program in the new spelling."""
        old_command = " ".join(arguments[:2])
        words = list(arguments)
        for old, new in self.rules["option"]:
            command, _, option = old.rpartition(" ")
            if not command or (old_command + " ").startswith(command + " "):
                words = [re.sub("^" + re.escape(option) + "(?==|$)", lambda _: new, w) for w in words]
        for i, word in enumerate(words):
            if i and words[i - 1] == "--set":
                words[i] = self.present_setting(word)
            elif not word.startswith(("/", "-")):
                words[i] = self.present_path(word)
        for old, new in self.rules["command"]:
            if words[: len(old.split())] == old.split():
                return new.split() + words[len(old.split()):]
        return words

    def present_setting(self, setting):
        name, equals, value = setting.partition("=")
        for old, new in self.rules["setting"]:
            if name == old or name.startswith(old + "."):
                name = new + name[len(old):]
        return name + equals + value

    def present_text(self, line):
        """A line that the base program printed, in the new words."""
        for old, new in self.rules["text"]:
            line = line.replace(old, new)
        for old, new in self.rules["command"]:
            line = re.sub(r"\bplacegraph " + re.escape(old) + r"(?![\w-])", lambda _: "placegraph " + new, line)
        for old, new in self.rules["option"]:
            line = whole_word(old.rpartition(" ")[2]).sub(lambda _: new, line)
        for old, new in self.rules["file"] + self.rules["setting"]:
            line = whole_word(old).sub(lambda _: new, line)
        return line


def read_renames(path):
    rules = []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.strip()
            if not line or line.startswith("#"):
                continue
            kind, _, rest = line.partition(" ")
            old, arrow, new = rest.partition(" -> ")
            if kind not in KINDS or not arrow or not old.strip() or not new.strip():
                raise ValueError(f"{path}:{number}: expected KIND OLD -> NEW, KIND one of {', '.join(KINDS)}")
            rules.append((kind, old.strip(), new.strip()))
    return Renames(rules)
