/** The report as placegraph writes it: the JSON in the script element of the page. */

/** A numeric column: base64 of little-endian values, `width` of them a row. */
export interface Column {
  type: "f32" | "f64" | "i32" | "u8";
  width: number;
  data: string;
}

/** A column of texts: indices into a table, -1 where there is none. */
export interface LabelColumn {
  table: string[];
  index: Column;
}

export interface Report {
  format: "placegraph-report-1";
  program: string;
  title: string;
  runs: Run[];
  /** Pictures and tables that belong to no run. */
  pictures: Picture[];
  tables: Table[];
  /** Pose graphs, of `placegraph optimize --report`. */
  graphs: Graph[];
}

export type Sensor = "mono" | "stereo" | "rgbd";
export type Verdict = "good" | "doubtful" | "failed";

export interface Run {
  name: string;
  /** Folder or file that it is from, or "". */
  folder: string;
  /** Runs of the same recording have the same frames and can be compared; "": unknown. */
  recording: string;
  /** Null for trajectories alone. */
  sensor: Sensor | null;
  metric: boolean;
  /** The alignment by which all poses are in the frame of the ground truth; null: in the map's frame. */
  aligned: string | null;
  /** The direction up in the frame of the poses; null: against y of the first camera. */
  up: [number, number, number] | null;
  summary: Summary;
  judgement: Judgement | null;
  notes: string[];
  /** Only those that differ from their default; null for what is no run. */
  options: Option[] | null;
  figures: Figure[];
  tables: Table[];
  camera: Camera | null;
  components: Component[];
  frames: Frames;
  /** Further values of each frame; `column` is one of the columns of `frames`. */
  frame_series: FrameSeries[];
  keyframes: Keyframes;
  landmarks: Landmarks;
  places: Places;
  constraints: Constraints;
  loops: Loops | null;
  planes: Plane[];
  floor_plan: PlanLine[];
  street_map: StreetMap | null;
  georeference: Georeference | null;
  pictures: Picture[];
}

export interface Summary {
  frames: number;
  posed: number;
  /** Null where there is no map. */
  keyframes: number | null;
  places: number | null;
  landmarks: number | null;
  loops_accepted: number | null;
  cpu_s: number | null;
  wall_s: number | null;
  /** Of all frames, where the page has some of them; null: it has all. */
  path_length: number | null;
}

export interface Judgement {
  verdict: Verdict;
  metric: boolean;
  why_metric: string;
  expected_drift_m: number | null;
  findings: Finding[];
}

export interface Finding {
  cause: string;
  text: string;
  advice: string;
}

export interface Option {
  name: string;
  value: string;
  default_value: string;
}

/** For example an ATE of 0.04 m with the protocol "se3 alignment, all frames". */
export interface Figure {
  name: string;
  value: number;
  unit: string;
  protocol: string;
}

/** Every row has as many cells as there are columns. */
export interface Table {
  title: string;
  protocol: string;
  columns: string[];
  rows: string[][];
}

export interface Camera {
  width: number;
  height: number;
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

/** `first` and `last` are frame ids. */
export interface Component {
  number: number;
  main: boolean;
  first: number;
  last: number;
  posed: number;
}

export interface FrameSeries {
  column: string;
  title: string;
  unit: string;
}

/** One row for each input frame; NaN where a value is unknown. */
export interface Frames {
  id: Column;
  stamp_s: Column;
  /** -1: lost. */
  component: Column;
  /** Id of the keyframe to which the pose of the frame is relative, or -1: a keyframe has its own. */
  keyframe: Column;
  /** x y z qx qy qz qw of T_map_cam, optimized; camera x right, y down, z forward. */
  pose: Column;
  online: Column | null;
  /** In the frame of the poses. */
  truth: Column | null;
  error_m: Column | null;
  error_deg: Column | null;
  sigma_m: Column | null;
  confidence: Column | null;
  inliers: Column | null;
  /** Why a frame is lost. */
  reason: LabelColumn;
  environment: LabelColumn | null;
  /** Columns that `frame_series` names. */
  [series: `series_${number}`]: Column | null;
}

export interface Keyframes {
  id: Column;
  frame: Column;
  place: Column;
  /** "data:image/jpeg;base64,..." or "". */
  thumbnails: string[];
  tracks: Tracks | null;
}

/** Image points of landmarks: the first `count[0]` rows are those of the first keyframe, and so on. */
export interface Tracks {
  count: Column;
  landmark: Column;
  /** Share of the image's width and height, in 255ths. */
  pixel: Column;
}

export interface Landmarks {
  position: Column;
  colour: Column | null;
  sigma_m: Column | null;
  keyframe: Column;
}

export interface Places {
  id: Column;
  keyframe: Column;
  component: Column;
  position: Column;
}

/** `from` and `to` are place ids. */
export interface Constraints {
  from: Column;
  to: Column;
  source: LabelColumn;
}

/**
 * Loop candidates; `stage` is the test that decided, or "accepted". Loops that were compared with ground
 * truth are `judged`: then `stage` is "right", "wrong" or "missed", `reason` the stage, and `similarity`
 * the score where that is no probability.
 */
export interface Loops {
  query_frame: Column;
  match_frame: Column;
  probability: Column | null;
  similarity: Column | null;
  inliers: Column | null;
  lines: Column | null;
  stage: LabelColumn;
  reason: LabelColumn | null;
  /** Rank of the first true candidate of the query; 0: none. */
  rank: Column | null;
  judged: boolean;
}

export interface Plane {
  name: string;
  rgb: [number, number, number];
  /** Polygon in the map. */
  outline: Column;
  /** Polygons in it that do not belong to the plane. */
  holes: Column[];
}

/**
 * A street from above: an image with a pixel for each column of cells, rows along z of the plan, and the
 * ground below it as (rows + 1) x (columns + 1) points of the map between which it is laid.
 */
export interface StreetMap {
  /** "data:image/png;base64,..."; transparent where nothing is known. */
  image: string;
  width: number;
  height: number;
  /** Side of a pixel. */
  cell_m: number;
  /** x and z in the plan of the corner of the first pixel. */
  low_m: [number, number];
  /** Three rows that turn directions of the map to the plan, whose y points down. */
  R_plan_map: Column;
  columns: number;
  rows: number;
  ground: Column;
  classes: StreetClass[];
}

export interface StreetClass {
  name: string;
  rgb: [number, number, number];
  area_m2: number;
}

/** Points in metres in the frame of the plan: x right, y up. */
export interface PlanLine {
  label: string;
  closed: boolean;
  points: Column;
}

export interface Georeference {
  /** The origin of the east-north-up frame. */
  latitude_deg: number;
  longitude_deg: number;
  folder: string;
  fixes_used: number | null;
  fixes_rejected: number | null;
  residual_rms_m: number | null;
  /** Latitude and longitude in degrees, height in metres; one row a frame. */
  track: Column;
}

export interface Picture {
  title: string;
  caption: string;
  svg: string;
}

export interface Graph {
  name: string;
  before: Column;
  after: Column | null;
  /** Two indices of nodes a row. */
  edges: Column;
  /** Numbers of nodes and edges of the graph of which the page has some; null: it has all. */
  all?: { nodes: number; edges: number } | null;
  /** The indices in that graph of the ends of the edges. */
  ends?: Column | null;
  edge_kind: LabelColumn;
  /** One value an edge. */
  chi2: Column;
  weight: Column | null;
  figures: Figure[];
}
