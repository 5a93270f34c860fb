"""What a run has reported about a fault, and the table and summary of all runs."""
import dataclasses
import json

CAUSES = frozenset("""
few_posed lost_frames components jump scale_questionable camera_height_questionable baseline_questionable
cameras_swapped right_image_late right_image_unusable depth_unit_questionable depth_mismatch
calibration_questionable distortion_questionable static_overlay times_questionable images_unusable
repeated_frames upside_down drift_large""".split())
INFORMATION = frozenset({"distortion_questionable"})  # no alarm in a run that is judged good: the lens was corrected
UNCHECKED = "scale_unchecked"  # cause of a length that no evidence can contradict
UNCHECKED_TEXTS = ("nothing in the recording checks it", "checks it to 40 % only")
OK, NO_RESULT, REFUSED = 0, 1, 2  # exit codes of the program


@dataclasses.dataclass
class Run:
    """One run of the program on a sequence with a fault, or without ("none")."""
    fault: str
    group: str        # "fixed", "held"; "clean" without a fault
    base: str
    sensor: str
    causes: list      # of which the judgement must name one; empty: none
    exit_code: int
    frames: int = 0
    posed: int = 0
    wrong: list = dataclasses.field(default_factory=list)  # numbers of frames whose pose is wrong
    metric: bool = False
    verdict: str = ""  # empty: no judgement
    unchecked: bool = False  # the judgement says that nothing in the recording checks the scale
    found: list = dataclasses.field(default_factory=list)  # causes that the judgement names
    message: str = ""  # last line on stderr

    def crashed(self):
        return self.exit_code not in (OK, NO_RESULT, REFUSED)

    def named(self):
        """Whether the judgement names the cause; where the fault has none, whether it doubts the run."""
        if not self.causes:
            return self.doubted()
        return bool(set(self.found) & set(self.causes)) or self.only_unchecked()

    def only_unchecked(self):
        """Whether the judgement says no more of the cause than that nothing checks the scale."""
        return self.unchecked and UNCHECKED in self.causes and not set(self.found) & set(self.causes)

    def doubted(self):
        return self.verdict not in ("", "good") or bool(self.found)

    def reported(self):
        """Short: how the program has reported what is wrong."""
        if self.crashed():
            return "CRASHED"
        if self.exit_code == REFUSED:
            return "refused"
        if self.only_unchecked():
            return "unchecked"
        if self.named():
            return "cause" if self.causes else "doubt"
        return "doubt" if self.doubted() else "lost" if self.posed == 0 else "-"

    def wrong_and_unreported(self):
        return self.crashed() or bool(self.wrong) and not self.named()

    def false_alarm(self):
        """A run without a fault that is doubted, or that has any finding but information."""
        return self.verdict not in ("", "good") or bool(set(self.found) - INFORMATION)


def judgement_of(result):
    """Verdict, causes and whether the scale is said to be unchecked, of result.json; nothing where
    it has no judgement."""
    judgement = result.get("judgement")
    if judgement is None:
        return "", [], False
    causes = [finding["cause"] for finding in judgement["findings"]]
    unknown = sorted(set(causes) - CAUSES)
    if unknown:
        raise ValueError(f"result.json: judgement.findings: cause '{unknown[0]}' is unknown")
    if judgement["verdict"] not in ("good", "doubtful", "failed"):
        raise ValueError(f"result.json: judgement.verdict: '{judgement['verdict']}' is unknown")
    return judgement["verdict"], causes, any(text in judgement["why_metric"] for text in UNCHECKED_TEXTS)


ROW = "{:24} {:6} {:12} {:7} {:>9} {:>6}  {:9} {:5}  {}"
HEADING = ROW.format("fault", "group", "base", "sensor", "posed", "wrong", "reported", "named", "verdict, causes found, message")


def row_of(run):
    named = "" if run.group == "clean" or not run.causes or run.exit_code == REFUSED else "yes" if run.named() else "no"
    rest = " ".join(filter(None, [run.verdict, ",".join(run.found), "" if run.metric else "not-metric",
                                  run.message if run.exit_code != OK else ""]))
    return ROW.format(run.fault, run.group, run.base, run.sensor, f"{run.posed}/{run.frames}", len(run.wrong),
                      run.reported(), named, rest[:120]).rstrip()


def percent(part, whole):
    return round(100 * part / whole, 1) if whole else 0.0


def summary_of(runs):
    """The figures of the runs: those with a fault, and the false alarms of those without."""
    faulty = [run for run in runs if run.group != "clean"]
    clean = [run for run in runs if run.group == "clean"]
    with_cause = [run for run in faulty if run.causes and run.exit_code != REFUSED]
    wrong = [run for run in faulty if run.wrong]
    unreported = [run for run in runs if run.wrong_and_unreported()]
    return {
        "runs": len(faulty),
        "wrong": len(wrong),
        "wrong_and_unreported": len(unreported),
        "of_these_doubted": sum(run.doubted() for run in unreported),
        "wrong_frames_unreported": sum(len(run.wrong) for run in unreported),
        "refused": sum(run.exit_code == REFUSED for run in faulty),
        "crashed": sum(run.crashed() for run in runs),
        "unchecked": sum(run.only_unchecked() for run in faulty),
        "with_cause": len(with_cause),
        "cause_named_percent": percent(sum(run.named() for run in with_cause), len(with_cause)),
        "wrong_cause_named_percent": percent(sum(run.named() for run in wrong), len(wrong)),
        "clean": len(clean),
        "false_alarms": sum(run.false_alarm() for run in clean),
    }


def summary_line(name, runs):
    s = summary_of(runs)
    return (f"{name}: {s['runs']} runs with faults, {s['wrong']} with wrong poses; wrong and unreported "
            f"{s['wrong_and_unreported']} ({s['wrong_frames_unreported']} frames; doubted {s['of_these_doubted']}); "
            f"cause named rightly {s['cause_named_percent']} % of {s['with_cause']}, "
            f"{s['wrong_cause_named_percent']} % of those with wrong poses "
            f"({s['unchecked']} as the length that nothing checks); refused {s['refused']}, "
            f"crashed {s['crashed']}; false alarms {s['false_alarms']} of {s['clean']} clean")


def to_json(runs):
    groups = {group: summary_of([run for run in runs if run.group in (group, "clean")]) for group in ("fixed", "held")}
    return json.dumps({"summary": summary_of(runs), "groups": groups,
                       "runs": [dataclasses.asdict(run) | {"reported": run.reported(), "named": run.named()}
                                for run in runs]}, indent=1)
