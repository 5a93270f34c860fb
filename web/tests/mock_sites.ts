/** The two kinds of sites of the mock server: a saved map with edits, and a run of 60 frames. */
import type { ServerResponse } from "node:http";
import { decodeReport } from "../src/data/decode";
import type { RunData } from "../src/data/model";
import { keyframeAt, keyframeOf } from "../src/data/run_view";
import type { Report, Run } from "../src/data/report";
import { column, labels } from "./encode";
import { type Answer, type Site, json, refusal } from "./mock_server";
import { sampleReport, sampleRun } from "./sample";
import { HEIGHT, WIDTH, street } from "./thumbnail";

const SCALE = 5;

interface Loop {
  query: number;
  match: number;
  stage: string;
}

const LOOPS: Loop[] = [
  { query: 40, match: 11, stage: "accepted" },
  { query: 46, match: 18, stage: "geometry" },
  { query: 52, match: 23, stage: "accepted" },
];

function runWith(loops: Loop[]): Run {
  const run = sampleRun({ name: "town", frames: 60, landmarks: 1500, keyframeEvery: 3 });
  const numbers = (of: (loop: Loop) => number): ReturnType<typeof column> => column("f32", loops.map(of));
  run.loops = {
    query_frame: column(
      "i32",
      loops.map(({ query }) => query),
    ),
    match_frame: column(
      "i32",
      loops.map(({ match }) => match),
    ),
    probability: numbers(({ stage }) => (stage === "accepted" ? 0.97 : 0.31)),
    similarity: numbers(({ stage }) => (stage === "accepted" ? 0.8 : 0.4)),
    inliers: column(
      "i32",
      loops.map(({ stage }) => (stage === "accepted" ? 74 : 9)),
    ),
    lines: column(
      "i32",
      loops.map(() => 3),
    ),
    stage: labels(loops.map(({ stage }) => stage)),
    reason: null,
    rank: null,
    judged: false,
  };
  run.summary.loops_accepted = loops.filter(({ stage }) => stage === "accepted").length;
  return run;
}

/** The pages that both kinds have. */
function frameFile(run: RunData, path: string): Answer | null {
  const match = /^runs\/0\/frames\/(\d+)\/(image\.jpg|observations\.json)$/.exec(path);
  const row = run.frames.rowOf.get(Number(match?.[1]));
  if (!match || row === undefined) return null;
  if (match[2] === "image.jpg") return { status: 200, type: "image/png", body: imageOf(run, row) };
  if (keyframeOf(run, row) < 0) return refusal(404, `Frame ${row} is no keyframe.`);
  return json({ points: column("f32", observations(run, row), 3) });
}

function imageOf(run: RunData, row: number): Buffer {
  const heading = 2 * Math.asin(run.frames.truth?.[7 * row + 4] ?? 0);
  return street(heading, row / 4, SCALE);
}

/** The landmarks of the keyframe on a raster, and one point that has none. */
function observations(run: RunData, row: number): number[] {
  const keyframe = run.keyframes.id[keyframeAt(run, row)];
  const values = [20, 20, -1];
  for (let i = 0, k = 0; i < run.landmarks.count && k < 60; i++) {
    if (run.landmarks.keyframe[i] !== keyframe) continue;
    values.push(40 + 40 * (k % 10), 60 + 30 * Math.floor(k / 10), i);
    k++;
  }
  return values;
}

/** A saved map; optimizing it bends its trajectory. */
export class ViewSite implements Site {
  readonly start = { kind: "view" as const, title: "town", editable: true };
  private edits: { text: string; loops: Loop[]; bend: number }[] = [];
  private unsaved = false;
  private optimized = true;
  /** Names of the maps that were saved. */
  readonly saved: string[] = [];

  constructor(private readonly withImages = true) {}

  answer(method: string, path: string, body: unknown): Answer | null {
    const report = this.report();
    if (path === "report.json") return json(report);
    if (path === "edits.json") return json(this.list());
    if (path === "edits" && method === "POST") return this.edit(body as Record<string, unknown>);
    if (path.endsWith("image.jpg") && !this.withImages)
      return refusal(404, "The recording is not at /data/town any more.");
    return frameFile(decodeReport(report).runs[0], path);
  }

  close(): void {
    // nothing is open
  }

  private get loops(): Loop[] {
    return this.edits.at(-1)?.loops ?? LOOPS;
  }

  private get bend(): number {
    return this.edits.at(-1)?.bend ?? 0;
  }

  private report(): Report {
    const run = runWith(this.loops);
    const { pose, count } = decodeReport(sampleReport([run])).runs[0].frames;
    const bent = Array.from(pose);
    for (let row = 0; row < count; row++) bent[7 * row] += this.bend * Math.sin(row / 10);
    run.frames.pose = column("f32", bent, 7);
    return sampleReport([run]);
  }

  private list(): object {
    return { edits: this.edits.map(({ text }) => text), unsaved: this.unsaved, optimized: this.optimized };
  }

  private edit(body: Record<string, unknown>): Answer {
    const { action, query_frame: query, match_frame: match } = body;
    const { loops, bend } = this;
    const known = loops.find((loop) => loop.query === query && loop.match === match);
    const ends = `the loop of frames ${String(query)} and ${String(match)}`;
    const change = (stage: string): Loop[] => loops.map((loop) => (loop === known ? { ...loop, stage } : loop));
    switch (action) {
      case "refuse":
        return this.note(`refused ${ends}`, change("manual"), bend);
      case "accept":
        return this.note(`accepted ${ends}`, change("accepted"), bend);
      case "add":
        if (Number(query) - Number(match) < 20)
          return json({ error: "no geometric agreement: 9 inliers of 20 needed" }, 409);
        return this.note(
          `added ${ends}`,
          [...loops, { query: Number(query), match: Number(match), stage: "accepted" }],
          bend,
        );
      case "optimize":
        return this.note("optimized the place graph", loops, bend + 0.5);
      case "undo":
        this.edits.pop();
        this.unsaved = this.edits.length > 0;
        return json({ text: "took back the last edit", ...this.list() });
      case "save":
        this.saved.push(String(body["name"]));
        this.unsaved = false;
        return json({ text: `saved as /data/runs/town/${String(body["name"])}.db`, ...this.list() });
    }
    return refusal(400, "There is no such action.");
  }

  private note(text: string, loops: Loop[], bend: number): Answer {
    this.edits.push({ text, loops, bend });
    this.unsaved = true;
    this.optimized = text.startsWith("optimized");
    return json({ text: text, ...this.list() });
  }
}

/** A run of 60 frames, one each `frameMs`, with a slow start when somebody first follows it. Frame 20 and 21 are lost; at 40 a loop closes and the map moves. */
export class RunSite implements Site {
  readonly start = { kind: "run" as const, title: "town", editable: false };
  private readonly run = decodeReport(sampleReport([runWith(LOOPS)])).runs[0];
  private readonly streams = new Set<ServerResponse>();
  private done = 0;
  private moved = false;
  private paused = false;
  private finished = false;
  /** Number of the newest event, and of the one that the run began again. */
  private number = 0;
  private began = 0;
  private timer: NodeJS.Timeout | undefined;

  /** The run waits when `holdAt` frames are done. */
  constructor(
    private readonly frameMs = 60,
    private holdAt = Infinity,
  ) {}

  answer(method: string, path: string, body: unknown): Answer | null {
    switch (path) {
      case "report.json":
        return this.finished ? json(sampleReport([runWith(LOOPS)])) : refusal(404, "The run has no report yet.");
      case "live/state.json":
        return json(this.state());
      case "live/image.json":
        return this.done === 0 ? { status: 204, type: "text/plain", body: "" } : json(this.image(this.done - 1));
      case "control":
        return method === "POST" ? this.control(String((body as { action: unknown }).action)) : null;
    }
    return frameFile(this.run, path);
  }

  stream(response: ServerResponse): void {
    this.streams.add(response);
    response.write(eventText(this.number, "joined", {}));
    this.timer ??= setTimeout(() => this.tick(), 800);
    response.on("close", () => this.streams.delete(response));
  }

  close(): void {
    clearTimeout(this.timer);
    this.drop();
  }

  /** Ends all streams, as a fault of the connection does. */
  drop(): void {
    for (const stream of this.streams) stream.destroy();
    this.streams.clear();
  }

  /** The run goes on to its end. */
  release(): void {
    this.holdAt = Infinity;
  }

  /** The run begins again. */
  reset(holdAt: number): void {
    this.holdAt = holdAt;
    this.done = 0;
    this.moved = false;
    this.send("reset", {});
    this.began = this.number;
  }

  private tick(): void {
    if (!this.paused && this.done < this.holdAt) this.frame();
    if (!this.finished) this.timer = setTimeout(() => this.tick(), this.frameMs);
  }

  private isLost(row: number): boolean {
    return row === 20 || row === 21;
  }

  private pose(row: number): number[] {
    const { pose } = this.run.frames;
    const online = this.run.frames.online ?? pose;
    const lost = this.isLost(row);
    return Array.from((this.moved ? pose : online).subarray(7 * row, 7 * row + 7), (v) => (lost ? NaN : v));
  }

  private frame(): void {
    const row = this.done++;
    const { frames } = this.run;
    this.send("frame", this.frameJson(row));
    for (const loop of LOOPS.filter(({ query }) => query === frames.id[row])) this.send("loop", loopJson(loop));
    if (frames.id[row] === 40) this.move();
    if (row % 5 === 0) this.send("stages", stages(row));
    if (this.done === frames.count) this.finish();
  }

  private stateName(row: number): string {
    return row < 2 ? "initializing" : this.isLost(row) ? "lost" : "tracking";
  }

  private inliers(row: number): number {
    return this.isLost(row) ? 0 : (this.run.frames.inliers?.[row] ?? 0);
  }

  private frameJson(row: number): object {
    const { frames } = this.run;
    const lost = this.isLost(row);
    return {
      frame: frames.id[row],
      index: row,
      total: frames.count,
      stamp_s: frames.stamp[row],
      state: this.stateName(row),
      component: lost ? -1 : 0,
      inliers: this.inliers(row),
      confidence: lost ? null : 0.9,
      pose: lost ? null : this.pose(row),
      keyframe: keyframeOf(this.run, row) >= 0,
      reason: lost ? "too few points agree with the motion" : "",
    };
  }

  private move(): void {
    this.moved = true;
    this.send("moved", {});
  }

  private finish(): void {
    this.finished = true;
    this.send("done", { verdict: "good" });
  }

  private control(action: string): Answer {
    if (action === "step") this.frame();
    this.paused = action !== "resume";
    this.send("control", { paused: this.paused });
    return json({ paused: this.paused });
  }

  private state(): object {
    const rows = Array.from({ length: this.done }, (_, row) => row);
    const numbers = (of: (row: number) => number): ReturnType<typeof column> => column("i32", rows.map(of));
    const { id } = this.run.frames;
    const { count, keyframe, position } = this.run.landmarks;
    const seen: number[] = [];
    for (let i = 0; i < count; i++) {
      if (this.run.keyframes.frame[keyframe[i]] < this.done) seen.push(...position.subarray(3 * i, 3 * i + 3));
    }
    return {
      number: this.number,
      began: this.began,
      total: this.run.frames.count,
      done: this.done,
      paused: this.paused,
      finished: this.finished,
      verdict: this.finished ? "good" : null,
      last: this.done > 0 ? this.frameJson(this.done - 1) : null,
      stages: this.done > 0 ? stages(this.done - 1) : [],
      frames: {
        id: numbers((row) => id[row]),
        component: numbers((row) => (this.isLost(row) ? -1 : 0)),
        pose: column(
          "f32",
          rows.flatMap((row) => this.pose(row)),
          7,
        ),
        inliers: numbers((row) => this.inliers(row)),
        state: labels(rows.map((row) => this.stateName(row))),
        keyframe: column(
          "u8",
          rows.map((row) => (keyframeOf(this.run, row) >= 0 ? 1 : 0)),
        ),
      },
      landmarks: column("f32", seen, 3),
      loops: LOOPS.filter(({ query }) => query < this.done).map(loopJson),
    };
  }

  private image(row: number): object {
    const points: number[] = [];
    for (let i = 0; i < 120; i++) {
      const u = (37 * i + 11 * row) % (WIDTH * SCALE);
      points.push(u, 40 + ((53 * i) % (HEIGHT * SCALE - 60)), i % 9 === 0 ? NaN : 3.5 * Math.abs(Math.sin(i)));
    }
    const lines = [40, 200, 200, 160, 0.4, 280, 160, 440, 210, 2.1, 60, 90, 60, 180, NaN];
    return {
      frame: this.run.frames.id[row],
      image: `data:image/png;base64,${imageOf(this.run, row).toString("base64")}`,
      width: WIDTH * SCALE,
      height: HEIGHT * SCALE,
      points: column("f32", points, 3),
      lines: column("f32", lines, 5),
    };
  }

  private send(event: string, data: object): void {
    const text = eventText(++this.number, event, data);
    for (const stream of this.streams) stream.write(text);
  }
}

function eventText(number: number, event: string, data: object): string {
  return `id: ${number}\nevent: ${event}\ndata: ${JSON.stringify(data)}\n\n`;
}

function loopJson({ query, match, stage }: Loop): object {
  const accepted = stage === "accepted";
  return {
    query_frame: query,
    match_frame: match,
    stage,
    accepted,
    probability: accepted ? 0.97 : 0.31,
    inliers: accepted ? 74 : 9,
  };
}

function stages(row: number): object[] {
  return [
    { name: "features", cpu_s: 0.02 * (row + 1), calls: row + 1 },
    { name: "tracking", cpu_s: 0.012 * (row + 1), calls: row + 1 },
    { name: "local_adjustment", cpu_s: 0.03 * (row + 1), calls: Math.ceil((row + 1) / 3) },
    { name: "loops", cpu_s: 0.004 * (row + 1), calls: Math.ceil((row + 1) / 3) },
  ];
}
