import { describe, expect, it } from "vitest";
import { decodeReport } from "../../src/data/decode";
import { STAGES, filterLoops, loopsAt, sortLoops, stageCounts, stageOf, stageSentence } from "../../src/data/loops";
import type { LoopTable } from "../../src/data/model";
import { column, labels } from "../encode";
import { sampleReport, sampleRun } from "../sample";

function table(): LoopTable {
  const run = sampleRun({ frames: 60, landmarks: 0, thumbnails: false });
  const loops = {
    query_frame: column("i32", [50, 40, 45]),
    match_frame: column("i32", [5, 50, 2]),
    probability: column("f32", [0.25, NaN, 0.75]),
    similarity: column("f32", [0.1, 0.2, 0.3]),
    inliers: column("i32", [7, 7, 3]),
    lines: column("i32", [0, 0, 0]),
    stage: labels(["geometry", "accepted", "retrieval"]),
    reason: null,
    rank: null,
    judged: false,
  };
  return decodeReport(sampleReport([{ ...run, loops }])).runs[0].loops;
}

describe("loops", () => {
  const loops = table();

  it("are filtered by stage and by probability", () => {
    expect(filterLoops(loops, { stages: new Set(STAGES), minProbability: 0 })).toEqual([0, 1, 2]);
    expect(filterLoops(loops, { stages: new Set(["accepted"]), minProbability: 0 })).toEqual([1]);
    expect(filterLoops(loops, { stages: new Set(STAGES), minProbability: 0.5 })).toEqual([2]);
  });

  it("are sorted, unknown values last in both directions, equal ones in their order", () => {
    expect(sortLoops(loops, [0, 1, 2], { column: "probability", descending: true })).toEqual([2, 0, 1]);
    expect(sortLoops(loops, [0, 1, 2], { column: "probability", descending: false })).toEqual([0, 2, 1]);
    expect(sortLoops(loops, [0, 1, 2], { column: "inliers", descending: true })).toEqual([0, 1, 2]);
    expect(sortLoops(loops, [0, 1, 2], { column: "stage", descending: false })).toEqual([2, 0, 1]);
  });

  it("are counted by stage in the order of the tests", () => {
    expect(stageCounts(loops)).toEqual([
      ["retrieval", 1],
      ["geometry", 1],
      ["accepted", 1],
    ]);
    expect(stageOf(loops, 1)).toBe("accepted");
  });

  it("of a frame are those that start or end there, accepted ones first", () => {
    expect(loopsAt(loops, 50)).toEqual([1, 0]);
    expect(loopsAt(loops, 3)).toEqual([]);
  });

  it("have a sentence for each stage and one for unknown stages", () => {
    for (const stage of STAGES) expect(stageSentence(stage)).toMatch(/^(Refused|Accepted): .*\.$/);
    expect(stageSentence("<b>")).toBe('Decided by the test "<b>".');
  });
});
