"""Exports of a map's geometry, read by pycolmap, trimesh, pygltflib, Pillow, PyYAML and mcap where they are installed.

check_geometry(placegraph, check, run) exports the map of a run and compares what the packages read with each
other, with the images on the disk and with the trajectory that the run wrote.
"""

import base64
import importlib
import json
import os
import re

import numpy
from evo.tools import file_interface


def package(name):
    """The package, or nothing, which is said."""
    try:
        return importlib.import_module(name)
    except ImportError:
        print(f"  skipped: {name} is not installed")
        return None


class Poses:
    """The poses of the optimized trajectory by the number of the frame."""

    def __init__(self, placegraph, run):
        kitti = file_interface.read_kitti_poses_file(placegraph.at(f"{run}/trajectory_optimized.kitti"))
        self.matrices = kitti.poses_se3
        self.positions = kitti.positions_xyz

    def of_image(self, name):
        return self.matrices[int(re.search(r"(\d+)\.\w+$", name).group(1))]


def read_ply(trimesh, path):
    """Positions, colours and standard deviations."""
    cloud = trimesh.load(path, process=False)
    raw = cloud.metadata["_ply_raw"]["vertex"]["data"]
    return numpy.asarray(cloud.vertices), numpy.asarray(cloud.colors)[:, :3], numpy.asarray(raw["sigma_m"]).ravel()


def check_ply(placegraph, check, run, trimesh):
    placegraph("map", "export", run, "--ply", "binary.ply")
    placegraph("map", "export", run, "--ply", "text.ply", "--ascii")
    points, colours, sigma = read_ply(trimesh, placegraph.at("binary.ply"))
    text = read_ply(trimesh, placegraph.at("text.ply"))
    landmarks = json.loads(placegraph("map", "info", run, "--json"))["landmarks"]
    check("trimesh reads the landmarks of PLY", 0 < len(points) <= landmarks, f"{len(points)} of {landmarks}")
    check("the text has the same", numpy.allclose(points, text[0], rtol=1e-6) and (colours == text[1]).all() and numpy.allclose(sigma, text[2], equal_nan=True))
    check("they have colours and standard deviations", colours.std() > 1 and numpy.isfinite(sigma).any() and (sigma[numpy.isfinite(sigma)] >= 0).all())
    return points, colours


def check_gltf_by_trimesh(placegraph, check, trimesh, name, points):
    """Points and single lines: trimesh leaves line strips out."""
    scene = trimesh.load(placegraph.at(name), process=False)
    shown = {}
    for node in scene.graph.nodes_geometry:
        transform, geometry = scene.graph[node]
        shown[geometry] = numpy.asarray(scene.geometry[geometry].vertices) @ transform[:3, :3].T + transform[:3, 3]
    check(f"trimesh reads landmarks and keyframes of {name}", {"landmarks", "keyframes"} <= set(shown), sorted(shown))
    check(f"the landmarks of {name} are those of PLY with y up", numpy.allclose(shown["landmarks"], points * [1, -1, -1], atol=1e-4))


def check_gltf_by_pygltflib(placegraph, check, pygltflib, name, poses):
    gltf = pygltflib.GLTF2().load(placegraph.at(name))
    mesh = next(mesh for mesh in gltf.meshes if mesh.name == "trajectory")
    path = []
    for primitive in mesh.primitives:
        accessor = gltf.accessors[primitive.attributes.POSITION]
        view = gltf.bufferViews[accessor.bufferView]
        uri = gltf.buffers[view.buffer].uri
        data = gltf.get_data_from_buffer_uri(uri) if uri else gltf.binary_blob()
        path.append(numpy.frombuffer(data, "<f4", 3 * accessor.count, view.byteOffset).reshape(-1, 3))
    check(f"pygltflib reads the trajectory of {name} as strips", all(primitive.mode == pygltflib.LINE_STRIP for primitive in mesh.primitives))
    check(f"it is that of the run ({name})", numpy.allclose(numpy.vstack(path), poses.positions, atol=1e-4))


def reprojection_errors(pycolmap, model):
    """Of every observation, by COLMAP's own projection."""
    errors = []
    for image in model.images.values():
        pose = image.cam_from_world() if callable(image.cam_from_world) else image.cam_from_world
        camera = model.cameras[image.camera_id]
        seen = [point for point in image.points2D if point.has_point3D()]
        if not seen:
            continue
        in_camera = numpy.array([pose * model.points3D[point.point3D_id].xyz for point in seen])
        projected = numpy.array([camera.img_from_cam(point) for point in in_camera])
        errors.extend(numpy.linalg.norm(projected - numpy.array([point.xy for point in seen]), axis=1))
    return numpy.array(errors)


def check_colmap(placegraph, check, run, sequence, pycolmap, poses):
    told = placegraph("map", "export", run, "--colmap", "model")
    placegraph("map", "export", run, "--colmap", "model_text", "--ascii")
    images, points, kept, offered, error, views = (float(re.search(pattern, told).group(1)) for pattern in (
        r"(\d+) keyframes", r"(\d+) points", r"(\d+) of", r"of (\d+) observations", r"error ([\d.]+) px", r"([\d.]+) views"))
    models = [pycolmap.Reconstruction(placegraph.at(name)) for name in ("model", "model_text")]
    for model, form in zip(models, ("bytes", "text")):
        check(f"pycolmap reads the model of {form}", len(model.images) == images and len(model.points3D) == points and model.compute_num_observations() == kept)
        check(f"every point of it has two views ({form})", min(point.track.length() for point in model.points3D.values()) >= 2)
        found = reprojection_errors(pycolmap, model)
        check(f"COLMAP projects the points as map export does ({form})", len(found) == kept and abs(found.mean() - error) < 0.006, f"{found.mean()} and {error} px")
    model = models[0]
    check("the observations are explained", error <= 1 and kept >= 0.8 * offered and views >= 3, told.strip())
    check("its images are in the sequence", all(os.path.isfile(placegraph.at(f"{sequence}/{image.name}")) for image in model.images.values()))
    listed = sorted(model.images.values(), key=lambda image: image.name)
    centres = numpy.array([image.projection_center() for image in listed])
    before = numpy.array([poses.of_image(image.name)[:3, 3] for image in listed])
    length = numpy.linalg.norm(numpy.diff(before, axis=0), axis=1).sum()
    check("the adjustment keeps the first pose", numpy.allclose(centres[0], before[0], atol=1e-9), str(centres[0]))
    check("and the scale", abs(numpy.linalg.norm(numpy.diff(centres, axis=0), axis=1).sum() / length - 1) < 0.03)
    check("and the path", numpy.linalg.norm(centres - before, axis=1).max() < 0.05 * length)
    os.makedirs(placegraph.at("model_of_others"), exist_ok=True)
    model.write(placegraph.at("model_of_others"))
    placegraph("map", "import", "--colmap", "model_of_others", "--images", sequence, "--out", "imported.db", "--metric", "--force")
    placegraph("map", "export", "imported.db", "--tum", "imported.tum", "--ply", "imported.ply", "--force")
    imported = file_interface.read_tum_trajectory_file(placegraph.at("imported.tum"))
    check("map import reads the model that pycolmap writes", numpy.allclose(imported.positions_xyz, centres, atol=1e-6), imported.num_poses)


def check_nerf(placegraph, check, run, poses):
    os.makedirs(placegraph.at("nerf"), exist_ok=True)
    placegraph("map", "export", run, "--nerf", "nerf/transforms.json")
    written = json.load(open(placegraph.at("nerf/transforms.json")))
    frames = written["frames"]
    check("the images of transforms.json are where it says", len(frames) > 1 and all(os.path.isfile(placegraph.at("nerf/" + frame["file_path"])) for frame in frames))
    flips = numpy.diag([1, -1, -1, 1])
    check("its poses are those of the run in OpenGL's axes", all(numpy.allclose(numpy.array(frame["transform_matrix"]) @ flips, poses.of_image(frame["file_path"]), atol=1e-5) for frame in frames))


def check_occupancy(placegraph, check, run, image, yaml, poses):
    placegraph("map", "export", run, "--occupancy", "floor", "--resolution", "0.1")
    text = open(placegraph.at("floor.yaml")).read()
    written = yaml.safe_load(text)
    picture = numpy.asarray(image.open(placegraph.at(written["image"])))
    check("PyYAML and Pillow read the occupancy grid", written["negate"] == 0 and set(numpy.unique(picture)) == {0, 205, 254}, str(numpy.unique(picture)))
    occupied = (255 - picture.astype(float)) / 255
    check("the thresholds tell the three states apart", ((occupied < written["free_thresh"]) == (picture == 254)).all() and ((occupied > written["occupied_thresh"]) == (picture == 0)).all())
    rows = [[float(number) for number in match.group(1).split(",")] for match in re.finditer(r"^#\s+\[(.*)\]$", text, re.M)]
    on_floor = (poses.positions @ numpy.array(rows).T)[:, :2]
    cells = numpy.floor((on_floor - written["origin"][:2]) / written["resolution"]).astype(int)
    check("it is free where the camera was", (picture[picture.shape[0] - 1 - cells[:, 1], cells[:, 0]] == 254).all())


def check_mcap(placegraph, check, run, reader, points, colours, poses):
    placegraph("map", "export", run, "--mcap", "map.mcap")
    with open(placegraph.at("map.mcap"), "rb") as stream:
        recording = reader.make_reader(stream, validate_crcs=True)
        summary = recording.get_summary()
        topics = {channel.id: channel.topic for channel in summary.channels.values()}
        counts = {topics[number]: count for number, count in summary.statistics.channel_message_counts.items()}
        check("mcap reads the summary", counts == {"/tf": len(poses.positions) + 1, "/trajectory": 1, "/landmarks": 1}, counts)
        messages = {}
        for schema, channel, message in recording.iter_messages():
            messages.setdefault(channel.topic, []).append((schema.name, json.loads(message.data)))
    path = [transform["translation"] for _, transform in messages["/tf"] if transform["parent_frame_id"] == "map"]
    check("/tf has the trajectory", numpy.allclose([[p["x"], p["y"], p["z"]] for p in path], poses.positions, atol=1e-5))
    check("/trajectory has it, too", len(messages["/trajectory"][0][1]["poses"]) == len(poses.positions))
    name, cloud = messages["/landmarks"][0]
    numbers = {1: "u1", 7: "<f4"}
    layout = numpy.dtype({"names": [f["name"] for f in cloud["fields"]], "formats": [numbers[f["type"]] for f in cloud["fields"]],
                          "offsets": [f["offset"] for f in cloud["fields"]], "itemsize": cloud["point_stride"]})
    data = numpy.frombuffer(base64.b64decode(cloud["data"]), layout)
    check("/landmarks has the points", name == "foxglove.PointCloud" and len(data) > 0)
    if points is not None:
        check("they are those of PLY", numpy.allclose(numpy.column_stack([data[axis] for axis in "xyz"]), points, rtol=1e-6) and
              (numpy.column_stack([data[colour] for colour in ("red", "green", "blue")]) == colours).all())


def check_geometry(placegraph, check, run, sequence):
    poses = Poses(placegraph, run)
    points = colours = None
    if trimesh := package("trimesh"):
        points, colours = check_ply(placegraph, check, run, trimesh)
    pygltflib = package("pygltflib")
    for name in ("map.glb", "map.gltf"):
        placegraph("map", "export", run, "--gltf", name)
        if trimesh:
            check_gltf_by_trimesh(placegraph, check, trimesh, name, points)
        if pygltflib:
            check_gltf_by_pygltflib(placegraph, check, pygltflib, name, poses)
    if pycolmap := package("pycolmap"):
        check_colmap(placegraph, check, run, sequence, pycolmap, poses)
    check_nerf(placegraph, check, run, poses)
    image, yaml = package("PIL.Image"), package("yaml")
    if image and yaml:
        check_occupancy(placegraph, check, run, image, yaml, poses)
    if reader := package("mcap.reader"):
        check_mcap(placegraph, check, run, reader, points, colours, poses)
