import { describe, expect, it } from "vitest";
import { comparable, compareRuns, firstParting } from "../../src/data/compare";
import { decodeReport } from "../../src/data/decode";
import { certainty, filterLoops, isGood, sortLoops, stageCounts } from "../../src/data/loops";
import { startState } from "../../src/page/start_state";
import { availableSeries, series } from "../../src/data/series";
import { tracksOf } from "../../src/panels/tracks_overlay";
import { sampleReport, sampleRun } from "../sample";
import { sampleEstimate, sampleJudged } from "../sample_eval";

describe("evaluated trajectories", () => {
  const frames = 200;
  const report = decodeReport(
    sampleReport([
      sampleEstimate({ name: "a", frames }),
      sampleEstimate({ name: "b", frames, partsAt: 100 }),
      { ...sampleEstimate({ name: "c", frames }), recording: "elsewhere" },
    ]),
  );
  const [a, b, c] = report.runs;

  it("are compared in the frame of the ground truth, without another alignment", () => {
    expect(startState(report, "dark").alignOn).toBe("truth");
    const comparison = compareRuns(a, b, "truth");
    expect(comparison?.alignedOn).toBe(0);
    expect(comparison && firstParting(comparison, 1)).toBeGreaterThan(110);
  });

  it("are not compared with those of another recording", () => {
    expect(comparable(a, c)).toBe(false);
    expect(compareRuns(a, c, "whole")).toBeNull();
  });

  it("have no series of what is not known", () => {
    expect(availableSeries(a)).toEqual(["error", "rotation_error", "more:0", "speed", "time"]);
    expect(series(a, "more:0")).toMatchObject({ title: "Error along the path", unit: "m" });
    expect(series(a, "more:0").values).toEqual(series(a, "error").values);
  });

  it("have tables with as many cells as columns", () => {
    const table = { title: "t", protocol: "p", columns: ["a", "b"], rows: [["1"]] };
    expect(() => decodeReport({ ...sampleReport([]), tables: [table] })).toThrow("tables[0].rows[0] has 1 cells");
  });
});

describe("judged loops", () => {
  const report = decodeReport(sampleReport([sampleJudged()]));
  const { loops } = report.runs[0];

  it("are right, wrong or missed, all of them shown", () => {
    const state = startState(report, "dark");
    expect(state.tab).toBe("loops");
    expect(state.layers.refused).toBe(true);
    expect(stageCounts(loops).map(([name]) => name)).toEqual(["right", "wrong", "missed"]);
    expect(filterLoops(loops, state.loopFilter)).toEqual([0, 1, 2]);
    expect(["right", "wrong", "missed"].map(isGood)).toEqual([true, false, false]);
  });

  it("are filtered and sorted by their score where that is no probability", () => {
    expect(certainty(loops)).toBe("similarity");
    const stages = new Set(["right", "wrong", "missed"]);
    expect(filterLoops(loops, { stages, minProbability: 20 })).toEqual([0, 2]);
    expect(sortLoops(loops, [0, 1, 2], { column: "similarity", descending: false })).toEqual([1, 0, 2]);
    expect(sortLoops(loops, [0, 1, 2], { column: "rank", descending: true })).toEqual([1, 0, 2]);
  });
});

describe("tracks", () => {
  it("go back through the keyframes that saw the same landmark", () => {
    const run = decodeReport(sampleReport([sampleRun({ frames: 60, landmarks: 0, thumbnails: false })])).runs[0];
    const lengths = tracksOf(run, 5).map((track) => track.length);
    expect(lengths).toHaveLength(10);
    expect(new Set(lengths)).toEqual(new Set([1, 2, 3]));
    expect(tracksOf(run, -1)).toEqual([]);
  });
});
