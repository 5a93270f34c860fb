"""What is asked of a finished map, and how results are judged."""
import inputs
from case import Case, Copy, Make, Run

CASES = [
    Case("map40", "info, validation and every export of a small map", (
        Copy("run_town40_stereo/run", "run"),
        "map info run",
        "map info run --json",
        "map validate run --json",
        "map export run --g2o g.g2o --places p.json --tum t.tum --kitti k.kitti --graphml p.graphml --dot p.dot --revisits r.txt",
        "explain run 20",
        "explain run 20 --json",
        "route run --from 0 --to 3 --backtrack --out way.json --plot way.png",
        Run("map export run", exits=2)), quick=True),
    Case("eval40", "trajectories and edges judged", (
        Copy("run_town40_stereo/run", "run"),
        "eval {render_town40}/world run/trajectory_optimized.kitti run/trajectory_online.kitti --align se3 --lengths 5,10 --step 1 "
        "--csv e.csv --latex e.tex --plot e.png",
        "eval {render_town40}/world run/trajectory_optimized.kitti --align sim3 --lengths 5,10 --json",
        "eval-edges {render_town40}/world run",
        "eval-edges {render_town40}/world run --json"), quick=True),
    Case("plan40", "the floor plan of a saved map", (
        Copy("run_corridor40_rgbd/run", "run"),
        "map plan run --out plan --json"), quick=True),
    Case("map_rounds", "the same of a map with loops", (
        Copy("run_rounds/run", "run"),
        "map info run --json",
        "map validate run",
        "map export run --g2o g.g2o --places p.json --tum t.tum --kitti k.kitti --graphml p.graphml --dot p.dot --revisits r.txt",
        "explain run 10 --json",
        "explain run 150 --json",
        "explain run 200",
        "route run --from 0 --to 11 --backtrack --out way.json --plot way.svg",
        "loops --predictions r.txt --poses {render_rounds}/world/poses.txt --min-age 60 --json",
        "loops --predictions run/loops.csv --format run --poses {render_rounds}/world/poses.txt --min-age 60 --plot loops.png --log loops.log")),
    Case("eval_rounds", "every alignment; edges with loops; forms of trajectories", (
        Copy("run_rounds/run", "run"),
        "eval {render_rounds}/world run/trajectory_optimized.kitti run/trajectory_online.kitti --lengths 10,20,50 --csv e.csv --plot e.svg",
        "eval {render_rounds}/world run/trajectory_optimized.kitti --align none --lengths 10,20,50 --json",
        "eval {render_rounds}/world run/trajectory_optimized.kitti --align origin --lengths 10,20,50 --json",
        "eval {render_rounds}/world run/trajectory_optimized.kitti --align scale --lengths 10,20,50 --json",
        "eval {render_rounds}/world run/trajectory_optimized.tum --times {render_rounds}/world/times.txt --associate time --lengths 10,20 --json",
        "eval-edges {render_rounds}/world run --json")),
    Case("localize_rounds", "images in another light placed in a map: singly, as a sequence, by appearance alone", (
        Copy("run_rounds/run", "run"),
        "localize run {render_rounds_mono}/world --out placed.txt",
        "localize run {render_rounds_mono}/world --sequence --json --out placed.json",
        "localize run {render_rounds_mono}/world --range 0 30 --set geometry=false --out looks.txt")),
    Case("learned_map", "a map of how places look, and images placed in it", (
        "map learn {render_rounds}/world --range 0 60 --out looks.db",
        "map info looks.db --json",
        "map validate looks.db",
        "localize looks.db {render_rounds_mono}/world --range 0 40 --out placed.txt",
        Run("map export looks.db --g2o g.g2o", exits=1))),
    Case("map_label", "places labelled by a classifier of labelled images", (
        Make(inputs.labelled_places, "rooms", ("{render_rounds}/world", 60)),
        Copy("run_rounds/run", "run"),
        "map label run {inputs}/rooms --names {inputs}/rooms/names.txt --json",
        "map export run --places labelled.json")),
    Case("plan_corridor", "floor plans: depth camera, two eyes, one eye; and of the saved map", (
        "run {render_corridor}/world --sensor rgbd --scene geometry --out rgbd",
        "run {render_corridor}/world --sensor stereo --scene geometry --set max_frames=80 --out stereo",
        "run {render_corridor}/world --sensor mono --camera-height 1.4 --scene geometry --set max_frames=60 --out mono",
        "map plan rgbd --out again")),
    Case("plan_warehouse", "a floor plan of the warehouse", (
        "run {render_warehouse}/world --sensor rgbd --scene geometry --out run",)),
    Case("street40", "what is where in a street, at once and from the saved map", (
        "run {render_town40}/world --sensor stereo --scene semantics --set scene.urban.min_step_m=0.5 "
        "--set scene.urban.sight.step_px=3 --out run",
        "map semantic run --out map --set min_step_m=0.5 --set sight.step_px=3")),
    Case("street_rounds", "the same with loops, cells of keyframes 4 m apart", (
        Copy("run_rounds/run", "run"),
        "map semantic run --out map --json --set min_step_m=4 --set sight.step_px=3")),
    Case("earth_rounds", "a map on the earth, and its street laid out east and north", (
        Make(inputs.drive_on_earth, "drive_on_earth", ("{render_rounds}/world",)),
        Copy("run_rounds/run", "run"),
        "georeference run --gps {inputs}/drive_on_earth/oxts.txt --out earth",
        "map semantic run --georeference earth --out map --set min_step_m=8 --set sight.step_px=4")),
]
