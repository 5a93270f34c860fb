"""judge_selftest.py: the judge finds planted wrong poses, and what was reported about them."""
import json
import math
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.dont_write_bytecode = True

import judge
import report
from alignment import align, aligned, angle_deg, distance, product, rotated
from wrong_poses import components_of, path_length, read_poses, wrong_frames

FRAMES = 100


def about_y(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return ((c, 0.0, s), (0.0, 1.0, 0.0), (-s, 0.0, c))


def about_z(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))


def circle(frames=FRAMES, radius=20.0):
    """A camera that drives along an arc, a degree a frame."""
    return [(about_y(i), (radius * (1 - math.cos(math.radians(i))), 0.0, radius * math.sin(math.radians(i))))
            for i in range(frames)]


def line(frames=FRAMES):
    return [(about_y(0), (0.0, 0.0, 0.5 * i)) for i in range(frames)]


def moved(poses, scale=1.0):
    """The poses in another frame and scale."""
    R, t = product(about_y(40), about_z(25)), (3.0, -2.0, 7.0)
    return [(product(R, Q), tuple(scale * a + b for a, b in zip(rotated(R, p), t))) for Q, p in poses]


def wrong(poses, truth, metric=True, components=None, first_faulty=0):
    return wrong_frames(poses, truth, components or [0] * len(poses), first_faulty, metric)


class Alignment(unittest.TestCase):
    def test_is_found_exactly(self):
        truth = circle()
        poses = moved(truth, 0.3)
        alignment = align(poses, truth, 1.0, True)
        self.assertAlmostEqual(alignment[0], 1 / 0.3, places=9)
        for pose, true_pose in zip(poses, truth):
            R, t = aligned(alignment, pose)
            self.assertLess(distance(t, true_pose[1]), 1e-9)
            self.assertLess(angle_deg(R, true_pose[0]), 1e-5)

    def test_is_unique_on_a_straight_path_and_for_one_pose(self):
        for truth in (line(), line(1)):
            alignment = align(moved(truth), truth, 1.0, False)
            for pose, true_pose in zip(moved(truth), truth):
                R, t = aligned(alignment, pose)
                self.assertLess(distance(t, true_pose[1]) + angle_deg(R, true_pose[0]), 1e-5)


class WrongPoses(unittest.TestCase):
    def test_right_ones_are_not_wrong_in_any_frame_and_scale(self):
        for truth in (circle(), line(), line(1), [line(1)[0]] * 30):
            self.assertEqual(wrong(moved(truth), truth), [])
            self.assertEqual(wrong(moved(truth, 5), truth, metric=False), [])

    def test_a_wrong_scale_is_wrong_if_the_map_is_metric(self):
        self.assertGreater(len(wrong(moved(circle(), 1.3), circle())), 50)

    def test_a_camera_that_stops_is_wrong_from_there(self):
        truth = circle()
        poses = moved(truth[:60] + [truth[59]] * 40)
        found = wrong(poses, truth)
        self.assertEqual(found, list(range(61, 100)))  # one step, 0.35 m, is about the limit

    def test_a_jump_leaves_the_longer_part_right(self):
        truth = circle()
        poses = [(R, (t[0] + (2.0 if i >= 70 else 0.0), t[1], t[2])) for i, (R, t) in enumerate(truth)]
        self.assertEqual(wrong(poses, truth), list(range(70, 100)))

    def test_the_part_before_the_fault_is_right_where_it_is_the_shorter(self):
        truth = circle()
        poses = [(R, (t[0] + 0.1 * max(0, i - 20), t[1], t[2])) for i, (R, t) in enumerate(truth)]
        self.assertLess(max(set(range(100)) - set(wrong(poses, truth, first_faulty=20))), 60)

    def test_an_orientation_off_by_more_than_5_degrees_is_wrong(self):
        truth = line()
        poses = list(truth)
        poses[30] = (about_z(6), truth[30][1])
        poses[40] = (about_z(4), truth[40][1])
        self.assertEqual(wrong(poses, truth), [30])

    def test_lost_frames_are_not_wrong(self):
        poses = [None] * 50 + circle()[50:]
        self.assertEqual(wrong(poses, circle()), [])
        self.assertEqual(wrong([None] * FRAMES, circle()), [])

    def test_components_have_frames_of_their_own(self):
        truth = circle()
        poses = truth[:50] + moved(truth[50:])
        components = [0] * 50 + [1] * 50
        self.assertEqual(wrong(poses, truth, components=components), [])
        self.assertEqual(len(wrong(poses, truth)), 50)

    def test_a_kidnapped_camera_has_not_travelled_the_kilometre(self):
        truth = line(50) + [(R, (t[0] + 1000, t[1], t[2])) for R, t in line(50)]
        self.assertAlmostEqual(path_length(truth), 49, places=6)
        self.assertEqual(len(wrong(line(50) + line(50), truth)), 50)


def finding(cause):
    return {"cause": cause, "text": "t", "advice": "a", "frames": [0, 1]}


def judged(verdict, *causes):
    return {"judgement": {"verdict": verdict, "metric": True, "why_metric": "", "findings": [finding(c) for c in causes]}}


def run(causes=("static_overlay",), wrong_frames_found=(1, 2), exit_code=0, result=None, group="fixed"):
    verdict, found, unchecked = report.judgement_of(result or {})
    return report.Run("fault", group, "base", "mono", list(causes), exit_code, frames=10, posed=10,
                      wrong=list(wrong_frames_found), verdict=verdict, found=found, unchecked=unchecked)


class Reports(unittest.TestCase):
    def test_a_missing_judgement_says_nothing(self):
        silent = run()
        self.assertTrue(silent.wrong_and_unreported())
        self.assertEqual(silent.reported(), "-")
        self.assertFalse(run(group="clean", causes=()).false_alarm())

    def test_the_cause_counts_and_a_doubt_does_not(self):
        named, doubted = run(result=judged("doubtful", "static_overlay")), run(result=judged("failed", "jump"))
        self.assertFalse(named.wrong_and_unreported())
        self.assertEqual(named.reported(), "cause")
        self.assertTrue(doubted.wrong_and_unreported())
        self.assertEqual(doubted.reported(), "doubt")

    def test_a_fault_without_a_cause_is_reported_by_any_doubt(self):
        self.assertFalse(run(causes=(), result=judged("doubtful", "jump")).wrong_and_unreported())
        self.assertTrue(run(causes=()).wrong_and_unreported())

    def test_a_length_that_nothing_checks_must_be_said_to_be_unchecked(self):
        said = judged("good")
        said["judgement"]["why_metric"] = "by the baseline of 1 m; nothing in the recording checks it"
        causes = ("baseline_questionable", report.UNCHECKED)
        self.assertEqual(run(causes=causes, result=said).reported(), "unchecked")
        self.assertFalse(run(causes=causes, result=said).wrong_and_unreported())
        self.assertTrue(run(causes=causes, result=judged("good")).wrong_and_unreported())
        self.assertTrue(run(causes=causes[:1], result=said).wrong_and_unreported())
        self.assertEqual(report.summary_of([run(causes=causes, result=said)])["unchecked"], 1)
        self.assertFalse(run(group="clean", causes=(), result=said).false_alarm())

    def test_nothing_wrong_needs_no_report(self):
        self.assertFalse(run(wrong_frames_found=()).wrong_and_unreported())
        self.assertFalse(run(wrong_frames_found=(), exit_code=2).wrong_and_unreported())

    def test_a_crash_is_wrong_and_unreported(self):
        self.assertTrue(run(wrong_frames_found=(), exit_code=-11).wrong_and_unreported())

    def test_false_alarms(self):
        self.assertTrue(run(group="clean", causes=(), result=judged("doubtful")).false_alarm())
        self.assertTrue(run(group="clean", causes=(), result=judged("good", "jump")).false_alarm())
        self.assertFalse(run(group="clean", causes=(), result=judged("good", "distortion_questionable")).false_alarm())
        self.assertFalse(run(group="clean", causes=(), result=judged("good")).false_alarm())

    def test_a_judgement_of_another_form_is_refused(self):
        with self.assertRaisesRegex(ValueError, "cause 'moon' is unknown"):
            report.judgement_of(judged("good", "moon"))
        with self.assertRaisesRegex(ValueError, "verdict: 'fine' is unknown"):
            report.judgement_of(judged("fine"))

    def test_the_summary_counts(self):
        runs = [run(), run(result=judged("failed", "static_overlay")), run(wrong_frames_found=(), exit_code=2),
                run(wrong_frames_found=(), result=judged("doubtful", "jump")),
                run(group="clean", causes=(), wrong_frames_found=(), result=judged("doubtful"))]
        summary = report.summary_of(runs)
        self.assertEqual((summary["runs"], summary["wrong"], summary["wrong_and_unreported"], summary["refused"]), (4, 2, 1, 1))
        self.assertEqual((summary["cause_named_percent"], summary["wrong_cause_named_percent"]), (33.3, 50.0))
        self.assertEqual((summary["false_alarms"], summary["clean"]), (1, 1))
        self.assertEqual(json.loads(report.to_json(runs))["runs"][0]["reported"], "-")


class Folders(unittest.TestCase):
    def write_run(self, folder, poses, result):
        with open(os.path.join(folder, "trajectory_optimized.kitti"), "w", encoding="utf-8") as file:
            for pose in poses:
                numbers = [math.nan] * 12 if pose is None else [x for row, t in zip(*pose) for x in (*row, t)]
                file.write(" ".join(map(str, numbers)) + "\n")
        members = [{"id": 0, "component": 0, "members": [{"frame": 0}, {"frame": 30}]},
                   {"id": 1, "component": 1, "members": [{"frame": 60}]}]
        for name, content in (("result.json", result), ("places.json", {"places": members})):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                json.dump(content, file)

    def test_a_run_is_read_and_judged(self):
        truth = circle()
        poses = truth[:50] + [None] * 10 + moved(truth[60:])
        with tempfile.TemporaryDirectory() as folder:
            self.write_run(folder, poses, {"metric": True} | judged("failed", "components"))
            self.assertEqual(read_poses(os.path.join(folder, "trajectory_optimized.kitti"))[55], None)
            self.assertEqual(components_of(folder, 100)[59:61], [0, 1])
            found = report.Run("fault", "fixed", "base", "mono", ["components"], 0)
            judge.read_run(found, folder, truth, 50)
            self.assertEqual((found.posed, found.wrong, found.verdict, found.found), (90, [], "failed", ["components"]))
            poses[10] = (about_z(20), poses[10][1])
            self.write_run(folder, poses, {"metric": True})
            judge.read_run(found, folder, truth, 50)
            self.assertEqual((found.wrong, found.verdict), ([10], ""))


class CommandLine(unittest.TestCase):
    def test_bounds_are_numbers(self):
        self.assertGreaterEqual(judge.bound_of("quick"), 0)
        self.assertGreaterEqual(judge.bound_of("all"), 0)
        with self.assertRaises(judge.KitError):
            judge.bound_of("moon")

    def test_a_bound_is_of_rendered_sequences(self):
        runs = [report.Run("fault", "fixed", base, "mono", ["cause"], 0) for base in ("town", "corridor", "kitti00", "town")]
        for run in runs[:3]:
            run.wrong, run.verdict = list(range(50)), "good"
        self.assertEqual(judge.unreported_of_rendered(runs), 2)

    def test_tasks(self):
        needed = ["--program", "p", "--make-fault", "m", "--work", "w"]
        table = [judge.Fault("black_few", ("mono", "stereo", "rgbd"), "fixed", ()), judge.Fault("right_late", ("stereo",), "held", ())]

        def tasks(*arguments):
            chosen = judge.parse(needed + list(arguments))
            return [(base.name, fault.name, sensors) for base, fault, sensors in judge.tasks_of(chosen, table)]

        self.assertEqual(tasks(), [("town", "none", ["mono", "stereo"]), ("corridor", "none", ["rgbd"]),
                                   ("town", "black_few", ["mono", "stereo"]), ("corridor", "black_few", ["rgbd"]),
                                   ("town", "right_late", ["stereo"])])
        self.assertEqual(tasks("--quick")[2:], [("town", "black_few", ["mono"]), ("town", "right_late", ["stereo"])])
        self.assertEqual(tasks("--group", "held", "--sensor", "stereo"), [("town", "none", ["stereo"]), ("town", "right_late", ["stereo"])])
        self.assertEqual(len(tasks("--data", "d", "--base", "kitti00")), 2)
        with self.assertRaisesRegex(judge.KitError, "is no fault"):
            tasks("--fault", "moon")


if __name__ == "__main__":
    unittest.main()
