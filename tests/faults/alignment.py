"""Alignment of poses to true poses, without any library.

A pose is (R, t): a 3x3 rotation as a tuple of rows and a position, T_world_cam. An alignment is
(s, R, t): it maps a position p to s R p + t and a rotation Q to R Q.
"""
import math

IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def product(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)) for i in range(3))


def transposed(a):
    return tuple(zip(*a))


def rotated(a, p):
    return tuple(sum(a[i][k] * p[k] for k in range(3)) for i in range(3))


def distance(p, q):
    return math.dist(p, q)


def angle_deg(a, b):
    """The angle of the rotation between two rotations."""
    trace = sum(a[i][k] * b[i][k] for i in range(3) for k in range(3))
    return math.degrees(math.acos(max(-1.0, min(1.0, (trace - 1) / 2))))


def largest_eigenvector(matrix):
    """Of a symmetric 4x4 matrix, by Jacobi rotations."""
    a = [list(row) for row in matrix]
    v = [[float(i == j) for j in range(4)] for i in range(4)]
    for _ in range(50):
        off = sum(a[i][j] ** 2 for i in range(4) for j in range(4) if i != j)
        if off <= 1e-26 * sum(a[i][i] ** 2 for i in range(4)):
            break
        for p in range(3):
            for q in range(p + 1, 4):
                rotate(a, v, p, q)
    best = max(range(4), key=lambda i: a[i][i])
    return [v[i][best] for i in range(4)]


def rotate(a, v, p, q):
    """One Jacobi rotation that makes a[p][q] zero."""
    if a[p][q] == 0:
        return
    theta = (a[q][q] - a[p][p]) / (2 * a[p][q])
    t = math.copysign(1, theta) / (abs(theta) + math.sqrt(theta * theta + 1))
    c = 1 / math.sqrt(t * t + 1)
    s = t * c
    for k in range(4):
        a[k][p], a[k][q] = c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]
    for k in range(4):
        a[p][k], a[q][k] = c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]
    for k in range(4):
        v[k][p], v[k][q] = c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]


def rotation_of(quaternion):
    w, x, y, z = quaternion
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def best_rotation(B):
    """The rotation R that maximizes the sum of R[i][j] B[i][j] (Horn 1987)."""
    N = [[B[0][0] + B[1][1] + B[2][2], B[2][1] - B[1][2], B[0][2] - B[2][0], B[1][0] - B[0][1]],
         [0, B[0][0] - B[1][1] - B[2][2], B[0][1] + B[1][0], B[0][2] + B[2][0]],
         [0, 0, B[1][1] - B[0][0] - B[2][2], B[1][2] + B[2][1]],
         [0, 0, 0, B[2][2] - B[0][0] - B[1][1]]]
    for i in range(4):
        for j in range(i):
            N[i][j] = N[j][i]
    return rotation_of(largest_eigenvector(N))


def align(poses, true_poses, lever_m, with_scale):
    """The least-squares alignment of poses to true ones, in equal number.

    Rotations take part as points `lever_m` from the camera along its axes, so that a straight path
    leaves no rotation free.
    """
    count = len(poses)
    middle = [sum(t[k] for _, t in poses) / count for k in range(3)]
    true_middle = [sum(t[k] for _, t in true_poses) / count for k in range(3)]
    from_middle = [tuple(t[k] - middle[k] for k in range(3)) for _, t in poses]
    true_from_middle = [tuple(t[k] - true_middle[k] for k in range(3)) for _, t in true_poses]
    B = [[0.0] * 3 for _ in range(3)]
    # The lever is metres of the truth; the estimate's positions may have another unit.
    spread = sum(x * x for p in from_middle for x in p)
    true_spread = sum(x * x for p in true_from_middle for x in p)
    ratio = math.sqrt(true_spread / spread) if with_scale and spread > 0 and true_spread > 0 else 1.0
    for p, q, (R, _), (Q, _) in zip(from_middle, true_from_middle, poses, true_poses):
        relative = product(Q, transposed(R))
        for i in range(3):
            for j in range(3):
                B[i][j] += ratio * q[i] * p[j] + lever_m ** 2 * relative[i][j]
    R = best_rotation(B)
    s = 1.0
    if with_scale and spread > 0:
        turned = (rotated(R, p) for p in from_middle)
        s = sum(q[k] * p[k] for p, q in zip(turned, true_from_middle) for k in range(3)) / spread
        s = s if s > 0 else 1.0
    moved = rotated(R, middle)
    return s, R, tuple(true_middle[k] - s * moved[k] for k in range(3))


def aligned(alignment, pose):
    s, R, t = alignment
    p = rotated(R, pose[1])
    return product(R, pose[0]), tuple(s * p[k] + t[k] for k in range(3))
