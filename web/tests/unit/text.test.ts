import { describe, expect, it } from "vitest";
import {
  formatCount,
  formatDuration,
  formatNumber,
  formatPercent,
  formatTime,
  formatWithUnit,
  plural,
} from "../../src/data/format";
import { isPicture, svgUri } from "../../src/page/dom";
import { fileName } from "../../src/save/save";
import { escapeXml, graphSvg, ticks } from "../../src/save/graph_svg";
import { insertReport } from "../encode";

describe("numbers", () => {
  it("have significant digits and their unit", () => {
    expect(formatNumber(0.041234)).toBe("0.0412");
    expect(formatNumber(1234.56)).toBe("1235");
    expect(formatNumber(-0.5)).toBe("-0.5");
    expect(formatNumber(0)).toBe("0");
    expect(formatNumber(1.2e-7)).toBe("1.20e-7");
    expect(formatWithUnit(0.5, "m")).toBe("0.5 m");
    expect(formatWithUnit(NaN, "m")).toBe("unknown");
    expect(formatPercent(0.123)).toBe("12.3 %");
    expect(formatCount(1234567)).toBe("1\u2009234\u2009567");
    expect(plural(1, "frame")).toBe("1 frame");
    expect(plural(2, "frame")).toBe("2 frames");
  });
});

describe("times", () => {
  it("are minutes and seconds, with hours where there are any", () => {
    expect(formatTime(0)).toBe("0:00.0");
    expect(formatTime(59.96)).toBe("1:00.0");
    expect(formatTime(75.25)).toBe("1:15.3");
    expect(formatTime(3725)).toBe("1:02:05");
    expect(formatTime(-2)).toBe("-0:02.0");
    expect(formatTime(NaN)).toBe("unknown");
  });

  it("of a span are words", () => {
    expect(formatDuration(0.85)).toBe("850 ms");
    expect(formatDuration(12.34)).toBe("12.3 s");
    expect(formatDuration(250)).toBe("4 min 10 s");
    expect(formatDuration(7260)).toBe("2 h 1 min");
    expect(formatDuration(null)).toBe("unknown");
  });
});

describe("texts of a report", () => {
  it("cannot end the script element that holds them", () => {
    const page = insertReport("<body><!--placegraph-report--></body>", {
      title: "</script><img src=x onerror=alert(1)>",
    });
    expect(page).not.toContain("</script><img");
    expect(page.match(/<\/script>/g)).toHaveLength(1);
  });

  it("are escaped in pictures", () => {
    expect(escapeXml(`<a b="c">&'`)).toBe("&#60;a b=&#34;c&#34;&#62;&#38;&#39;");
    const svg = graphSvg("<script>", "x", "y", [0, 1], [{ name: "<b>", colour: '"red', values: [0, 1] }], [0, 1]);
    expect(svg).not.toMatch(/<script>|<b>|""red/);
  });

  it("become names of files that are safe everywhere", () => {
    expect(fileName("../a b/<c>.png")).toBe("a_b_c_.png");
    expect(fileName("...")).toBe("placegraph");
  });

  it("are thumbnails only if they are pictures in base64", () => {
    expect(isPicture("data:image/jpeg;base64,/9j/4AAQ")).toBe(true);
    expect(isPicture("data:image/svg+xml;base64,PHN2Zz4=")).toBe(false);
    expect(isPicture("https://example.org/a.jpg")).toBe(false);
    expect(isPicture('data:image/png;base64,AA" onerror="x')).toBe(false);
    expect(isPicture(undefined)).toBe(false);
    expect(svgUri("<svg># %</svg>")).toBe("data:image/svg+xml;charset=utf-8,%3Csvg%3E%23%20%25%3C%2Fsvg%3E");
  });
});

describe("the axis of a saved graph", () => {
  it("has round values", () => {
    expect(ticks(0, 1)).toEqual([0, 0.2, 0.4, 0.6, 0.8, 1]);
    expect(ticks(3, 47)).toEqual([10, 20, 30, 40]);
  });
});

describe("a saved graph", () => {
  const pathOf = (values: number[]): string[][] => {
    const xs = values.map((_, i) => i);
    const svg = graphSvg("", "x", "y", xs, [{ name: "", colour: "red", values }], [0, values.length]);
    const path = /<path d="([^"]*)" fill="none"/.exec(svg)?.[1] ?? "";
    return path.split("M").slice(1).map((line) => line.split("L"));
  };

  it("has every point of a short curve, with its gaps", () => {
    expect(pathOf([1, 2, NaN, 3, 4, 5]).map((line) => line.length)).toEqual([2, 3]);
  });

  it("does not grow with a curve, and keeps single values and gaps", () => {
    const values = Array.from({ length: 200_000 }, (_, i) => Math.sin(i));
    values[60_001] = 40;
    values.fill(NaN, 120_000, 130_000);
    const lines = pathOf(values);
    expect(lines.length).toBe(2);
    expect(lines.flat().length).toBeLessThan(2 * 1700);
    const heights = lines.flat().map((point) => Number(point.split(" ")[1]));
    expect(heights.filter((y) => y === Math.min(...heights)).length).toBe(1);
  });
});
