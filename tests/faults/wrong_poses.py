"""Which poses of a run are wrong."""
import bisect
import json
import math
import os

from alignment import align, aligned, angle_deg, distance

FRACTION_OF_PATH = 0.01
LEAST_M = 0.1
LARGEST_DEG = 5.0
FEWEST_FOR_ALIGNMENT = 10  # frames before a fault, to align by them alone


def read_poses(path):
    """Poses of a KITTI file, None where a frame is lost."""
    poses = []
    with open(path, encoding="utf-8") as file:
        for line in file:
            n = [float(x) for x in line.split()]
            lost = any(math.isnan(x) for x in n)
            poses.append(None if lost else (((n[0], n[1], n[2]), (n[4], n[5], n[6]), (n[8], n[9], n[10])),
                                            (n[3], n[7], n[11])))
    return poses


def components_of(out, count):
    """The component of each frame: that of the last keyframe up to it, by places.json."""
    with open(os.path.join(out, "places.json"), encoding="utf-8") as file:
        places = json.load(file)["places"]
    keyframes = sorted((member["frame"], place.get("component", 0)) for place in places for member in place["members"])
    frames = [frame for frame, _ in keyframes]
    if not frames:
        return [0] * count
    return [keyframes[max(0, bisect.bisect_right(frames, i) - 1)][1] for i in range(count)]


def path_length(true_poses):
    """The path travelled. A step ten times as long as the median one is a jump, which is not."""
    steps = [distance(a[1], b[1]) for a, b in zip(true_poses, true_poses[1:])]
    moving = sorted(step for step in steps if step > 0)
    largest = 10 * moving[len(moving) // 2] if moving else 0
    return sum(step for step in steps if step <= largest)


def wrong_of(numbers, poses, truth, alignment, limit_m):
    wrong = set()
    for number in numbers:
        R, t = aligned(alignment, poses[number])
        if distance(t, truth[number][1]) > limit_m or angle_deg(R, truth[number][0]) > LARGEST_DEG:
            wrong.add(number)
    return wrong


def wrong_in_component(numbers, poses, truth, first_faulty, metric):
    """The wrong frames of one component, after the alignment that leaves fewest.

    It is aligned by all its frames, by those before the fault, and by those that are right after
    an alignment, again and again.
    """
    path_m = path_length(truth[numbers[0]:numbers[-1] + 1])
    limit_m = max(FRACTION_OF_PATH * path_m, LEAST_M)
    # An error of LARGEST_DEG moves a point at this distance by limit_m.
    lever_m = limit_m / math.radians(LARGEST_DEG)

    def wrong_after(used):
        alignment = align([poses[n] for n in used], [truth[n] for n in used], lever_m, not metric)
        return wrong_of(numbers, poses, truth, alignment, limit_m)

    starts = [numbers]
    before = [n for n in numbers if n < first_faulty]
    if len(before) >= FEWEST_FOR_ALIGNMENT:
        starts.append(before)
    for third in range(3):
        starts.append(numbers[third * len(numbers) // 3:(third + 1) * len(numbers) // 3])
    best = set(numbers)
    for used in starts:
        for _ in range(10):
            if len(used) < min(FEWEST_FOR_ALIGNMENT, len(numbers)):
                break
            wrong = wrong_after(used)
            best = min(best, wrong, key=len)
            right = [n for n in numbers if n not in wrong]
            if right == used:
                break
            used = right
    return best


def wrong_frames(poses, truth, components, first_faulty, metric):
    """Numbers of the frames whose pose is wrong: off by more than 1 % of the component's path and
    0.1 m, or 5 degrees. Lost frames are not wrong."""
    wrong = set()
    posed = [n for n, pose in enumerate(poses) if pose is not None]
    for component in sorted({components[n] for n in posed}):
        numbers = [n for n in posed if components[n] == component]
        wrong |= wrong_in_component(numbers, poses, truth, first_faulty, metric)
    return sorted(wrong)
