import type { RunData } from "../data/model";
import type { Picture } from "../data/report";
import { button, el, svgUri } from "../page/dom";
import { saveSvgAsPng, saveText } from "../save/save";
import { earthSvg } from "./earth_svg";
import type { Panel, PanelContext } from "./panel";
import { planSvg } from "./plan_svg";
import { streetSvg } from "./street_svg";

const PNG_WIDTH = 1600;

export function picturesPanel({ report, store }: PanelContext): Panel {
  const of = (run: RunData | undefined): Picture[] => [
    ...(run ? [...run.pictures, ...plansOf(run)] : []),
    ...report.pictures,
  ];
  return {
    title: "Pictures",
    available: report.pictures.length > 0 || report.runs.some((run) => of(run).length > 0),
    keys: ["run"],
    render: () => {
      const pictures = of(report.runs[store.state.run]);
      if (pictures.length === 0) return el("p", {}, "This run has no pictures.");
      return el("div", {}, ...pictures.map(pictureElement));
    },
  };
}

function plansOf(run: RunData): Picture[] {
  const pictures: Picture[] = [];
  if (run.floorPlan.length > 0)
    pictures.push({ title: "Floor plan", caption: "Walls, in the frame of the plan.", svg: planSvg(run.floorPlan) });
  if (run.streetMap !== null)
    pictures.push({
      title: "Street map",
      caption: "Classes of the street from above and the path of the camera.",
      svg: streetSvg(run, run.streetMap),
    });
  if (run.georeference !== null)
    pictures.push({
      title: "Track on the earth",
      caption: "North is up; latitude and longitude by the georeference.",
      svg: earthSvg(run.georeference),
    });
  return pictures;
}

/** The picture is an image, so that scripts in it cannot run. */
function pictureElement(picture: Picture): HTMLElement {
  const uri = svgUri(picture.svg);
  const image = el("img", { src: uri, alt: picture.title });
  const fault = el("p", { class: "soft" });
  image.addEventListener("error", () => (fault.textContent = "This picture is no valid SVG, so it cannot be shown."));
  const savePng = (): void => {
    saveSvgAsPng(uri, PNG_WIDTH, `${picture.title}.png`).catch(
      () => (fault.textContent = "This picture cannot be saved as PNG."),
    );
  };
  return el(
    "figure",
    { class: "picture" },
    el("h3", {}, picture.title),
    image,
    fault,
    el("figcaption", {}, picture.caption),
    el(
      "div",
      { class: "row" },
      button("SVG", `Save "${picture.title}" as SVG`, () =>
        saveText(picture.svg, "image/svg+xml", `${picture.title}.svg`),
      ),
      button("PNG", `Save "${picture.title}" as PNG`, savePng),
    ),
  );
}
