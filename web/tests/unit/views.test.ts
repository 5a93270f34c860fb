import { describe, expect, it } from "vitest";
import { decodeReport } from "../../src/data/decode";
import { type RunData, label } from "../../src/data/model";
import { isPosed, keyframeAt, keyframeOf, keyframeSpacing } from "../../src/data/run_view";
import { availableSeries, speeds, travelled } from "../../src/data/series";
import { Store } from "../../src/page/state";
import { chooseRun, startState } from "../../src/page/start_state";
import { worstEdges } from "../../src/panels/graph_panel";
import { stateSentence } from "../../src/panels/frame_panel";
import { toSegment } from "../../src/scene/picking";
import { cellSize } from "../../src/scene/grid_layer";
import { Quality } from "../../src/scene/quality";
import { Axis } from "../../src/timeline/axis";
import { sampleGraph, sampleReport, sampleRun, type SampleOptions } from "../sample";

function runOf(options: Partial<SampleOptions> = {}): RunData {
  return decodeReport(sampleReport([sampleRun({ frames: 100, landmarks: 0, thumbnails: false, ...options })])).runs[0];
}

describe("the axis", () => {
  const axis = new Axis(runOf(), "frame");

  it("maps values to pixels and back to the nearest frame", () => {
    expect(axis.pixel(49.5, axis.full, 200)).toBeCloseTo(100);
    expect(axis.row(axis.value(100, axis.full, 198))).toBe(50);
    expect(axis.row(-5)).toBe(0);
    expect(axis.row(1e6)).toBe(99);
  });

  it("zooms about a value and stays within its ends", () => {
    expect(axis.zoomed(axis.full, 10, 2)).toBeNull();
    const range = axis.zoomed([0, 99], 0, 0.5);
    expect(range).toEqual([0, 49.5]);
    expect(axis.containing([0, 20], 15)).toEqual([0, 20]);
    const moved = axis.containing([0, 20], 50);
    expect(moved[0]).toBeLessThan(50);
    expect(moved[1]).toBeGreaterThan(50);
  });

  it("by time has seconds since the first frame", () => {
    expect(new Axis(runOf(), "time").full[1]).toBeCloseTo(9.9, 4);
  });
});

describe("a run", () => {
  it("has the speed of its path, and none where frames are lost", () => {
    const run = runOf({ lost: [[40, 49]], partsAt: 1000 });
    const speed = speeds(run);
    expect(speed[45]).toBeNaN();
    expect(speed[20]).toBeGreaterThan(1.5);
    expect(speed[20]).toBeLessThan(4);
    expect(travelled(run)).toBeGreaterThan(10);
    expect(keyframeSpacing(run, null)).toBeGreaterThan(0.3);
  });

  it("says in words what a frame is", () => {
    const run = runOf({ lost: [[40, 49]], components: 2 });
    expect(stateSentence(run, 45)).toBe("The frame is lost: too few points agree with the motion.");
    expect(stateSentence(run, 0)).toBe("The frame is a keyframe of component 0 (main).");
    expect(run.frames.keyframe[1]).toBe(0);
    expect(keyframeOf(run, 1)).toBe(-1);
    expect(stateSentence(run, 1)).toBe("The frame has a pose of component 0 (main).");
    expect(isPosed(run, 60, 0)).toBe(false);
    expect(isPosed(run, 60, 1)).toBe(true);
  });

  it("knows the last keyframe before a frame", () => {
    const run = runOf();
    expect(keyframeAt(run, 0)).toBe(0);
    expect(run.keyframes.frame[keyframeAt(run, 5)]).toBe(3);
  });

  it("offers the graphs for which there are values", () => {
    expect(availableSeries(runOf())).toContain("error");
    expect(availableSeries(runOf({ truth: false }))).not.toContain("error");
  });
});

describe("the state", () => {
  const report = decodeReport(
    sampleReport([
      sampleRun({ frames: 50, landmarks: 0, thumbnails: false }),
      sampleRun({ frames: 80, landmarks: 0, truth: false, thumbnails: false }),
    ]),
  );

  it("keeps the frame when another run is chosen", () => {
    const state = { ...startState(report, "dark"), row: 30 };
    const change = chooseRun(report, state, 1);
    expect(change.row).toBe(30);
    expect(change.colourBy).toBe("speed");
    expect(change.series).toBe("inliers");
    expect(change.compareWith).toBe(0);
  });

  it("calls those who follow what has changed, and no others", () => {
    const store = new Store(startState(report, "dark"));
    const calls: string[] = [];
    store.on(["row"], () => calls.push("row"));
    store.on(["tab", "run"], () => calls.push("tab"));
    store.set({ row: 3 });
    store.set({ row: 3 });
    store.set({ tab: "frame" });
    expect(calls).toEqual(["row", "tab"]);
  });
});

describe("small computations", () => {
  it("order edges by chi2", () => {
    const graph = decodeReport(sampleReport([], [sampleGraph(200)])).graphs[0];
    const [worst] = worstEdges(graph, 3, null);
    expect(graph.chi2[worst]).toBeCloseTo(412.5, 3);
    expect(label(graph.kind, worstEdges(graph, 3, "odometry")[0])).toBe("odometry");
  });

  it("measure distances from segments and round cells", () => {
    expect(toSegment(0, 1, [-1, 0], [1, 0])).toBe(1);
    expect(toSegment(3, 0, [-1, 0], [1, 0])).toBe(2);
    expect(cellSize(20)).toBe(2);
    expect(cellSize(0.5)).toBe(0.05);
  });

  it("draw less where pictures are slow, and more again where they are fast", () => {
    const quality = new Quality(false);
    expect(quality.level.points).toBe(Infinity);
    quality.begin();
    for (let now = 3000; now < 4000; now += 100) quality.note(now);
    expect(quality.level.points).toBe(3000);
    quality.begin();
    for (let now = 10000; now < 13000; now += 10) quality.note(now);
    expect(quality.level.points).toBe(Infinity);
  });
});
