import type { Values } from "./column";
import { type Json, asBoolean, asNumber, asNumberOrNaN, asObject, asOneOf, asText, listOf, orNull } from "./fields";
import { readFigure, readPicture } from "./figures";
import type {
  ConstraintTable,
  FrameTable,
  GeoTrack,
  KeyframeTable,
  LandmarkTable,
  LoopTable,
  PlaceTable,
  PlaneShape,
  PlanShape,
  RunData,
} from "./model";
import type { Camera, Component, Finding, Judgement, Option, Summary } from "./report";
import { readColumn, TableReader } from "./table_reader";

export function decodeRun(value: unknown, where: string): RunData {
  const json = asObject(value, where);
  const at = (name: string): string => `${where}.${name}`;
  return {
    name: asText(json["name"], at("name")),
    folder: asText(json["folder"], at("folder")),
    sensor: asOneOf(json["sensor"], ["mono", "stereo", "rgbd"] as const, at("sensor")),
    metric: asBoolean(json["metric"], at("metric")),
    summary: readSummary(json["summary"], at("summary")),
    judgement: orNull(json["judgement"], at("judgement"), readJudgement),
    notes: listOf(json["notes"], at("notes"), asText),
    options: listOf(json["options"], at("options"), readOption),
    figures: listOf(json["figures"], at("figures"), readFigure),
    camera: orNull(json["camera"], at("camera"), readCamera),
    components: listOf(json["components"], at("components"), readComponent),
    frames: readFrames(json["frames"], at("frames")),
    keyframes: readKeyframes(json["keyframes"], at("keyframes")),
    landmarks: readLandmarks(json["landmarks"], at("landmarks")),
    places: readPlaces(json["places"], at("places")),
    constraints: readConstraints(json["constraints"], at("constraints")),
    loops: readLoops(json["loops"], at("loops")),
    planes: listOf(json["planes"], at("planes"), readPlane),
    floorPlan: listOf(json["floor_plan"], at("floor_plan"), readPlanLine),
    streetMap: listOf(json["street_map"], at("street_map"), readPlanLine),
    georeference: orNull(json["georeference"], at("georeference"), readGeoreference),
    pictures: listOf(json["pictures"], at("pictures"), readPicture),
  };
}

function numbersOf<K extends string>(json: Json, where: string, names: readonly K[]): Record<K, number> {
  const result = {} as Record<K, number>;
  for (const name of names) result[name] = asNumber(json[name], `${where}.${name}`);
  return result;
}

function readSummary(value: unknown, where: string): Summary {
  const json = asObject(value, where);
  const counts = numbersOf(json, where, [
    "frames",
    "posed",
    "keyframes",
    "places",
    "landmarks",
    "loops_accepted",
  ] as const);
  return {
    ...counts,
    cpu_s: orNull(json["cpu_s"], `${where}.cpu_s`, asNumber),
    wall_s: orNull(json["wall_s"], `${where}.wall_s`, asNumber),
  };
}

function readJudgement(value: unknown, where: string): Judgement {
  const json = asObject(value, where);
  return {
    verdict: asOneOf(json["verdict"], ["good", "doubtful", "failed"] as const, `${where}.verdict`),
    metric: asBoolean(json["metric"], `${where}.metric`),
    why_metric: asText(json["why_metric"], `${where}.why_metric`),
    expected_drift_m: orNull(json["expected_drift_m"], `${where}.expected_drift_m`, asNumber),
    findings: listOf(json["findings"], `${where}.findings`, readFinding),
  };
}

function readFinding(value: unknown, where: string): Finding {
  const json = asObject(value, where);
  return {
    cause: asText(json["cause"], `${where}.cause`),
    text: asText(json["text"], `${where}.text`),
    advice: asText(json["advice"], `${where}.advice`),
  };
}

function readOption(value: unknown, where: string): Option {
  const json = asObject(value, where);
  return {
    name: asText(json["name"], `${where}.name`),
    value: asText(json["value"], `${where}.value`),
    default_value: asText(json["default_value"], `${where}.default_value`),
  };
}

function readCamera(value: unknown, where: string): Camera {
  return numbersOf(asObject(value, where), where, ["width", "height", "fx", "fy", "cx", "cy"] as const);
}

function readComponent(value: unknown, where: string): Component {
  const json = asObject(value, where);
  return {
    ...numbersOf(json, where, ["number", "first", "last", "posed"] as const),
    main: asBoolean(json["main"], `${where}.main`),
  };
}

function rowsById(id: Values): Map<number, number> {
  const rows = new Map<number, number>();
  for (let row = 0; row < id.length; row++) rows.set(id[row], row);
  return rows;
}

function readFrames(value: unknown, where: string): FrameTable {
  const table = new TableReader(value, where, "id");
  const id = table.column("id");
  return {
    count: table.rows,
    id,
    stamp: table.column("stamp_s"),
    component: table.column("component"),
    keyframe: table.column("keyframe"),
    pose: table.column("pose", 7),
    online: table.column("online", 7),
    truth: table.optional("truth", 7),
    errorM: table.optional("error_m"),
    errorDeg: table.optional("error_deg"),
    sigma: table.optional("sigma_m"),
    confidence: table.optional("confidence"),
    inliers: table.column("inliers"),
    reason: table.labels("reason"),
    environment: table.optionalLabels("environment"),
    rowOf: rowsById(id),
  };
}

function readKeyframes(value: unknown, where: string): KeyframeTable {
  const table = new TableReader(value, where, "id");
  const id = table.column("id");
  const frame = table.column("frame");
  return {
    count: table.rows,
    id,
    frame,
    byFrame: Int32Array.from(frame, (_, row) => row).sort((a, b) => frame[a] - frame[b]),
    place: table.column("place"),
    thumbnails: table.texts("thumbnails"),
    rowOf: rowsById(id),
  };
}

function readLandmarks(value: unknown, where: string): LandmarkTable {
  const table = new TableReader(value, where, "position", 3);
  return {
    count: table.rows,
    position: table.column("position", 3),
    colour: table.optional("colour", 3),
    sigma: table.optional("sigma_m"),
    keyframe: table.column("keyframe"),
  };
}

function readPlaces(value: unknown, where: string): PlaceTable {
  const table = new TableReader(value, where, "id");
  const id = table.column("id");
  return {
    count: table.rows,
    id,
    keyframe: table.column("keyframe"),
    component: table.column("component"),
    position: table.column("position", 3),
    rowOf: rowsById(id),
  };
}

function readConstraints(value: unknown, where: string): ConstraintTable {
  const table = new TableReader(value, where, "from");
  return { count: table.rows, from: table.column("from"), to: table.column("to"), source: table.labels("source") };
}

function readLoops(value: unknown, where: string): LoopTable {
  const table = new TableReader(value, where, "query_frame");
  return {
    count: table.rows,
    query: table.column("query_frame"),
    match: table.column("match_frame"),
    probability: table.column("probability"),
    similarity: table.column("similarity"),
    inliers: table.column("inliers"),
    lines: table.column("lines"),
    stage: table.labels("stage"),
  };
}

function readPlane(value: unknown, where: string): PlaneShape {
  const json = asObject(value, where);
  const rgb = listOf(json["rgb"], `${where}.rgb`, asNumber);
  if (rgb.length !== 3) throw new Error(`${where}.rgb has ${rgb.length} values; it must have 3.`);
  return {
    name: asText(json["name"], `${where}.name`),
    rgb: [rgb[0], rgb[1], rgb[2]],
    outline: readColumn(json["outline"], `${where}.outline`, 3).values,
  };
}

function readPlanLine(value: unknown, where: string): PlanShape {
  const json = asObject(value, where);
  return {
    label: asText(json["label"], `${where}.label`),
    closed: asBoolean(json["closed"], `${where}.closed`),
    points: readColumn(json["points"], `${where}.points`, 2).values,
  };
}

function readGeoreference(value: unknown, where: string): GeoTrack {
  const json = asObject(value, where);
  return {
    latitude: asNumberOrNaN(json["latitude_deg"], `${where}.latitude_deg`),
    longitude: asNumberOrNaN(json["longitude_deg"], `${where}.longitude_deg`),
    track: readColumn(json["track"], `${where}.track`, 2).values,
  };
}
