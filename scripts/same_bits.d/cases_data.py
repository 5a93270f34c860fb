"""Research data, where they are: the smallest sets, tens of frames."""
import inputs
from case import Case, Make

S = "{data}/sequences"
SCENE = "{data}/scene"
GRAPHS_2D = ("intel", "M3500", "kitti_05")
GRAPHS_3D = ("tinyGrid3D", "smallGrid3D", "sphere2500", "parking-garage")
ROBUST = ("none", "huber", "dcs", "gnc", "pcm", "auto")

CASES = [
    Case("kitti00_40", "a real drive, one eye", (
        f"run {S}/kitti00_mono200 --sensor mono --camera-height 1.65 --set max_frames=40 --out run",)),
    Case("kitti06_20", "a real drive, two eyes; what is where in its street", (
        f"run {S}/kitti06_stereo51 --sensor stereo --scene semantics --set scene.urban.sight.step_px=4 --set max_frames=20 --out run",)),
    Case("kitti0095_40", "a real street with walkers, one eye; masks", (
        f"run {S}/kitti0095_mono268 --sensor mono --camera-height 1.65 --elements motion,spatial,semantics --set max_frames=40 --out run",)),
    Case("sevenscenes_60", "a real depth camera in the hand", (
        f"run {S}/sevenscenes_rgbd334 --sensor rgbd --set max_frames=60 --out run",
        f"run {S}/sevenscenes_rgbd334 --sensor rgbd --cues points,lines,manhattan --set max_frames=30 --out lines")),
    Case("cube_40", "a real board on a table, followed as a plane", (
        f"run {S}/cube_planar200 --sensor mono --set max_frames=40 --out run",)),
    Case("graphs_published", "published graphs as they come", tuple(
        f"optimize {{data}}/posegraphs/{name}.g2o -o {name}.g2o --json --quiet" for name in GRAPHS_2D + GRAPHS_3D)),
    Case("graphs_published_starts", "published graphs by every initialization", tuple(
        f"optimize {{data}}/posegraphs/{name}.g2o -o {name}_{start}.g2o --json --quiet --start {start}"
        for name in ("intel", "smallGrid3D") for start in ("file", "odometry", "chordal", "certified"))
        + ("optimize {data}/posegraphs/smallGrid3D.g2o -o certified.g2o --certify --cost g2o",)),
    Case("graphs_published_incremental", "published graphs that grow pose by pose", (
        "optimize {data}/posegraphs/intel.g2o -o intel.g2o --incremental --json --quiet",
        "optimize {data}/posegraphs/parking-garage.g2o -o garage.g2o --incremental --json --quiet")),
    Case("graphs_published_outliers", "published graphs with false loops by every robust method", tuple(
        f"optimize {{data}}/posegraphs/outliers/intel_out100.g2o -o intel_{method}.g2o --json --quiet --robust {method}" for method in ROBUST)
        + ("optimize {data}/posegraphs/outliers/kitti_00_out10.g2o -o kitti_00.g2o --json --quiet --robust auto",)),
    Case("bal", "published bundle adjustment", (
        "bundle {data}/bal/dubrovnik-3-7-pre.txt -o dubrovnik.txt --json",
        "bundle {data}/bal/problem-49-7776-pre.txt -o ladybug.txt --json")),
    Case("golden_table", "published trajectories in one table", (
        "eval table orb={data}/golden/KITTI_00_ORB.txt sptam={data}/golden/KITTI_00_SPTAM.txt --truth {data}/golden/KITTI_00_gt.txt "
        "--rows systems --out t.txt,t.csv,t.tex,t.md,t.json,t.html",)),
    Case("golden", "published trajectories judged", (
        "eval {data}/golden/KITTI_00_gt.txt {data}/golden/KITTI_00_ORB.txt {data}/golden/KITTI_00_SPTAM.txt --align se3 --csv e.csv --latex e.tex --plot e.png",
        "eval {data}/golden/KITTI_00_gt.txt {data}/golden/KITTI_00_ORB.txt --align sim3 --json",
        "loops --predictions {data}/golden/loops/ibow_KITTI06_loops.txt --format ibow --gt {data}/golden/loops/KITTI_06_loops_10m.txt --json --plot pr.png")),
    Case("gps", "a real drive on the earth: its true motion as the graph", (
        Make(inputs.graph_of_poses, "kitti06.g2o", ("{data}/kitti_gt/06/poses.txt", 300)),
        "georeference {inputs}/kitti06.g2o --times {data}/kitti_gt/06/times.txt --gps {data}/kitti_gt/06/oxts.txt "
        "--lever-arm=-0.32,0.72,-1.08 --out plain",
        "georeference {inputs}/kitti06.g2o --times {data}/kitti_gt/06/times.txt --gps {data}/kitti_gt/06/oxts.txt "
        "--lever-arm=-0.32,0.72,-1.08 --clock-offset estimate --out clock --json")),
    Case("places_corridor", "a real corridor, walked twice: matched, judged, learned and localized", (
        "match {data}/places/corridor_milford --sequence --out found.txt",
        "loops --predictions found.txt --gt {data}/places/corridor_milford/gt.txt --json",
        "map learn {data}/places/corridor_milford --range 0 110 --out looks.db",
        "localize looks.db {data}/places/corridor_milford --range 111 170 --sequence --out placed.txt")),
    Case("places_house", "a rendered house with labelled places", (
        "places classify {data}/places/vtm_virtual_house --out told.txt",)),
    Case("york", "vanishing points of real line segments", (
        f"vanishing {SCENE}/york_urban_vp/P1020829_lines.txt --calib {SCENE}/york_urban_vp/K.txt --json",
        f"scene orientation {SCENE}/york_urban_vp/P1020829.jpg --calib {SCENE}/york_urban_vp/K.txt --out map.png --draw drawn.png",
        f"vanishing {SCENE}/york_urban_vp/P1040783_lines.txt --calib {SCENE}/york_urban_vp/K.txt")),
    Case("adelaide", "planes of two real views", (
        f"planes two-view {SCENE}/adelaide_planes/barrsmith.txt --out barrsmith.txt --json",
        f"planes two-view {SCENE}/adelaide_planes/ladysymon.txt --out ladysymon.txt --json")),
    Case("castle", "planes of a range scan and of a depth image", (
        f"planes {SCENE}/planes_synpeb/test_100_xyzlabel.txt --out scan.txt --json",
        f"planes {SCENE}/planes_synpeb/test_100_xyzlabel.txt --method ransac --out ransac.txt --json")),
    Case("line_matching", "lines of two real views matched", (
        f"lines match {SCENE}/line_matching/dunster/1.png {SCENE}/line_matching/dunster/2.png -o detected.txt --write-segments a.txt b.txt",
        f"lines match {SCENE}/line_matching/dunster/1.png {SCENE}/line_matching/dunster/2.png "
        f"--segments {SCENE}/line_matching/dunster/lsd1.txt {SCENE}/line_matching/dunster/lsd2.txt -o given.txt")),
    Case("camvid", "classes of a real street, judged", (
        Make(inputs.first_pictures, "camvid", (f"{SCENE}/camvid", 4)),
        "scene label {inputs}/camvid --out labels --confidence --draw",
        "scene check labels {inputs}/camvid --json")),
    Case("apriltag", "published marker image", (
        Make(inputs.texts, "apriltag", ("K.txt", "700 700 320 240 640 480\n")),
        f"markers detect {SCENE}/apriltag_sim/tag36_11_640x480.png --calib {{inputs}}/apriltag/K.txt --side 0.2 --out m.json --draw m.png")),
]
