"""Clouds and meshes of a map, read by trimesh and open3d where they are installed, and the surfaces that were rendered.

check_dense(placegraph, check, package) renders a drive through a corridor with its true surfaces, exports the cloud and
the mesh of its maps, and compares them with the surfaces; check_bundle compares an adjusted model with pycolmap's.
"""

import pathlib
import re

import numpy
from scipy.spatial import cKDTree

FRAMES = 60
SIZE = (640, 480)


class Surfaces:
    """The polygons of scene.ply that are near a path; all have right angles."""

    def __init__(self, path, low, high, step):
        lines = pathlib.Path(path).read_text().split("\n")
        begin = lines.index("end_header") + 1
        count = int(next(line for line in lines if line.startswith("element vertex")).split()[-1])
        corners = numpy.array([line.split() for line in lines[begin:begin + count]], float)
        self.origins, self.first, self.second, samples, owners = [], [], [], [], []
        for line in lines[begin + count:]:
            if not line:
                continue
            polygon = corners[[int(number) for number in line.split()[1:1 + int(line.split()[0])]]]
            if (polygon.max(0) < low).any() or (polygon.min(0) > high).any():
                continue
            origin, a, b = polygon[0], polygon[1] - polygon[0], polygon[-1] - polygon[0]
            along, across = (numpy.linspace(0, 1, max(2, int(numpy.linalg.norm(side) / step) + 1)) for side in (a, b))
            grid = (origin + along[:, None, None] * a + across[None, :, None] * b).reshape(-1, 3)
            samples.append(grid)
            owners.append(numpy.full(len(grid), len(self.origins)))
            self.origins.append(origin), self.first.append(a), self.second.append(b)
        self.origins, self.first, self.second = (numpy.array(part) for part in (self.origins, self.first, self.second))
        self.owners, self.tree = numpy.concatenate(owners), cKDTree(numpy.vstack(samples))

    def distances(self, points, neighbours=12):
        """Of points to the polygons of the samples near them."""
        near = self.owners[self.tree.query(points, neighbours)[1]]
        origins, a, b = self.origins[near], self.first[near], self.second[near]
        offsets = points[:, None] - origins
        s, t = (numpy.clip((offsets * side).sum(2) / (side * side).sum(2), 0, 1) for side in (a, b))
        return numpy.linalg.norm(offsets - s[..., None] * a - t[..., None] * b, axis=2).min(1)


def seen_points(placegraph, sequence, image, far_m):
    """Points of the true surfaces that the cameras saw up to a distance, one in each 5 cm."""
    fx, cx, fy, cy = numpy.array(open(placegraph.at(f"{sequence}/calib.txt")).readline().split()[1:], float)[[0, 2, 5, 6]]
    poses = numpy.loadtxt(placegraph.at(f"{sequence}/poses.txt")).reshape(-1, 3, 4)
    points = []
    for i in range(0, len(poses), 4):
        depth = numpy.asarray(image.open(placegraph.at(f"{sequence}/depth_0/{i:06d}.png")))[::3, ::3] * 0.001
        v, u = 3 * numpy.mgrid[:depth.shape[0], :depth.shape[1]]
        z = depth[(depth > 0) & (depth < far_m)]
        u, v = (pixels[(depth > 0) & (depth < far_m)] for pixels in (u, v))
        points.append(numpy.stack([(u - cx) / fx * z, (v - cy) / fy * z, z], 1) @ poses[i, :, :3].T + poses[i, :, 3])
    points = numpy.vstack(points)
    return points[numpy.unique(numpy.floor(points / 0.05).astype(int), axis=0, return_index=True)[1]], poses


def check_cloud(placegraph, check, trimesh, sensor, surfaces, seen, most_m, least_complete):
    told = placegraph("map", "export", sensor, "--cloud", f"{sensor}_cloud.ply", "--mesh", f"{sensor}_mesh.ply")
    placegraph("map", "export", sensor, "--mesh", f"{sensor}_mesh.glb", "--force")
    points, vertices, triangles = (int(re.search(rf"(\d+) {what}", told).group(1)) for what in ("points", "vertices", "triangles"))
    cloud = trimesh.load(placegraph.at(f"{sensor}_cloud.ply"))
    mesh = trimesh.load(placegraph.at(f"{sensor}_mesh.ply"), process=False)
    check(f"trimesh reads the cloud of {sensor}", len(cloud.vertices) == points and len(numpy.unique(cloud.colors, axis=0)) > 20, len(cloud.vertices))
    check(f"trimesh reads the mesh of {sensor}", (len(mesh.vertices), len(mesh.faces)) == (vertices, triangles), (len(mesh.vertices), len(mesh.faces)))
    found = surfaces.distances(numpy.asarray(cloud.vertices)[::7])
    median, complete = numpy.median(found), (cKDTree(cloud.vertices).query(seen)[0] < 0.05).mean()
    print(f"  {sensor}: median distance of the cloud from the true surfaces {100 * median:.2f} cm, {100 * complete:.0f} % of the surfaces within 5 m are within 5 cm of it")
    check(f"the cloud of {sensor} is on the true surfaces", median <= most_m, f"{median} m")
    check(f"and complete ({sensor})", complete >= least_complete, f"{complete}")
    on_mesh = surfaces.distances(numpy.asarray(mesh.vertices)[::7])
    check(f"the mesh of {sensor} is on the true surfaces", numpy.median(on_mesh) <= most_m, f"{numpy.median(on_mesh)} m")
    glb = trimesh.load(placegraph.at(f"{sensor}_mesh.glb")).to_geometry()
    check(f"the .glb of {sensor} is that mesh with y up", len(glb.faces) == triangles and numpy.allclose(glb.bounds, numpy.sort(mesh.bounds * [1, -1, -1], axis=0), atol=1e-4))


def check_by_open3d(placegraph, check, open3d, sensor, poses):
    cloud = open3d.io.read_point_cloud(placegraph.at(f"{sensor}_cloud.ply"))
    mesh = open3d.io.read_triangle_mesh(placegraph.at(f"{sensor}_mesh.ply"))
    normals = numpy.asarray(cloud.normals)
    check(f"open3d reads the cloud of {sensor} with colours and unit normals", cloud.has_colors() and numpy.allclose(numpy.linalg.norm(normals, axis=1), 1, atol=1e-4))
    nearest = poses[cKDTree(poses[:, :, 3]).query(numpy.asarray(cloud.points))[1], :, 3]
    towards = ((nearest - numpy.asarray(cloud.points)) * normals).sum(1) > 0
    check("its normals are towards the cameras", towards.mean() > 0.95, towards.mean())
    check(f"open3d reads the mesh of {sensor}", mesh.has_vertex_colors() and mesh.has_vertex_normals() and len(mesh.triangles) > 1000)
    stored = numpy.asarray(mesh.vertex_normals).copy()
    mesh.compute_vertex_normals()
    check("its triangles turn as its normals say", ((stored * numpy.asarray(mesh.vertex_normals)).sum(1) > 0.5).mean() > 0.99)
    check("no edge has more than two triangles", mesh.is_edge_manifold(allow_boundary_edges=True))


def check_dense(placegraph, check, package):
    trimesh, image, open3d = package("trimesh"), package("PIL.Image"), package("open3d")
    if not (trimesh and image):
        return
    placegraph("synth", "sequence", "corridor-loop", "--frames", FRAMES, "--stereo", "--labels", "--size", "{}x{}".format(*SIZE), "--out", "corridor")
    seen, poses = seen_points(placegraph, "corridor", image, 5)
    surfaces = Surfaces(placegraph.at("corridor/scene.ply"), poses[:, :, 3].min(0) - 12, poses[:, :, 3].max(0) + 12, 0.05)
    for sensor, most_m, least_complete in (("rgbd", 0.02, 0.85), ("stereo", 0.05, 0.5)):
        run = f"corridor_{sensor}"
        placegraph("run", "corridor", "--sensor", sensor, "--out", run)
        check_cloud(placegraph, check, trimesh, run, surfaces, seen, most_m, least_complete)
        if open3d:
            check_by_open3d(placegraph, check, open3d, run, poses)


def check_bundle(placegraph, check, pycolmap, model):
    """The adjustment of a model against that of pycolmap, which holds the camera, too."""
    told = placegraph("graph", "bundle", model, "-o", "adjusted_model")
    before, after = (float(number) for number in re.search(r"squares ([\d.]+) -> ([\d.]+)", told).groups())
    ours, theirs = pycolmap.Reconstruction(placegraph.at("adjusted_model")), pycolmap.Reconstruction(placegraph.at(model))
    check("pycolmap reads the adjusted model", len(ours.images) == len(theirs.images) and len(ours.points3D) == len(theirs.points3D))
    check("its cost is the one that is told", abs(squared_errors(ours) / 2 - after) < 1e-3 * after, squared_errors(ours) / 2)
    options = pycolmap.BundleAdjustmentOptions()
    options.refine_focal_length = options.refine_principal_point = options.refine_extra_params = False
    pycolmap.bundle_adjustment(theirs, options)
    check("the adjustment reaches pycolmap's cost", after <= min(before, 1.01 * squared_errors(theirs) / 2), f"{after}, pycolmap {squared_errors(theirs) / 2}")


def squared_errors(model):
    total = 0
    for image in model.images.values():
        pose = image.cam_from_world() if callable(image.cam_from_world) else image.cam_from_world
        camera = model.cameras[image.camera_id]
        for point in image.points2D:
            if point.has_point3D():
                total += float(((camera.img_from_cam(pose * model.points3D[point.point3D_id].xyz) - point.xy) ** 2).sum())
    return total
