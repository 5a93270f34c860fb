import { describe, expect, it } from "vitest";
import { SCALES, UNKNOWN_COLOUR, categoryColour, robustRange, scaleColour, shareOf } from "../../src/data/colour_scale";

const luminance = ([r, g, b]: number[]): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;

describe("a colour scale", () => {
  it("begins and ends with the colours of its table and clamps beyond", () => {
    expect(scaleColour("viridis", 0)).toEqual(SCALES.viridis[0]);
    expect(scaleColour("viridis", 1)).toEqual(SCALES.viridis.at(-1));
    expect(scaleColour("viridis", -3)).toEqual(scaleColour("viridis", 0));
    expect(scaleColour("viridis", 7)).toEqual(scaleColour("viridis", 1));
  });

  it("grows brighter all along, so that it can be read without hue", () => {
    for (const name of ["viridis", "cividis"] as const) {
      for (let i = 0; i < 50; i++) {
        expect(luminance(scaleColour(name, (i + 1) / 50))).toBeGreaterThan(luminance(scaleColour(name, i / 50)));
      }
    }
  });

  it("shows unknown values in grey", () => {
    expect(scaleColour("viridis", NaN)).toEqual(UNKNOWN_COLOUR);
    expect(categoryColour(-1)).toEqual(UNKNOWN_COLOUR);
    expect(categoryColour(7)).toEqual(categoryColour(0));
  });
});

describe("a range", () => {
  it("leaves out the largest values and those that are unknown", () => {
    const values = [NaN, ...Array.from({ length: 101 }, (_, i) => i)];
    values[101] = 1e9;
    expect(robustRange(values)).toEqual([0, 98]);
  });

  it("of one value, or of none, has a length", () => {
    expect(robustRange([])).toEqual([0, 1]);
    const [low, high] = robustRange([5, 5]);
    expect(high).toBeGreaterThan(low);
  });

  it("gives shares on linear and on logarithmic scales", () => {
    expect(shareOf(3, [1, 5])).toBe(0.5);
    expect(shareOf(10, [1, 100], true)).toBeCloseTo(0.5);
    expect(shareOf(0, [1, 100], true)).toBe(0);
  });
});
