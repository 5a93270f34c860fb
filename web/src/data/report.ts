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
  /** Pictures that belong to no run. */
  pictures: Picture[];
  /** Pose graphs, of `placegraph optimize --report`. */
  graphs: Graph[];
}

export type Sensor = "mono" | "stereo" | "rgbd";
export type Verdict = "good" | "doubtful" | "failed";

export interface Run {
  name: string;
  folder: string;
  sensor: Sensor;
  metric: boolean;
  summary: Summary;
  judgement: Judgement | null;
  notes: string[];
  /** Only those that differ from their default. */
  options: Option[];
  figures: Figure[];
  camera: Camera | null;
  components: Component[];
  frames: Frames;
  keyframes: Keyframes;
  landmarks: Landmarks;
  places: Places;
  constraints: Constraints;
  loops: Loops;
  planes: Plane[];
  floor_plan: PlanLine[];
  street_map: PlanLine[];
  georeference: Georeference | null;
  pictures: Picture[];
}

export interface Summary {
  frames: number;
  posed: number;
  keyframes: number;
  places: number;
  landmarks: number;
  loops_accepted: number;
  cpu_s: number | null;
  wall_s: number | null;
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
  online: Column;
  /** Aligned to the map. */
  truth: Column | null;
  error_m: Column | null;
  error_deg: Column | null;
  sigma_m: Column | null;
  confidence: Column | null;
  inliers: Column;
  /** Why a frame is lost. */
  reason: LabelColumn;
  environment: LabelColumn | null;
}

export interface Keyframes {
  id: Column;
  frame: Column;
  place: Column;
  /** "data:image/jpeg;base64,..." or "". */
  thumbnails: string[];
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

/** Loop candidates; `stage` is the test that decided, or "accepted". */
export interface Loops {
  query_frame: Column;
  match_frame: Column;
  probability: Column;
  similarity: Column;
  inliers: Column;
  lines: Column;
  stage: LabelColumn;
}

export interface Plane {
  name: string;
  rgb: [number, number, number];
  /** Polygon in the map. */
  outline: Column;
}

/** Points in metres in the frame of the plan: x right, y up. */
export interface PlanLine {
  label: string;
  closed: boolean;
  points: Column;
}

export interface Georeference {
  latitude_deg: number;
  longitude_deg: number;
  /** Latitude and longitude in degrees. */
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
  edge_kind: LabelColumn;
  /** One value an edge. */
  chi2: Column;
  weight: Column | null;
  figures: Figure[];
}
