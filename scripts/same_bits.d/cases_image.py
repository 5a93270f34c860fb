"""Single images, image pairs, sequences without a map, places, training."""
import inputs
from case import Case, Make, Run

TOWN = "{render_town40}/world"
HALL = "{render_corridor40}/world"
FLIGHT = "{render_flight4}/world"
CAMERAS = (
    Make(inputs.camera_of, "K_town.txt", (TOWN, "448 280")),
    Make(inputs.camera_of, "K_hall.txt", (HALL, "448 280")),
)
METHODS = ("interpolation", "lucas-kanade", "horn-schunck", "key-pixels", "opencv-lucas-kanade", "farneback", "dis")
IMAGES = f"{TOWN}/image_0/000010.png {TOWN}/image_0/000011.png"
TRAINED = "--trees 5 --variants 1 --min-leaf 4 --share-rows 0.8 --threads 1"

CASES = [
    Case("flow", "optical flow by every method, against the truth", tuple(
        f"flow {IMAGES} --method {method} --truth {TOWN}/flow_0/000010.png -o {method}.flo --draw {method}.png --json" for method in METHODS)
        + (f"flow {IMAGES} -o flow.png",), quick=True),
    Case("flow_cues", "what the flow of a flight tells at once", CAMERAS + (
        f"flow {IMAGES} --cues --calib {{inputs}}/K_town.txt --dt 0.1",
        f"flow {IMAGES} --cues --calib {{inputs}}/K_town.txt --json --turn 0,0.002,0",), quick=True),
    Case("motion", "motion between two views by every model", (
        Make(inputs.views, "views"),
        "motion {inputs}/views/general.txt --calib {inputs}/views/K.txt --json --out auto.json",
        "motion {inputs}/views/general.txt --calib {inputs}/views/K.txt",
        "motion {inputs}/views/general.txt --calib {inputs}/views/K.txt --model essential --json",
        Run("motion {inputs}/views/planar.txt --calib {inputs}/views/K.txt --model homography --json", exits=1),  # two motions explain it
        "motion {inputs}/views/turned.txt --calib {inputs}/views/K.txt --model rotation --json",
        "motion {inputs}/views/turned.txt --calib {inputs}/views/K.txt --json",
        "motion {inputs}/views/general.txt --calib {inputs}/views/K.txt --model gravity --gravity 0,1,0 --json",
        "motion {inputs}/views/seen.txt --calib {inputs}/views/K.txt --model 3d2d --json",
        "motion {inputs}/views/pairs.txt --model 3d3d --json",
        Run("motion {inputs}/views/general.txt --json", exits=2)), quick=True),
    Case("planes", "planes of two views, of a cloud by every method, of a depth image", CAMERAS + (
        Make(inputs.views, "views"),
        Make(inputs.cloud, "cloud.txt"),
        "planes two-view {inputs}/views/planar.txt --out labels.txt --calib {inputs}/views/K.txt --motion motion.json --json",
        "planes {inputs}/cloud.txt --out cuts.txt --json",
        "planes {inputs}/cloud.txt --method ransac --out ransac.txt --json",
        "planes {inputs}/cloud.txt --method growing --out growing.txt --json",
        f"planes {HALL}/depth_0/000005.png --calib {{inputs}}/K_hall.txt --depth-scale 0.001 --out depth.png --cuboids cuboids.json",
        f"planes {HALL}/depth_0/000005.png --calib {{inputs}}/K_hall.txt --depth-scale 0.001 --gt {HALL}/labels_0/000005.png "
        "--out judged.png --json"), quick=True),
    Case("lines", "line segments of an image, matched, tracked; vanishing points", CAMERAS + (
        Make(inputs.segments, "segments.txt"),
        Make(inputs.views, "views"),
        f"lines detect {HALL}/image_0/000005.png -o found.txt",
        f"lines match {HALL}/image_0/000005.png {HALL}/image_0/000015.png -o matched.txt --write-segments a.txt b.txt",
        f"lines track {HALL} --sensor stereo -o tracks.txt --json --set max_frames=20",
        "vanishing {inputs}/segments.txt --calib {inputs}/views/K.txt --json",
        "vanishing found.txt --calib {inputs}/K_hall.txt"), quick=True),
    Case("scene", "surfaces, classes and orientation of pixels; a picture folded up; labels judged", CAMERAS + (
        Make(inputs.labelled_streets, "streets", (TOWN, 8)),
        f"scene label {TOWN}/image_0/000005.png --out label --confidence --draw --json",
        f"scene surfaces {TOWN}/image_0/000005.png --out surfaces --confidence",
        "scene label {inputs}/streets/val --out val --confidence --draw",
        "scene check val {inputs}/streets/val --json --confusion",
        f"scene orientation {HALL} --every 20 --out maps --json",
        f"scene orientation {HALL}/image_0/000005.png --calib {{inputs}}/K_hall.txt --out map.png --draw drawn.png",
        f"scene popup {TOWN}/image_0/000005.png --calib {{inputs}}/K_town.txt --camera-height 1.65 --out street.ply "
        "--box 1,12,0.6,0.6,1.8 --draw overlay.png --mask mask.png --json"), quick=True),
    Case("markers", "square markers of an image, alone and in a layout", (
        Make(inputs.stamped_images, "flight", (FLIGHT,)),
        Make(inputs.camera_of_flight, "K_flight.txt", (FLIGHT,)),
        "markers detect {inputs}/flight/000002.png --calib {inputs}/K_flight.txt --side 0.2 --out m.json --draw m.png --json",
        f"markers detect {{inputs}}/flight/000002.png --calib {{inputs}}/K_flight.txt --layout {FLIGHT}/markers.yaml"), quick=True),
    Case("track_plane", "a planar region followed: models and optimizers", (
        Make(inputs.stamped_images, "flight", (FLIGHT,)),
        "track-plane {inputs}/flight --template 120,100,240,100,240,200,120,200 --out track.txt --json",
        "track-plane {inputs}/flight --template 120,100,240,100,240,200,120,200 --optimizer inverse_compositional --similarity zncc "
        "--out other.txt --draw drawn"), quick=True),
    Case("places", "place recognition: match by cues and by words, judged; places told by every classifier", (
        Make(inputs.labelled_places, "places40", (TOWN, 40)),
        Make(inputs.texts, "loops", ("gt.txt", "10 0 5 1 2\n11 0 5 3\n12 0 5 -\n", "ours.txt", "10 2 0.9\n11 4 0.8\n12 5 0.1\n",
                                     "theirs.txt", "10 2 0.9 accepted\n11 3 0.8 accepted\n")),
        f"match {TOWN} --min-age 15 --out found.txt",
        f"match {TOWN} --min-age 15 --sequence --out sequence.txt",
        f"loops --predictions found.txt --poses {TOWN}/poses.txt --min-age 15 --json",
        "loops --predictions {inputs}/loops/ours.txt {inputs}/loops/theirs.txt --names ours theirs --gt {inputs}/loops/gt.txt --log log.csv --plot pr.svg",
        f"vocabulary train {TOWN} --words 100 --descriptors 4000 --out binary.pgw",
        f"vocabulary train {TOWN} --words 50 --descriptors 2000 --kind float --out float.pgw",
        "vocabulary info binary.pgw",
        f"match {TOWN} --min-age 15 --codes bow --vocabulary binary.pgw --out bow.txt",
        f"match {TOWN} --min-age 15 --codes llc --vocabulary float.pgw --out llc.txt",
        "places classify {inputs}/places40 --train 20 --out kernel.txt",
        "places classify {inputs}/places40 --train 20 --classifier svm --sequence --out svm.txt",
        "places classify {inputs}/places40 --train 20 --classifier adaboost --out adaboost.txt"), quick=True),
    Case("places_codes", "every code of place recognition over two rounds", (
        "vocabulary train {render_town}/world --words 1000 --descriptors 40000 --out binary.pgw",
        "vocabulary train {render_town}/world --words 200 --descriptors 20000 --kind float --out float.pgw",
        "match {render_rounds}/world --min-age 60 --sequence --out cues.txt",
        "match {render_rounds}/world --min-age 60 --codes bow --vocabulary binary.pgw --out bow.txt",
        "match {render_rounds}/world --min-age 60 --codes bow --out own_words.txt",
        "match {render_rounds}/world --min-age 60 --codes bow_float --vocabulary float.pgw --out bow_float.txt",
        "match {render_rounds}/world --min-age 60 --codes llc --vocabulary float.pgw --out llc.txt",
        "match {render_rounds}/world --min-age 60 --codes landmarks --vocabulary float.pgw --out landmarks.txt",
        "loops --predictions cues.txt bow.txt llc.txt --poses {render_rounds}/world/poses.txt --min-age 60")),
    Case("train_scene", "models of surfaces and of streets, learned from a few rendered pictures", (
        Make(inputs.labelled_streets, "streets", (TOWN, 8)),
        f"train surfaces {{inputs}}/streets --out surfaces.pgscene {TRAINED}",
        f"train urban {{inputs}}/streets --out urban.pgscene {TRAINED} --ablation --json",
        "scene label {inputs}/streets/val --out labels --model urban.pgscene --surfaces-model surfaces.pgscene --confidence --draw")),
    Case("train_planarity", "which segments of a cloud are planes", (
        "train planarity --out planarity.txt --clouds 40 --frames 2 --json",
        Make(inputs.cloud, "cloud.txt"),
        "planes {inputs}/cloud.txt --model planarity.txt --out planes.txt --json")),
    Case("train_environment", "what kind of surroundings a view shows", (
        "train environment --out environment.txt --frames 4 --seeds 1 --left-out 2 --json",)),
    Case("cuts_of_walks", "lines, orientation and flow over longer walks", (
        "lines track {render_corridor}/world --sensor stereo -o tracks.txt --set max_frames=60",
        "scene orientation {render_corridor}/world --every 30 --out maps --json")),
]
