import { describe, expect, it } from "vitest";
import { decodeReport } from "../../src/data/decode";
import { geoJson, gpx, metresPerDegree, pointsOf } from "../../src/data/geodesy";
import { earthSvg, gridValues } from "../../src/panels/earth_svg";
import { streetSvg } from "../../src/panels/street_svg";
import { escapeXml } from "../../src/save/graph_svg";
import { column } from "../encode";
import { sampleReport, sampleRun } from "../sample";

const wire = sampleRun({ frames: 200, landmarks: 0, thumbnails: false, street: true, earth: true });
const run = decodeReport(sampleReport([wire])).runs[0];
const geo = run.georeference;
const street = run.streetMap;
if (geo === null || street === null) throw new Error("the sample has no street or no track");

describe("a track on the earth", () => {
  it("has the lengths of WGS84", () => {
    // Snyder 1987, table of lengths of a degree: 111.132 km and 55.8 km at 60 degrees.
    expect(metresPerDegree(0)[0] / 110574).toBeCloseTo(1, 4);
    expect(metresPerDegree(0)[1] / 111320).toBeCloseTo(1, 4);
    expect(metresPerDegree(60)[1] / 55800).toBeCloseTo(1, 4);
  });

  it("is interrupted where a frame has no position", () => {
    expect(pointsOf(geo)[0]).toBeNull();
    const interrupted = { ...geo, track: Float64Array.of(1, 2, 3, NaN, NaN, NaN, 4, 5, 6) };
    const json = JSON.parse(geoJson("drive", interrupted)) as { geometry: { coordinates: number[][][] } };
    expect(json.geometry.coordinates).toEqual([[[2, 1, 3]], [[5, 4, 6]]]);
    expect(gpx("drive", interrupted, escapeXml).match(/<trkseg>/g)).toHaveLength(2);
  });

  it("is saved with its name escaped", () => {
    expect(gpx("<b>&", geo, escapeXml)).toContain("<name>&#60;b&#62;&#38;</name>");
  });

  it("is drawn with a graticule, a scale bar and north", () => {
    const svg = earthSvg(geo);
    expect(svg).toContain("° N</text>");
    expect(svg).toContain("° E</text>");
    expect(svg).toMatch(/>[\d.]+ m<\/text>/);
    expect(svg).not.toContain("NaN");
    const lines = gridValues(8.4301, 8.4312);
    expect(lines.length).toBeGreaterThan(1);
    expect(lines.length).toBeLessThan(10);
    for (const value of lines) expect(value).toBeGreaterThanOrEqual(8.4301);
  });
});

describe("a street map", () => {
  it("is drawn with its classes, their areas and the path", () => {
    const svg = streetSvg(run, street);
    expect(svg).toContain("road, 900 m²");
    expect(svg).toContain("M");
    expect(svg).not.toContain("NaN");
    expect(svg).toContain("<image ");
  });

  it("shows no image that is none, and escapes names", () => {
    const classes = [{ name: "<b>", rgb: [1, 2, 3] as [number, number, number], area_m2: 1 }];
    const svg = streetSvg(run, { ...street, image: "javascript:alert(1)", classes });
    expect(svg).not.toContain("javascript");
    expect(svg).toContain("&#60;b&#62;");
  });

  it("has a point of the ground at every corner of its squares", () => {
    const wrong = wire.street_map && { ...wire.street_map, ground: column("f32", [1, 2, 3], 3) };
    expect(() => decodeReport(sampleReport([{ ...wire, street_map: wrong }]))).toThrow("street_map.ground has 1 rows");
  });
});
