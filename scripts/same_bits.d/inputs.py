"""Small inputs that the cases write themselves. The same file on every machine: no clock, a seeded generator."""
import math
import os
import random
import shutil


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def rows(numbers):
    return "".join(" ".join(f"{value:.9g}" for value in row) + "\n" for row in numbers)


def rotation_y(angle):
    c, s = math.cos(angle), math.sin(angle)
    return [[c, 0, s], [0, 1, 0], [-s, 0, c]]


def transformed(R, t, p):
    return [sum(R[i][j] * p[j] for j in range(3)) + t[i] for i in range(3)]


def projected(p, f=460.0, cx=320.0, cy=240.0):
    return [f * p[0] / p[2] + cx, f * p[1] / p[2] + cy]


def camera_of(path, sequence, size):
    """K.txt of a sequence in KITTI's layout; the size is `width height` [px]."""
    with open(os.path.join(sequence, "calib.txt"), encoding="utf-8") as file:
        P = file.readline().split()[1:]
    write(path, f"{P[0]} {P[5]} {P[2]} {P[6]} {size}\n")


def camera_of_flight(path, flight):
    """K.txt of a flight in EuRoC's layout."""
    found = {}
    with open(os.path.join(flight, "mav0", "cam0", "sensor.yaml"), encoding="utf-8") as file:
        for line in file:
            name, _, value = line.partition(":")
            if name in ("intrinsics", "resolution"):
                found[name] = value.strip(" []\n").replace(",", "")
    write(path, f"{found['intrinsics']} {found['resolution']}\n")


def views(folder):
    """Point matches of two views of a scene, for motion and planes: general, two planes, pure rotation, points in space."""
    rng = random.Random(7)
    noise = lambda: rng.gauss(0, 0.3)
    R, t = rotation_y(0.06), [0.25, 0.02, -0.1]
    general, planar, turned, seen, pairs = [], [], [], [], []
    for i in range(240):
        p = [rng.uniform(-2, 2), rng.uniform(-1.4, 1.4), rng.uniform(4, 9)]
        if i < 20:  # false matches
            general.append([rng.uniform(0, 640), rng.uniform(0, 480), rng.uniform(0, 640), rng.uniform(0, 480)])
        else:
            general.append([v + noise() for v in projected(p) + projected(transformed(R, t, p))])
        depth = 5 + 0.5 * p[0] if i % 2 else 8 - 0.3 * p[1]
        q = [p[0], p[1], depth]
        planar.append([v + noise() for v in projected(q) + projected(transformed(R, t, q))])
        turned.append([v + noise() for v in projected(p) + projected(transformed(R, [0, 0, 0], p))])
        seen.append(p + [v + noise() for v in projected(transformed(R, t, p))])
        pairs.append([v + rng.gauss(0, 0.01) for v in p + transformed(R, t, p)])
    for name, numbers in (("general", general), ("planar", planar), ("turned", turned), ("seen", seen), ("pairs", pairs)):
        write(os.path.join(folder, name + ".txt"), rows(numbers))
    write(os.path.join(folder, "K.txt"), "460 460 320 240 640 480\n")


def cloud(path):
    """Points of a floor, two walls and a box, without order."""
    rng = random.Random(11)
    points = []
    for _ in range(6000):
        u, v, n = rng.uniform(-2, 2), rng.uniform(0, 2.5), rng.gauss(0, 0.004)
        kind = rng.randrange(4)
        points.append(([u, 1.2 + n, 1 + v], [u, 1.2 - v, 3.5 + n], [-2 + n, 1.2 - v, 1 + u / 2 + 1.2],
                       [0.4 + u / 8, 0.9 + n, 2 + v / 8])[kind])
    write(path, rows(points))


def segments(path):
    """Line segments that point to three vanishing points at right angles."""
    rng = random.Random(5)
    R = rotation_y(0.3)
    lines = []
    for i in range(150):
        p = [rng.uniform(-2, 2), rng.uniform(-1.5, 1.5), rng.uniform(4, 9)]
        q = list(p)
        for k in range(3):
            q[k] += rng.uniform(0.4, 0.9) * R[k][i % 3]
        lines.append([v + rng.gauss(0, 0.2) for v in projected(p) + projected(q)])
    write(path, rows(lines))


def circle_on_earth(folder):
    """Planar graph of a drive round a circle, its times and its GPS readings."""
    count, radius, angle, rate = 100, 20.0, 2 * math.pi / 50, 0.1
    chord = 2 * radius * math.sin(angle / 2)
    graph = "".join(f"VERTEX_SE2 {i} {radius * math.sin(i * angle):.9f} {radius - radius * math.cos(i * angle):.9f} {i * angle:.9f}\n" for i in range(count))
    for i in range(1, count):
        graph += f"EDGE_SE2 {i - 1} {i} {chord * math.cos(angle / 2):.9f} {chord * math.sin(angle / 2):.9f} {angle:.9f} 1e4 0 0 1e4 0 1e6\n"
    rng = random.Random(3)
    metre = math.degrees(1 / 6378137.0)
    readings = ""
    for i in range(count):
        east, north = radius * math.cos(i * angle) - radius + rng.gauss(0, 0.1), radius * math.sin(i * angle) + rng.gauss(0, 0.1)
        readings += (f"{49 + north * metre:.12f} {8.4 + east * metre / math.cos(math.radians(49)):.12f} {115 + rng.gauss(0, 0.1):.4f}"
                     + " 0" * 20 + " 0.1 0 4 8 -1 -1 -1\n")
    write(os.path.join(folder, "graph.g2o"), graph)
    write(os.path.join(folder, "oxts.txt"), readings)
    for name in ("times.txt", "times_oxts.txt"):
        write(os.path.join(folder, name), "".join(f"{i * rate:.3f}\n" for i in range(count)))


def small_graphs(folder):
    """Pose graphs in the forms of TORO and iSAM."""
    square = [(0, 1), (1, 2), (2, 3), (3, 0)]
    write(os.path.join(folder, "toro.graph"),
          "".join(f"VERTEX2 {i} {x} {y} {a}\n" for i, (x, y, a) in enumerate([(0, 0, 0), (1.1, 0, 1.5), (1, 1.05, 3.1), (0.1, 1, -1.6)]))
          + "".join(f"EDGE2 {i} {j} 1 0 1.5707963267948966 10 0 10 40 0 0\n" for i, j in square))
    write(os.path.join(folder, "isam.txt"),
          "".join(f"ODOMETRY {i} {j} 1 0 1.5707963267948966 1 0 0 1 0 1\n" for i, j in square[:3])
          + "EDGE2 3 0 1 0.02 1.56 1 0 0 1 0 1\n")


def bundle(path):
    """A problem in the form of BAL: four cameras, sixty points, disturbed."""
    rng = random.Random(13)
    points = [[rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-9, -6)] for _ in range(60)]
    cameras = [[0, 0.05 * k, 0, 0.3 * k, 0.1 * (k % 2), 0, 500, 0, 0] for k in range(4)]
    lines = [f"4 {len(points)} {4 * len(points)}"]
    for j, p in enumerate(points):
        for k, camera in enumerate(cameras):
            q = transformed(rotation_y(camera[1]), camera[3:6], p)
            lines.append(f"{k} {j} {-500 * q[0] / q[2] + rng.gauss(0, 0.5):.6e} {-500 * q[1] / q[2] + rng.gauss(0, 0.5):.6e}")
    disturbed = lambda values, sigma: [f"{v + rng.gauss(0, sigma):.12e}" for v in values]
    for camera in cameras:
        lines += disturbed(camera[:3], 0.002) + disturbed(camera[3:6], 0.02) + [f"{v:.12e}" for v in camera[6:]]
    for p in points:
        lines += disturbed(p, 0.05)
    write(path, "\n".join(lines) + "\n")


def rounds(path, count):
    """Poses of a drive `count` times round a block, one a metre, each round 0.3 m beside the last."""
    r, side = 12.0, 25.0
    arc = math.pi * r
    length = 2 * (side + arc)
    lines = []
    for k in range(count):
        for s in range(int(length)):
            d, turn, back = (s, 0.0, False) if s < side + arc else (s - side - arc, math.pi, True)
            a, x, z = (0.0, 0.0, d) if d < side else ((d - side) / r, r * (1 - math.cos((d - side) / r)), side + r * math.sin((d - side) / r))
            if back:
                x, z = 2 * r - x, side - z
            a += turn
            c, n = math.cos(a), math.sin(a)
            lines.append([c, 0, n, x + 0.3 * k * c, 0, 1, 0, 0, -n, 0, c, z - 0.3 * k * n])
    write(path, rows(lines))


def turning(path):
    """Poses of a camera that drives, turns on the spot and drives on."""
    lines, a, x, z = [], 0.0, 0.0, 0.0
    for i in range(60):
        if 20 <= i < 40:
            a += math.radians(3)
        else:
            x, z = x + 0.4 * math.sin(a), z + 0.4 * math.cos(a)
        c, n = math.cos(a), math.sin(a)
        lines.append([c, 0, n, x, 0, 1, 0, 0, -n, 0, c, z])
    write(path, rows(lines))


def damaged(folder, sequence, image):
    """A copy of a sequence with one image that is cut off."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(sequence, folder)
    path = os.path.join(folder, image)
    os.truncate(path, os.path.getsize(path) // 2)


def mended(folder, sequence, image):
    shutil.copyfile(os.path.join(sequence, image), os.path.join(folder, image))


def labelled_places(folder, sequence, count):
    """Images of a sequence in three labelled stretches; every second one is learned, the others are told."""
    shutil.rmtree(folder, ignore_errors=True)
    images = sorted(os.listdir(os.path.join(sequence, "image_0")))[: int(count)]
    os.makedirs(os.path.join(folder, "images"))
    learned = len(images) // 2
    order = images[0::2][:learned] + images[1::2]
    for i, name in enumerate(order):
        shutil.copyfile(os.path.join(sequence, "image_0", name), os.path.join(folder, "images", f"{i:06d}" + os.path.splitext(name)[1]))
    write(os.path.join(folder, "labels.txt"), "".join(f"{i} {3 * images.index(name) // len(images)}\n" for i, name in enumerate(order)))
    write(os.path.join(folder, "names.txt"), "near\nmiddle\nfar\n")


def labelled_streets(folder, sequence, count):
    """A rendered sequence with labels as a set to learn from: train, and val that judges."""
    shutil.rmtree(folder, ignore_errors=True)
    names = sorted(os.listdir(os.path.join(sequence, "image_0")))[: int(count)]
    for i, name in enumerate(names):
        part = "val" if i % 4 == 3 else "train"
        for kind, source in (("images", "image_0"), ("labels", "labels_0")):
            os.makedirs(os.path.join(folder, part, kind), exist_ok=True)
            shutil.copyfile(os.path.join(sequence, source, name), os.path.join(folder, part, kind, f"drive_{name}"))
    shutil.copyfile(os.path.join(sequence, "CLASSES.txt"), os.path.join(folder, "CLASSES.txt"))


def first_marker(path, layout):
    """The layout of a flight in which the first marker alone has a place."""
    lines, seen = [], 0
    with open(layout, encoding="utf-8") as file:
        for line in file:
            if line.startswith("beacons"):
                lines.append("beacons: []\n")
                break
            if "side_m" in line:
                seen += 1
                if seen > 1 and ", position" in line:
                    line = line[: line.index(", position")] + "}\n"
            lines.append(line)
    write(path, "".join(lines))


def texts(folder, *pairs):
    """Files with a given text: name, text, name, text, ..."""
    for name, text in zip(pairs[0::2], pairs[1::2]):
        write(os.path.join(folder, name), text)


def first_lines(path, source, count):
    with open(source, encoding="utf-8") as file:
        lines = file.readlines()
    write(path, "".join(lines[: int(count)]))


def stamped_images(folder, flight):
    """The images of a flight as a folder, numbered."""
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    source = os.path.join(flight, "mav0", "cam0", "data")
    for i, name in enumerate(sorted(os.listdir(source), key=lambda n: int(n.split(".")[0]))):
        shutil.copyfile(os.path.join(source, name), os.path.join(folder, f"{i:06d}.png"))


def drive_on_earth(folder, sequence):
    """GPS readings of a sequence from its true poses: x is east, z is north, height is against y."""
    rng = random.Random(17)
    metre = math.degrees(1 / 6378137.0)
    readings = ""
    with open(os.path.join(sequence, "poses.txt"), encoding="utf-8") as file:
        for line in file:
            pose = [float(v) for v in line.split()]
            east, up, north = pose[3] + rng.gauss(0, 0.2), -pose[7] + rng.gauss(0, 0.2), pose[11] + rng.gauss(0, 0.2)
            readings += (f"{49 + north * metre:.12f} {8.4 + east * metre / math.cos(math.radians(49)):.12f} {115 + up:.4f}"
                         + " 0" * 20 + " 0.2 0 4 8 -1 -1 -1\n")
    write(os.path.join(folder, "oxts.txt"), readings)
    shutil.copyfile(os.path.join(sequence, "times.txt"), os.path.join(folder, "times_oxts.txt"))


def quaternion(R):
    """x y z w of a rotation matrix, by its largest component."""
    t = R[0][0] + R[1][1] + R[2][2]
    squares = [1 + 2 * R[0][0] - t, 1 + 2 * R[1][1] - t, 1 + 2 * R[2][2] - t, 1 + t]
    k = max(range(4), key=lambda i: squares[i])
    off = [R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]]
    q = [0.0] * 4
    if k == 3:
        q = off + [squares[3]]
    else:
        for i in range(3):
            q[i] = squares[k] if i == k else R[i][k] + R[k][i]
        q[3] = off[k]
    norm = math.sqrt(sum(v * v for v in q))
    return [v / norm for v in q]


def graph_of_poses(path, poses, count):
    """A chain of relative poses in g2o's form, slightly disturbed."""
    rng = random.Random(19)
    with open(poses, encoding="utf-8") as file:
        matrices = [[float(v) for v in line.split()] for line in file.readlines()[: int(count)]]
    parts = [([m[0:3], m[4:7], m[8:11]], [m[3], m[7], m[11]]) for m in matrices]
    text = lambda t, R: " ".join(f"{v:.12g}" for v in t + quaternion(R))
    graph = "".join(f"VERTEX_SE3:QUAT {i} {text(t, R)}\n" for i, (R, t) in enumerate(parts))
    information = " 2500 0 0 0 0 0 2500 0 0 0 0 2500 0 0 0 1e6 0 0 1e6 0 1e6\n"
    for i in range(1, len(parts)):
        (A, a), (B, b) = parts[i - 1], parts[i]
        R = [[sum(A[k][r] * B[k][c] for k in range(3)) for c in range(3)] for r in range(3)]
        t = [sum(A[k][r] * (b[k] - a[k]) for k in range(3)) + rng.gauss(0, 0.02) for r in range(3)]
        graph += f"EDGE_SE3:QUAT {i - 1} {i} {text(t, R)}{information}"
    write(path, graph)


def first_pictures(folder, labelled_set, count):
    """The first pictures of the judging part of a labelled set."""
    shutil.rmtree(folder, ignore_errors=True)
    for kind in ("images", "labels"):
        os.makedirs(os.path.join(folder, kind))
        for name in sorted(os.listdir(os.path.join(labelled_set, "val", kind)))[: int(count)]:
            shutil.copyfile(os.path.join(labelled_set, "val", kind, name), os.path.join(folder, kind, name))
    shutil.copyfile(os.path.join(labelled_set, "CLASSES.txt"), os.path.join(folder, "CLASSES.txt"))
