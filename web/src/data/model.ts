/** The decoded report: what the page works with. */
import type { Values } from "./column";
import type { Camera, Component, Figure, Judgement, Option, Picture, Sensor, Summary } from "./report";

export interface Labels {
  table: string[];
  index: Values;
}

export interface FrameTable {
  count: number;
  id: Values;
  stamp: Values;
  component: Values;
  keyframe: Values;
  pose: Values;
  online: Values;
  truth: Values | null;
  errorM: Values | null;
  errorDeg: Values | null;
  sigma: Values | null;
  confidence: Values | null;
  inliers: Values;
  reason: Labels;
  environment: Labels | null;
  /** The row of a frame id. */
  rowOf: Map<number, number>;
}

export interface KeyframeTable {
  count: number;
  id: Values;
  frame: Values;
  place: Values;
  thumbnails: string[];
  rowOf: Map<number, number>;
  /** Rows in the order of their frames. */
  byFrame: Int32Array;
}

export interface LandmarkTable {
  count: number;
  position: Values;
  colour: Values | null;
  sigma: Values | null;
  keyframe: Values;
}

export interface PlaceTable {
  count: number;
  id: Values;
  keyframe: Values;
  component: Values;
  position: Values;
  rowOf: Map<number, number>;
}

export interface ConstraintTable {
  count: number;
  from: Values;
  to: Values;
  source: Labels;
}

export interface LoopTable {
  count: number;
  query: Values;
  match: Values;
  probability: Values;
  similarity: Values;
  inliers: Values;
  lines: Values;
  stage: Labels;
}

export interface PlaneShape {
  name: string;
  rgb: [number, number, number];
  outline: Values;
}

export interface PlanShape {
  label: string;
  closed: boolean;
  points: Values;
}

export interface GeoTrack {
  latitude: number;
  longitude: number;
  track: Values;
}

export interface RunData {
  name: string;
  folder: string;
  sensor: Sensor;
  metric: boolean;
  summary: Summary;
  judgement: Judgement | null;
  notes: string[];
  options: Option[];
  figures: Figure[];
  camera: Camera | null;
  components: Component[];
  frames: FrameTable;
  keyframes: KeyframeTable;
  landmarks: LandmarkTable;
  places: PlaceTable;
  constraints: ConstraintTable;
  loops: LoopTable;
  planes: PlaneShape[];
  floorPlan: PlanShape[];
  streetMap: PlanShape[];
  georeference: GeoTrack | null;
  pictures: Picture[];
  /** Poses of the frames before the last edit in this page, if it has moved them. */
  before?: Values;
}

export interface GraphData {
  name: string;
  nodes: number;
  before: Values;
  after: Values | null;
  edgeCount: number;
  edges: Values;
  kind: Labels;
  chi2: Values;
  weight: Values | null;
  figures: Figure[];
}

export interface ReportData {
  program: string;
  title: string;
  runs: RunData[];
  pictures: Picture[];
  graphs: GraphData[];
}

export function label(labels: Labels, row: number): string | null {
  const index = labels.index[row];
  return index >= 0 ? (labels.table[index] ?? null) : null;
}
