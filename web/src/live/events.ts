/** What a run that goes on tells: the events of the stream, the snapshot of its state, its current image. */
import type { Values } from "../data/column";
import { asBoolean, asNumber, asNumberOrNaN, asObject, asOneOf, asText, listOf, orNull } from "../data/fields";
import { TableReader, readColumn } from "../data/table_reader";

export const FRAME_STATES = ["tracking", "lost", "initializing"] as const;
export type FrameState = (typeof FRAME_STATES)[number];

export interface FrameEvent {
  /** Id of the frame. */
  frame: number;
  /** Number of the frame in the sequence, from 0 of `total`. */
  index: number;
  total: number;
  stamp: number;
  state: FrameState;
  /** -1: no pose. */
  component: number;
  inliers: number;
  confidence: number;
  /** x y z qx qy qz qw of T_map_cam. */
  pose: number[] | null;
  keyframe: boolean;
  reason: string;
  /** Positions of landmarks that are new, three values each. */
  landmarks: Values | null;
}

export interface LiveLoop {
  query: number;
  match: number;
  stage: string;
  accepted: boolean;
  probability: number;
  inliers: number;
}

export interface Stage {
  name: string;
  cpuS: number;
  calls: number;
}

/** What happened; "joined": the stream of events has begun. */
export type News =
  | { kind: "joined" }
  | { kind: "frame"; frame: FrameEvent }
  | { kind: "loop"; loop: LiveLoop }
  | { kind: "moved" }
  | { kind: "reset" }
  | { kind: "stages"; stages: Stage[] }
  | { kind: "control"; paused: boolean }
  | { kind: "done"; verdict: string | null };

/** News with its number: events are numbered from 1 on, and "joined" has the number of the event before it. */
export type LiveEvent = News & { number: number };

export const EVENT_KINDS = ["joined", "frame", "loop", "moved", "reset", "stages", "control", "done"] as const;

/** Throws an error with a plain sentence where the data are no event of this kind. */
export function decodeEvent(kind: (typeof EVENT_KINDS)[number], value: unknown): News {
  if (kind === "stages") return { kind, stages: listOf(value, kind, readStage) };
  const json = asObject(value, `The event "${kind}"`);
  switch (kind) {
    case "frame":
      return { kind, frame: readFrame(json) };
    case "loop":
      return { kind, loop: readLoop(json, kind) };
    case "joined":
    case "moved":
    case "reset":
      return { kind };
    case "control":
      return { kind, paused: asBoolean(json["paused"], `${kind}.paused`) };
    case "done":
      return { kind, verdict: orNull(json["verdict"], `${kind}.verdict`, asText) };
  }
}

function readFrame(json: Record<string, unknown>): FrameEvent {
  const at = (name: string): [unknown, string] => [json[name], `frame.${name}`];
  const pose = orNull(...at("pose"), (v, where) => listOf(v, where, asNumberOrNaN));
  if (pose !== null && pose.length !== 7) throw new Error(`frame.pose has ${pose.length} values; it must have 7.`);
  return {
    frame: asNumber(...at("frame")),
    index: asNumber(...at("index")),
    total: asNumber(...at("total")),
    stamp: asNumberOrNaN(...at("stamp_s")),
    state: asOneOf(json["state"], FRAME_STATES, "frame.state"),
    component: asNumber(...at("component")),
    inliers: asNumberOrNaN(...at("inliers")),
    confidence: asNumberOrNaN(json["confidence"] ?? null, "frame.confidence"),
    pose,
    keyframe: asBoolean(...at("keyframe")),
    reason: asText(json["reason"] ?? "", "frame.reason"),
    landmarks: orNull(...at("landmarks"), (v, where) => readColumn(v, where, 3).values),
  };
}

function readLoop(value: unknown, where: string): LiveLoop {
  const json = asObject(value, where);
  return {
    query: asNumber(json["query_frame"], `${where}.query_frame`),
    match: asNumber(json["match_frame"], `${where}.match_frame`),
    stage: asText(json["stage"], `${where}.stage`),
    accepted: asBoolean(json["accepted"], `${where}.accepted`),
    probability: asNumberOrNaN(json["probability"] ?? null, `${where}.probability`),
    inliers: asNumberOrNaN(json["inliers"] ?? null, `${where}.inliers`),
  };
}

function readStage(value: unknown, where: string): Stage {
  const json = asObject(value, where);
  return {
    name: asText(json["name"], `${where}.name`),
    cpuS: asNumber(json["cpu_s"], `${where}.cpu_s`),
    calls: asNumber(json["calls"], `${where}.calls`),
  };
}

/** Everything that a run has so far. */
export interface Snapshot {
  /** Number of the last event that it contains. */
  number: number;
  /** Number of the event that the run began again; 0 for the first time. */
  began: number;
  total: number;
  done: number;
  paused: boolean;
  finished: boolean;
  verdict: string | null;
  /** The newest frame, without its landmarks. */
  last: FrameEvent | null;
  stages: Stage[];
  frames: FrameColumns;
  landmarks: Values;
  loops: LiveLoop[];
}

/** Frames in the order of their ids. */
export interface FrameColumns {
  count: number;
  id: Values;
  component: Values;
  pose: Values;
  inliers: Values;
  /** Indices into FRAME_STATES; -1: unknown. */
  state: Int8Array;
  keyframe: Values;
}

export function decodeSnapshot(value: unknown): Snapshot {
  const json = asObject(value, "The state of the run");
  return {
    number: asNumber(json["number"], "number"),
    began: asNumber(json["began"], "began"),
    total: asNumber(json["total"], "total"),
    done: asNumber(json["done"], "done"),
    paused: asBoolean(json["paused"], "paused"),
    finished: asBoolean(json["finished"], "finished"),
    verdict: orNull(json["verdict"], "verdict", asText),
    last: orNull(json["last"], "last", (last, where) => readFrame(asObject(last, where))),
    stages: listOf(json["stages"], "stages", readStage),
    frames: readFrames(json["frames"]),
    landmarks: readColumn(json["landmarks"], "landmarks", 3).values,
    loops: listOf(json["loops"], "loops", readLoop),
  };
}

function readFrames(value: unknown): FrameColumns {
  const table = new TableReader(value, "frames", "id");
  const { table: names, index } = table.labels("state");
  const codes = names.map((name) => FRAME_STATES.indexOf(name as FrameState));
  return {
    count: table.rows,
    id: table.column("id"),
    component: table.column("component"),
    pose: table.column("pose", 7),
    inliers: table.column("inliers"),
    state: Int8Array.from(index, (i) => codes[i] ?? -1),
    keyframe: table.column("keyframe"),
  };
}

export interface LiveImage {
  frame: number;
  /** A data URI. */
  image: string;
  width: number;
  height: number;
  /** u, v in pixels, residual in pixels (NaN: no landmark yet). */
  points: Values;
  pointCount: number;
  /** u0, v0, u1, v1 in pixels, residual in pixels. */
  lines: Values;
  lineCount: number;
}

export function decodeLiveImage(value: unknown): LiveImage {
  const json = asObject(value, "The image of the run");
  const points = readColumn(json["points"], "points", 3);
  const lines = readColumn(json["lines"], "lines", 5);
  return {
    frame: asNumber(json["frame"], "frame"),
    image: asText(json["image"], "image"),
    width: asNumber(json["width"], "width"),
    height: asNumber(json["height"], "height"),
    points: points.values,
    pointCount: points.rows,
    lines: lines.values,
    lineCount: lines.rows,
  };
}
