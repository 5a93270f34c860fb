import { describe, expect, it } from "vitest";
import { decodeLiveStart } from "../../src/live/live_start";
import {
  type FrameEvent,
  type LiveEvent,
  type News,
  type Snapshot,
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
import { column, labels } from "../encode";
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

function frameNews(id: number, x: number, lost = false): News & { kind: "frame" } {
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

function frameEvent(number: number, id: number, x: number, lost = false): LiveEvent {
  return { ...frameNews(id, x, lost), number };
}

/** `xs`: NaN for a frame without a pose. */
function snapshot(number: number, xs: number[], more: object = {}): Snapshot {
  const posed = xs.map((x) => !Number.isNaN(x));
  return decodeSnapshot({
    number,
    began: 0,
    total: 20,
    done: xs.length,
    paused: false,
    finished: false,
    verdict: null,
    last: null,
    stages: [],
    frames: {
      id: column("i32", Array.from(xs.keys())),
      component: column(
        "i32",
        posed.map((is) => (is ? 0 : -1)),
      ),
      pose: column(
        "f32",
        xs.flatMap((x) => [x, 0, 0, 0, 0, 0, 1]),
        7,
      ),
      inliers: column(
        "i32",
        xs.map(() => 100),
      ),
      state: labels(posed.map((is) => (is ? "tracking" : "lost"))),
      keyframe: column(
        "u8",
        xs.map(() => 0),
      ),
    },
    landmarks: column("f32", [], 3),
    loops: [],
    ...more,
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
    expect(decodeEvent("moved", {})).toEqual({ kind: "moved" });
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
    run.apply(frameEvent(1, 0, 0));
    run.apply(frameEvent(2, 1, 1));
    run.apply({ kind: "moved", number: 3 });
    expect(run.stale).toBe(true);
    expect(run.take(snapshot(2, [0, 1]))).toBe(false);
    run.apply(frameEvent(4, 2, 2.5));
    expect(run.take(snapshot(3, [0.2, 1.2]))).toBe(true);
    expect(positions(run)).toEqual([0.2, 1.2, 2.5].map(Math.fround));
    expect(run.stale).toBe(false);
    expect(run.done).toBe(3);
  });

  it("forgets all at a reset, which holds against a snapshot from before", () => {
    const run = new LiveRun();
    run.take(snapshot(3, [0, 1, 2]));
    run.apply({ ...decodeEvent("loop", { ...LOOP, query_frame: 2, match_frame: 0 }), number: 4 });
    run.apply({ kind: "reset", number: 5 });
    expect(run.frames.count).toBe(0);
    expect(run.loops.size).toBe(0);
    run.apply(frameEvent(6, 0, 9));
    for (const news of [snapshot(4, [0, 1, 2]), snapshot(5, [], { began: 5 })]) {
      expect(run.take(news)).toBe(true);
      expect(positions(run)).toEqual([9]);
      expect(run.began).toBe(5);
    }
  });

  it("is stale after a gap in the stream, and where it joins the stream behind its snapshot", () => {
    const run = new LiveRun();
    run.take(snapshot(1, [0]));
    run.apply({ kind: "joined", number: 1 });
    run.apply(frameEvent(2, 1, 1));
    expect(run.stale).toBe(false);
    run.apply(frameEvent(4, 3, 3));
    expect(run.stale).toBe(true);
    expect(run.take(snapshot(2, [0, 1]))).toBe(false);
    expect(run.take(snapshot(3, [0, 1, 2]))).toBe(true);
    expect(positions(run)).toEqual([0, 1, 2, 3]);
    run.apply({ kind: "joined", number: 6 });
    expect(run.stale).toBe(true);
    expect(run.take(snapshot(6, [0, 1, 2, 3, 4, 5]))).toBe(true);
    expect(run.done).toBe(6);
  });

  it("is paused as its events say, whatever an older snapshot says", () => {
    const run = new LiveRun();
    run.take(snapshot(1, [], { paused: true }));
    expect(run.paused).toBe(true);
    run.apply({ kind: "control", paused: false, number: 2 });
    run.take(snapshot(1, [], { paused: true }));
    expect(run.paused).toBe(false);
    run.take(snapshot(3, [], { paused: true }));
    expect(run.paused).toBe(true);
  });

  it("is done by an event or by a snapshot, and runs again after a reset", () => {
    const run = new LiveRun();
    run.take(snapshot(2, [0], { finished: true, verdict: "doubtful" }));
    expect(run.phase).toBe("done");
    expect(run.verdict).toBe("doubtful");
    run.apply({ kind: "reset", number: 3 });
    expect(run.phase).toBe("running");
    run.apply({ kind: "done", verdict: "good", number: 4 });
    run.apply(frameEvent(5, 0, 1));
    expect(run.phase).toBe("done");
    expect(run.verdict).toBe("good");
  });

  it("is joined in its middle: earlier frames come before those of the events", () => {
    const run = new LiveRun();
    run.apply(frameEvent(6, 5, 5));
    run.apply(frameEvent(7, 6, 6, true));
    const last = { ...FRAME, frame: 4, index: 4 };
    run.take(snapshot(5, [0, 1, 2, NaN, 4], { last, stages: [{ name: "loops", cpu_s: 0.5, calls: 2 }] }));
    expect(Array.from({ length: 7 }, (_, row) => run.frames.id(row))).toEqual([0, 1, 2, 3, 4, 5, 6]);
    expect(run.frames.row(5)).toBe(5);
    expect(run.frames.isPosed(6)).toBe(false);
    expect(run.frames.state(0)).toBe("tracking");
    expect(run.frames.state(3)).toBe("lost");
    expect(run.frames.inliers(0)).toBe(100);
    expect(run.component).toBe(0);
    expect(run.last?.frame).toBe(6);
    expect(run.stages).toHaveLength(1);
  });

  it("holds 10,000 frames and a bounded number of refused loops", () => {
    const run = new LiveRun();
    for (let id = 0; id < 10000; id++) {
      run.apply(frameEvent(2 * id + 1, id, id));
      const loop = { ...LOOP, query_frame: id, accepted: id % 100 === 0, stage: "geometry" };
      run.apply({ ...decodeEvent("loop", loop), number: 2 * id + 2 });
    }
    expect(run.frames.count).toBe(10000);
    expect(run.frames.pose[7 * 9999]).toBe(9999);
    expect(run.loops.size).toBe(2000);
    expect([...run.loops.values()].filter((loop) => loop.accepted)).toHaveLength(100);
  });

  it("is what the program knows, in whatever order events, snapshots, gaps and reloads come", () => {
    const kinds = new Set<string>();
    for (let seed = 0; seed < 1000; seed++) {
      const story = new Story(new Random(seed));
      story.play(100);
      for (const { kind } of story.events) kinds.add(kind);
      const fresh = new LiveRun();
      fresh.take(snapshotOf(story.events));
      expect(shownBy(story.page), `seed ${seed}`).toEqual(shownBy(fresh));
      expect(story.page.stale, `seed ${seed}`).toBe(false);
    }
    expect([...kinds, "joined"].sort()).toEqual([...EVENT_KINDS].sort());
  });
});

/** All that a page shows of a run. */
function shownBy(run: LiveRun): object {
  const { frames, landmarks, last, stages, total, done, paused, phase, verdict, began } = run;
  const rows = Array.from({ length: frames.count }, (_, row) => row);
  return {
    frames: rows.map((row) => [frames.id(row), frames.component(row), frames.state(row), frames.inliers(row)]),
    positions: positions(run),
    landmarks: Array.from(landmarks.position.subarray(0, 3 * landmarks.count)),
    loops: [...run.loops],
    ...{ last: last?.frame, stages, total, done, paused, phase, verdict, began },
  };
}

/** An event as the program knows it; a move has the distance that everything moves by. */
type Told = LiveEvent & { by?: number };

/** The snapshot that the program makes after these events. */
function snapshotOf(events: Told[]): Snapshot {
  let xs: number[] = [];
  let marks: number[] = [];
  let loops: object[] = [];
  let last: object | null = null;
  const state = { began: 0, paused: false, finished: false, verdict: null as string | null, stages: [] as object[] };
  for (const event of events) {
    if (event.kind === "frame") {
      const { frame, index, pose } = event.frame;
      xs.push(pose?.[0] ?? NaN);
      marks.push(...(event.frame.landmarks ?? []).filter((_, i) => i % 3 === 0));
      last = { ...FRAME, frame, index };
    } else if (event.kind === "loop") {
      const { query, match, ...loop } = event.loop;
      loops.push({ ...loop, query_frame: query, match_frame: match });
    } else if (event.kind === "moved") {
      xs = xs.map((x) => x + (event.by ?? 0));
      marks = marks.map((x) => x + (event.by ?? 0));
    } else if (event.kind === "reset") {
      [xs, marks, loops, last] = [[], [], [], null];
      Object.assign(state, { began: event.number, finished: false, verdict: null });
    } else if (event.kind === "stages") {
      state.stages = event.stages.map(({ name, cpuS, calls }) => ({ name, cpu_s: cpuS, calls }));
    } else if (event.kind === "control") {
      state.paused = event.paused;
    } else if (event.kind === "done") {
      Object.assign(state, { finished: true, verdict: event.verdict });
    }
  }
  const landmarks = column(
    "f32",
    marks.flatMap((x) => [x, 0, 1]),
    3,
  );
  return snapshot(events.length, xs, { ...state, last, loops, landmarks });
}

/** A program that tracks, and a page that gets its events late, its snapshots in any order, loses both and is reloaded. */
class Story {
  readonly events: Told[] = [];
  page = new LiveRun();
  private received = 0;
  private asked: Snapshot[] = [];
  private frames = 0;

  constructor(private readonly random: Random) {
    this.join();
  }

  play(steps: number): void {
    for (let step = 0; step < steps; step++) {
      const what = this.random.uniform();
      if (what < 0.55) this.tell();
      else if (what < 0.75) this.receive(this.below(4));
      else if (what < 0.85) this.asked.push(snapshotOf(this.events));
      else if (what < 0.93) for (const answer of this.asked.splice(this.below(3), 1)) this.page.take(answer);
      else if (what < 0.96) this.received = Math.min(this.received + this.below(3), this.events.length);
      else if (what < 0.98) this.join();
      else {
        this.page = new LiveRun();
        this.asked = [];
        this.join();
      }
    }
    this.receive(Infinity);
    this.join();
    for (const answer of this.asked) this.page.take(answer);
    if (this.page.stale) this.page.take(snapshotOf(this.events));
  }

  private below(limit: number): number {
    return Math.floor(limit * this.random.uniform());
  }

  /** A stream of events begins: what was not received is lost. */
  private join(): void {
    this.received = this.events.length;
    this.page.apply({ kind: "joined", number: this.received });
  }

  private receive(count: number): void {
    for (; count > 0 && this.received < this.events.length; count--) this.page.apply(this.events[this.received++]);
  }

  private tell(): void {
    this.events.push({ ...this.news(), number: this.events.length + 1 });
  }

  private news(): News & { by?: number } {
    const what = this.random.uniform();
    if (what < 0.5) {
      const x = Math.fround(this.random.between(0, 100));
      const news = frameNews(this.frames++, x, this.random.uniform() < 0.2);
      if (news.frame.pose !== null && this.random.uniform() < 0.6)
        news.frame.landmarks = new Float32Array([x, 0, 1, x + 0.5, 0, 1]);
      return news;
    }
    if (what < 0.68) {
      const accepted = this.random.uniform() < 0.5;
      return decodeEvent("loop", { ...LOOP, query_frame: 1 + this.below(4), match_frame: 0, accepted });
    }
    if (what < 0.78) return { kind: "moved", by: 1 };
    if (what < 0.84) return { kind: "stages", stages: [{ name: "loops", cpuS: this.random.uniform(), calls: 1 }] };
    if (what < 0.92) return { kind: "control", paused: this.random.uniform() < 0.5 };
    if (what < 0.96) {
      this.frames = 0;
      return { kind: "reset" };
    }
    return { kind: "done", verdict: this.random.uniform() < 0.5 ? null : "good" };
  }
}

describe("the shown positions", () => {
  it("move smoothly to the new ones", () => {
    const run = new LiveRun();
    run.apply(frameEvent(1, 0, 0));
    run.apply(frameEvent(2, 1, 1));
    const motion = new LiveMotion();
    expect(motion.step(run.frames, 0)).toBe(0);
    run.take(snapshot(2, [0, 3]));
    motion.start(run.frames, 1000);
    run.apply(frameEvent(3, 2, 5));
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
    run.apply(frameEvent(1, 1, 7));
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
    expect(faultText(500, "out/map.db: database disk image is malformed\n")).toBe(
      "out/map.db: database disk image is malformed",
    );
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
