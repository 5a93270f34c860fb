import { describe, expect, it } from "vitest";
import { type PosePair, align, apply } from "../../src/data/align";
import { beginningCount, compareRuns, defaultThreshold, firstParting } from "../../src/data/compare";
import { decodeReport } from "../../src/data/decode";
import type { RunData } from "../../src/data/model";
import { type Quat, type Vec3, multiply, rotate } from "../../src/data/quaternion";
import { Random } from "../random";
import { sampleReport, sampleRun, type SampleOptions } from "../sample";

function runOf(options: Partial<SampleOptions>): RunData {
  return decodeReport(
    sampleReport([sampleRun({ frames: 400, landmarks: 0, thumbnails: false, loops: false, ...options })]),
  ).runs[0];
}

function unit(q: Quat): Quat {
  const length = Math.hypot(...q);
  return [q[0] / length, q[1] / length, q[2] / length, q[3] / length];
}

const MOTION = { rotation: unit([0.3, -0.2, 0.5, 0.7]), translation: [4, -2, 9] as Vec3, scale: 1 };

function pairs(points: Vec3[], scale: number): PosePair[] {
  return points.map((position) => {
    const rotation: Quat = [0, 0, 0, 1];
    return {
      from: { position, rotation },
      to: { position: apply({ ...MOTION, scale }, position), rotation: multiply(MOTION.rotation, rotation) },
    };
  });
}

function expectNear(a: readonly number[], b: readonly number[]): void {
  a.forEach((value, i) => expect(value).toBeCloseTo(b[i], 6));
}

describe("the alignment", () => {
  const random = new Random(5);
  const cloud = Array.from({ length: 40 }, (): Vec3 => [random.normal(3), random.normal(3), random.normal(3)]);

  it("finds a rigid motion", () => {
    const found = align(pairs(cloud, 1), false);
    expectNear(found?.translation ?? [], MOTION.translation);
    expectNear(rotate(found?.rotation ?? [0, 0, 0, 1], [1, 2, 3]), rotate(MOTION.rotation, [1, 2, 3]));
    expect(found?.scale).toBe(1);
  });

  it("finds a similarity", () => {
    const found = align(pairs(cloud, 2.5), true);
    expect(found?.scale).toBeCloseTo(2.5, 6);
    expectNear(apply(found ?? MOTION, cloud[0]), apply({ ...MOTION, scale: 2.5 }, cloud[0]));
  });

  it("of a straight path has the rotation about it from the orientations", () => {
    const found = align(
      pairs(
        Array.from({ length: 20 }, (_, i): Vec3 => [i, 0, 0]),
        1,
      ),
      false,
    );
    expectNear(rotate(found?.rotation ?? [0, 0, 0, 1], [0, 0, 1]), rotate(MOTION.rotation, [0, 0, 1]));
  });

  it("of nothing is nothing", () => {
    expect(align([], false)).toBeNull();
  });
});

describe("the comparison of two runs", () => {
  const straight = runOf({ partsAt: 10000 });

  it("finds the first frame where they part by more than a threshold", () => {
    // The other run bends away by 4 cm a frame from frame 200 on: 0.52 m apart after 13 frames.
    const comparison = compareRuns(straight, runOf({ partsAt: 200 }), "beginning");
    expect(comparison?.alignedOn).toBe(40);
    expect(comparison && firstParting(comparison, 0.5)).toBe(212);
    expect(comparison && firstParting(comparison, 1e6)).toBeNull();
  });

  it("is at rest where they are equal", () => {
    const comparison = compareRuns(straight, runOf({ partsAt: 10000, seed: 9 }), "whole");
    expect(comparison?.alignedOn).toBe(400);
    expect(Math.max(...(comparison?.distance ?? [1]))).toBeLessThan(1e-3);
  });

  it("leaves out lost frames and frames of other components", () => {
    const comparison = compareRuns(straight, runOf({ partsAt: 10000, lost: [[100, 119]], components: 2 }), "whole");
    expect(comparison?.ids.length).toBe(100);
    expect(comparison?.ids.at(-1)).toBe(99);
  });

  it("fits the scale where a run is not metric", () => {
    expect(compareRuns(straight, runOf({ metric: false }), "whole")?.withScale).toBe(true);
    expect(compareRuns(straight, runOf({}), "whole")?.withScale).toBe(false);
  });

  it("of runs without common frames is nothing", () => {
    expect(compareRuns(straight, runOf({ lost: [[0, 399]] }), "whole")).toBeNull();
  });

  it("has a round threshold and a beginning of a tenth", () => {
    expect(defaultThreshold(309)).toBe(1);
    expect(defaultThreshold(50)).toBe(0.2);
    expect(beginningCount(4)).toBe(4);
    expect(beginningCount(50)).toBe(10);
    expect(beginningCount(1000)).toBe(100);
  });
});
