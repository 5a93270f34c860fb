import { describe, expect, it } from "vitest";
import { decodeLiveStart } from "../../src/live/live_start";
import {
  type FrameEvent,
  type LiveEvent,
  type Snapshot,
  type Stage,
  EVENT_KINDS,
  decodeEvent,
  decodeLiveImage,
  decodeSnapshot,
} from "../../src/live/events";
import { decodeObservations, nearestPoint } from "../../src/live/frame_files";
import { faultText } from "../../src/live/http";
import { LiveMotion, ease } from "../../src/live/live_motion";
import { sentenceOf } from "../../src/live/live_panel";
import { LiveRun } from "../../src/live/live_run";
import { column } from "../encode";
import { Random } from "../random";

const FRAME = {
  frame: 7,
  index: 3,
  total: 60,
  stamp_s: 0.4,
  state: "tracking",
  component: 0,
  inliers: 120,
  confidence: null,
  pose: [1, 2, 3, 0, 0, 0, 1],
  keyframe: true,
  reason: "",
};
const LOOP = { query_frame: 40, match_frame: 3, stage: "accepted", accepted: true, probability: 0.9, inliers: 54 };

function frameEvent(id: number, x: number, lost = false): { kind: "frame"; frame: FrameEvent } {
  const frame: FrameEvent = {
    frame: id,
    index: id,
    total: 20,
    stamp: id / 10,
    state: lost ? "lost" : "tracking",
    component: lost ? -1 : 0,
    inliers: 100,
    confidence: NaN,
    pose: lost ? null : [x, 0, 0, 0, 0, 0, 1],
    keyframe: false,
    reason: "",
    landmarks: null,
  };
  return { kind: "frame", frame };
}

function snapshot(version: number, xs: number[], finished = false): Snapshot {
  return decodeSnapshot({
    version,
    total: 20,
    done: xs.length,
    paused: false,
    finished,
    frame_ids: column("i32", Array.from(xs.keys())),
    component: column(
      "i32",
      xs.map(() => 0),
    ),
    pose: column(
      "f32",
      xs.flatMap((x) => [x, 0, 0, 0, 0, 0, 1]),
      7,
    ),
    landmarks: column("f32", [0, 0, 1], 3),
    loops: [],
  });
}

function positions({ frames }: LiveRun): number[] {
  return Array.from({ length: frames.count }, (_, row) => frames.pose[7 * row]);
}

describe("the events", () => {
  it("are decoded", () => {
    const event = decodeEvent("frame", FRAME);
    expect(event).toMatchObject({ kind: "frame", frame: { frame: 7, index: 3, pose: FRAME.pose, keyframe: true } });
    expect(event.kind === "frame" && event.frame.confidence).toBeNaN();
    expect(decodeEvent("loop", LOOP)).toMatchObject({ kind: "loop", loop: { query: 40, match: 3, inliers: 54 } });
    const made = decodeEvent("frame", { ...FRAME, landmarks: column("f32", [1, 2, 3], 3) });
    expect(made.kind === "frame" && Array.from(made.frame.landmarks ?? [])).toEqual([1, 2, 3]);
    expect(decodeEvent("moved", { version: 3 })).toEqual({ kind: "moved", version: 3 });
    expect(decodeEvent("stages", [{ name: "loops", cpu_s: 0.5, calls: 2 }])).toEqual({
      kind: "stages",
      stages: [{ name: "loops", cpuS: 0.5, calls: 2 }],
    });
    expect(decodeEvent("control", { paused: true })).toEqual({ kind: "control", paused: true });
    expect(decodeEvent("done", { verdict: null })).toEqual({ kind: "done", verdict: null });
  });

  it("that are damaged are named in a sentence", () => {
    expect(() => decodeEvent("frame", { ...FRAME, pose: [1, 2] })).toThrow("frame.pose has 2 values; it must have 7.");
    expect(() => decodeEvent("frame", { ...FRAME, state: "asleep" })).toThrow("frame.state");
    expect(() => decodeEvent("stages", [{}])).toThrow("stages[0].name");
    expect(() => decodeEvent("moved", null)).toThrow('The event "moved" is missing or is no object.');
  });

  it("come with an image of points and lines, without a landmark some of them", () => {
    const image = decodeLiveImage({
      frame: 2,
      image: "data:image/jpeg;base64,AA==",
      width: 640,
      height: 480,
      points: column("f32", [1, 2, NaN, 3, 4, 0.5], 3),
      lines: column("f32", [], 5),
    });
    expect(image.pointCount).toBe(2);
    expect(image.lineCount).toBe(0);
    expect(image.points[2]).toBeNaN();
  });

  it("are told in words only if they are news", () => {
    const tracking = decodeEvent("frame", FRAME);
    const lost = decodeEvent("frame", { ...FRAME, state: "lost", pose: null, reason: "blur" });
    expect(sentenceOf(tracking, "tracking")).toBeNull();
    expect(sentenceOf(tracking, "lost")).toContain("has a pose");
    expect(sentenceOf(lost, "tracking")).toBe("Frame 7 is lost: blur.");
    expect(sentenceOf(lost, "lost")).toBeNull();
    expect(sentenceOf(decodeEvent("loop", { ...LOOP, accepted: false }), "")).toBeNull();
    expect(sentenceOf(decodeEvent("loop", LOOP), "")).toBe("The loop of frames 40 and 3 is accepted, 54 inliers.");
  });
});

describe("a run that goes on", () => {
  it("grows by frames, and is stale from the beginning and after a move", () => {
    const run = new LiveRun();
    expect(run.stale).toBe(true);
    expect(run.take(snapshot(0, []))).toBe(true);
    expect(run.stale).toBe(false);
    run.apply(frameEvent(0, 0));
    run.apply(frameEvent(1, 1));
    run.apply({ kind: "moved", version: 1 });
    expect(run.stale).toBe(true);
    expect(run.take(snapshot(0, [0, 1]))).toBe(false);
    run.apply(frameEvent(2, 2.5));
    expect(run.take(snapshot(1, [0.2, 1.2]))).toBe(true);
    expect(positions(run)).toEqual([0.2, 1.2, 2.5].map(Math.fround));
    expect(run.stale).toBe(false);
    expect(run.done).toBe(3);
  });

  it("forgets all at a reset, and takes no snapshot from before", () => {
    const run = new LiveRun();
    run.take(snapshot(0, [0, 1, 2]));
    run.apply(decodeEvent("loop", { ...LOOP, query_frame: 2, match_frame: 0 }));
    run.apply({ kind: "reset", version: 5 });
    expect(run.frames.count).toBe(0);
    expect(run.loops.size).toBe(0);
    run.apply(frameEvent(0, 9));
    expect(run.take(snapshot(4, [0, 1, 2]))).toBe(false);
    expect(run.take(snapshot(5, [9]))).toBe(true);
    expect(positions(run)).toEqual([9]);
  });

  it("is paused as its events say, whatever an older snapshot says", () => {
    const run = new LiveRun();
    const paused = { ...snapshot(0, []), paused: true };
    run.take(paused);
    expect(run.paused).toBe(true);
    run.apply({ kind: "control", paused: false });
    run.take(paused);
    expect(run.paused).toBe(false);
    run.markStale();
    run.take(paused);
    expect(run.paused).toBe(true);
  });

  it("is done by an event or by a snapshot, and runs again after a reset", () => {
    const run = new LiveRun();
    run.take(snapshot(0, [0], true));
    expect(run.phase).toBe("done");
    run.apply({ kind: "reset", version: 1 });
    expect(run.phase).toBe("running");
    run.apply({ kind: "done", verdict: "good" });
    run.apply(frameEvent(0, 1));
    expect(run.phase).toBe("done");
    expect(run.verdict).toBe("good");
  });

  it("is joined in its middle: earlier frames come before those of the events", () => {
    const run = new LiveRun();
    run.apply(frameEvent(5, 5));
    run.apply(frameEvent(6, 6, true));
    run.take(snapshot(0, [0, 1, 2, 3, 4]));
    expect(Array.from({ length: 7 }, (_, row) => run.frames.id(row))).toEqual([0, 1, 2, 3, 4, 5, 6]);
    expect(run.frames.row(5)).toBe(5);
    expect(run.frames.isPosed(6)).toBe(false);
    expect(run.frames.state(0)).toBeNull();
    expect(run.component).toBe(0);
  });

  it("holds 10,000 frames and a bounded number of refused loops", () => {
    const run = new LiveRun();
    for (let id = 0; id < 10000; id++) {
      run.apply(frameEvent(id, id));
      run.apply(decodeEvent("loop", { ...LOOP, query_frame: id, accepted: id % 100 === 0, stage: "geometry" }));
    }
    expect(run.frames.count).toBe(10000);
    expect(run.frames.pose[7 * 9999]).toBe(9999);
    expect(run.loops.size).toBe(2000);
    expect([...run.loops.values()].filter((loop) => loop.accepted)).toHaveLength(100);
  });

  it("ends in the state of the program whatever events come, and whenever they and snapshots do", () => {
    const kinds = new Set<string>();
    for (let seed = 0; seed < 300; seed++) {
      const { run, truth, sent } = randomStory(new Random(seed));
      for (const { kind } of sent) kinds.add(kind);
      expect(run.stale, `seed ${seed}`).toBe(false);
      const poses = positions(run).filter((_, row) => run.frames.isPosed(row));
      expect(poses, `seed ${seed}`).toEqual(truth.xs.filter((x) => x !== null).map(Math.fround));
      expect(run.frames.count, `seed ${seed}`).toBe(truth.xs.length);
      expect(run.phase, `seed ${seed}`).toBe(truth.done ? "done" : "running");
      expect(run.paused, `seed ${seed}`).toBe(truth.paused);
      expect(run.stages, `seed ${seed}`).toEqual(truth.stages);
      expect([...run.loops.keys()].sort(), `seed ${seed}`).toEqual([...truth.loops.keys()].sort());
      for (const [key, accepted] of truth.loops)
        expect(run.loops.get(key)?.accepted, `seed ${seed}, loop ${key}`).toBe(accepted);
    }
    expect([...kinds].sort()).toEqual([...EVENT_KINDS].sort());
  });
});

/** What a program that tracks knows: a position of each frame, or null where it is lost. */
interface Truth {
  xs: (number | null)[];
  loops: Map<string, boolean>;
  stages: Stage[];
  version: number;
  paused: boolean;
  done: boolean;
}

function snapshotOf({ xs, loops, version, paused, done }: Truth): Snapshot {
  const posed = Array.from(xs.keys()).filter((id) => xs[id] !== null);
  const whole = snapshot(version, xs.map((x) => x ?? 0), done);
  return decodeSnapshot({
    version,
    total: 20,
    done: xs.length,
    paused,
    finished: done,
    frame_ids: column("i32", Array.from(xs.keys())),
    component: column("i32", Array.from(xs.keys(), (id) => (posed.includes(id) ? 0 : -1))),
    pose: column("f32", Array.from(whole.pose), 7),
    landmarks: column("f32", [0, 0, 1], 3),
    loops: Array.from(loops, ([key, accepted]) => {
      const [query, match] = key.split(" ").map(Number);
      return { ...LOOP, query_frame: query, match_frame: match, accepted, stage: accepted ? "accepted" : "geometry" };
    }),
  });
}

/**
 * A program that tracks, is lost, finds loops, moves its map, is paused, begins again and ends; its events arrive in
 * order, its snapshots late.
 */
function randomStory(random: Random): { run: LiveRun; truth: Truth; sent: LiveEvent[] } {
  const run = new LiveRun();
  const truth: Truth = { xs: [], loops: new Map(), stages: [], version: 0, paused: false, done: false };
  const sent: LiveEvent[] = [];
  const events: LiveEvent[] = [];
  let asked: Snapshot | null = null;
  const send = (event: LiveEvent) => {
    sent.push(event);
    events.push(event);
  };
  const tell = (what: number) => {
    if (what < 0.5) {
      if (truth.done) return;
      const lost = random.uniform() < 0.2;
      const x = random.between(0, 100);
      send(frameEvent(truth.xs.length, x, lost));
      truth.xs.push(lost ? null : x);
    } else if (what < 0.65 && truth.xs.length > 1) {
      const query = Math.floor(random.between(1, truth.xs.length - 1e-9));
      if (truth.loops.has(`${query} 0`)) return; // a pair is decided once
      const accepted = random.uniform() < 0.5;
      send(decodeEvent("loop", { ...LOOP, query_frame: query, match_frame: 0, accepted }));
      truth.loops.set(`${query} 0`, accepted);
    } else if (what < 0.78) {
      truth.xs = truth.xs.map((x) => (x === null ? null : x + 1));
      send({ kind: "moved", version: ++truth.version });
    } else if (what < 0.84) {
      truth.stages = [{ name: "loops", cpuS: random.uniform(), calls: 1 }];
      send({ kind: "stages", stages: truth.stages });
    } else if (what < 0.92) {
      truth.paused = !truth.paused;
      send({ kind: "control", paused: truth.paused });
    } else if (what < 0.96) {
      Object.assign(truth, { xs: [], loops: new Map(), done: false });
      send({ kind: "reset", version: ++truth.version });
    } else {
      truth.done = true;
      send({ kind: "done", verdict: null });
    }
  };
  for (let step = 0; step < 80; step++) {
    const what = random.uniform();
    if (what < 0.6) tell(random.uniform());
    else if (what < 0.8) for (const event of events.splice(0, 1 + Math.floor(3 * random.uniform()))) run.apply(event);
    else if (asked === null) asked = snapshotOf(truth);
    else {
      run.take(asked);
      asked = null;
    }
  }
  for (const event of events) run.apply(event);
  if (asked) run.take(asked);
  if (run.stale) run.take(snapshotOf(truth));
  return { run, truth, sent };
}

describe("the shown positions", () => {
  it("move smoothly to the new ones", () => {
    const run = new LiveRun();
    run.apply(frameEvent(0, 0));
    run.apply(frameEvent(1, 1));
    const motion = new LiveMotion();
    expect(motion.step(run.frames, 0)).toBe(0);
    run.take(snapshot(0, [0, 3]));
    motion.start(run.frames, 1000);
    run.apply(frameEvent(2, 5));
    expect(motion.step(run.frames, 1350)).toBe(0);
    expect(motion.shown[3]).toBeCloseTo(1 + 2 * ease(0.5), 5);
    expect(motion.shown[6]).toBe(5);
    motion.step(run.frames, 2000);
    expect(motion.shown[3]).toBe(3);
    expect(motion.moving).toBe(false);
    expect(motion.step(run.frames, 2100)).toBe(3);
  });

  it("follow an event of a frame of which a snapshot has told without a pose", () => {
    const run = new LiveRun();
    run.take(snapshot(0, [0, NaN]));
    const motion = new LiveMotion();
    motion.step(run.frames, 0);
    expect(motion.shown[3]).toBeNaN();
    run.apply(frameEvent(1, 7));
    expect(motion.step(run.frames, 10)).toBe(1);
    expect(motion.shown[3]).toBe(7);
  });

  it("stay where nothing has moved", () => {
    const run = new LiveRun();
    run.take(snapshot(0, [0, 1]));
    const motion = new LiveMotion();
    motion.step(run.frames, 0);
    motion.start(run.frames, 10);
    expect(motion.moving).toBe(false);
  });
});

describe("a served page", () => {
  it("knows what serves it", () => {
    const start = { format: "placegraph-live-1", kind: "view", program: "p", title: "t", editable: true };
    expect(decodeLiveStart(start)).toEqual({ kind: "view", program: "p", title: "t", editable: true });
    expect(() => decodeLiveStart({ ...start, format: "placegraph-live-2" })).toThrow("placegraph-live-2");
  });

  it("tells why a request is refused", () => {
    expect(faultText(409, '{"error": "no geometric agreement: 9 inliers of 20 needed"}')).toBe(
      "no geometric agreement: 9 inliers of 20 needed",
    );
    expect(faultText(404, "The recording is gone.\n")).toBe("The recording is gone.");
    expect(faultText(500, "")).toBe("The program answers with status 500.");
  });

  it("finds the observation near the pointer", () => {
    const seen = decodeObservations({ points: column("f32", [10, 10, 4, 14, 10, -1], 3) });
    expect(Array.from(seen.landmark)).toEqual([4, -1]);
    expect(nearestPoint(seen, 11, 10, 5)).toBe(0);
    expect(nearestPoint(seen, 13, 10, 5)).toBe(1);
    expect(nearestPoint(seen, 30, 10, 5)).toBe(-1);
  });
});
