/** A saved map as `placegraph view` serves it. */
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { afterEach, describe, expect, it } from "vitest";
import type { Page } from "playwright-core";
import { until } from "../browser";
import { MockServer } from "../mock_server";
import { ViewSite } from "../mock_sites";
import { pages } from "./pages";

// The browser writes a line for each answer that is a refusal.
const { visit } = pages(/Failed to load resource.*(404|409)/);
const SHOTS = join(import.meta.dirname, "screenshots");
mkdirSync(SHOTS, { recursive: true });

let server: MockServer | null = null;
afterEach(async () => {
  await server?.close();
  server = null;
});

async function view(site = new ViewSite()): Promise<{ page: Page; site: ViewSite; messages: string[] }> {
  server = new MockServer(site);
  const { page, messages } = await visit(await server.listen(), { width: 1280, height: 800 });
  return { page, site, messages };
}

/** Moves the cursor from the first frame to frame `id`. */
async function goTo(page: Page, id: number): Promise<void> {
  await page.keyboard.press("Home");
  for (let i = 0; i < Math.floor(id / 10); i++) await page.keyboard.press("Shift+ArrowRight");
  for (let i = 0; i < id % 10; i++) await page.keyboard.press("ArrowRight");
}

async function selectLoop(page: Page, query: number): Promise<void> {
  await page.click("#tab-loops");
  await page.locator("tr[data-loop]", { has: page.locator(`td:first-child:text-is("${query}")`) }).click();
}

/** Whether the browser would ask before it leaves the page. */
function asks(page: Page): Promise<boolean> {
  return page.evaluate(`(() => {
    const event = new Event("beforeunload", { cancelable: true });
    window.dispatchEvent(event);
    return event.defaultPrevented;
  })()`);
}

describe("a served map", () => {
  it("opens under the policy of the program and shows full images with what the keyframe observes", async () => {
    const { page, messages } = await view();
    expect(await page.title()).toBe("town – placegraph 0.2.0");
    await page.click("#tab-frame");
    await page.locator(".frame-view[data-image='0']").waitFor();
    expect(await page.locator(".frame-view figcaption").textContent()).toContain("Frame 0, 480 × 270 pixels");
    await goTo(page, 13);
    await page.locator(".frame-view[data-image='13']").waitFor();
    expect(await page.locator(".frame-view figcaption").textContent()).toBe("Frame 13, 480 × 270 pixels");
    await page.screenshot({ path: join(SHOTS, "view.png") });
    expect(messages).toEqual([]);
  });

  it("marks the landmark of the point under the pointer in the scene", async () => {
    const { page } = await view();
    await page.click("#tab-frame");
    await page.locator(".frame-view[data-image='0']").waitFor();
    const before = await page.locator(".scene canvas").screenshot();
    const box = await page.locator(".frame-view canvas").boundingBox();
    if (!box) throw new Error("no image");
    // The first landmark is observed at (40, 60) of 480 x 270 pixels.
    await page.mouse.move(box.x + (40 / 480) * box.width, box.y + (60 / 270) * box.height);
    await page.waitForTimeout(600);
    expect((await page.locator(".scene canvas").screenshot()).equals(before)).toBe(false);
    await page.screenshot({ path: join(SHOTS, "observations.png") });
  });

  it("shows the thumbnail and says why where the recording is not there", async () => {
    const { page } = await view(new ViewSite(false));
    await page.click("#tab-frame");
    await page.getByText("The recording is not at /data/town any more.").waitFor();
    expect(await page.locator(".frame-view figcaption").textContent()).toBe("Keyframe 0, thumbnail");
  });
});

describe("the loops of a served map", () => {
  it("are refused, and the map is optimized again, with the shape before as a faint line", async () => {
    const { page } = await view();
    expect(await page.locator(".unsaved").isVisible()).toBe(false);
    await selectLoop(page, 40);
    await page.getByRole("button", { name: "Refuse this loop" }).click();
    await page.locator(".edit-list li", { hasText: "refused the loop of frames 40 and 11" }).waitFor();
    await page.getByText("The map is not optimized since the last edit.").waitFor();
    await page.getByRole("button", { name: "Accept this loop" }).waitFor();
    expect(await page.locator(".unsaved").isVisible()).toBe(true);
    expect(await page.locator("[data-layer=before]").count()).toBe(0);
    await page.getByRole("button", { name: "Optimize", exact: true }).click();
    await page.locator("[data-layer=before]").waitFor();
    await page.locator(".legend").getByText("before the last edit").waitFor();
    await page.screenshot({ path: join(SHOTS, "mended.png") });
    await page.getByRole("button", { name: "Undo" }).click();
    await until(page, "document.querySelectorAll('.edit-list li').length === 1");
  });

  it("are accepted after all", async () => {
    const { page } = await view();
    await selectLoop(page, 46);
    await page.getByRole("button", { name: "Accept this loop" }).click();
    await page.getByRole("button", { name: "Refuse this loop" }).waitFor();
    expect(await page.locator("tr[aria-current=true] td").nth(2).textContent()).toBe("accepted");
  });

  it("are added between two frames; why it cannot be done stands beside the button", async () => {
    const { page } = await view();
    await page.click("#tab-loops");
    await page.getByText("Mend the map").click();
    await goTo(page, 5);
    await page.getByRole("button", { name: "Pick frame 5" }).click();
    await goTo(page, 12);
    await page.getByRole("button", { name: "Add the loop 5 – 12" }).click();
    await page.locator(".edits [role=alert]", { hasText: "9 inliers of 20 needed" }).waitFor();
    await goTo(page, 34);
    await page.getByRole("button", { name: "Add the loop 5 – 34" }).click();
    await page.locator(".edit-list li", { hasText: "added the loop of frames 34 and 5" }).waitFor();
    expect(await page.locator("tr[aria-current=true] td").first().textContent()).toBe("34");
  });

  it("are saved under a new name, which must be a plain one", async () => {
    const { page, site } = await view();
    await selectLoop(page, 40);
    await page.getByRole("button", { name: "Refuse this loop" }).click();
    await page.locator(".edit-list li").waitFor();
    const name = page.getByRole("textbox", { name: "Name of the new map" });
    await name.pressSequentially("../evil");
    await page.getByText("A name has only letters, digits, - and _.").waitFor();
    expect(await page.getByRole("button", { name: "Save as a new map" }).isDisabled()).toBe(true);
    await name.fill("mended");
    await page.getByRole("button", { name: "Save as a new map" }).click();
    await page.getByText("Saved as /data/runs/town/mended.db.").waitFor();
    expect(site.saved).toEqual(["mended"]);
    expect(await page.locator(".unsaved").isVisible()).toBe(false);
  });

  it("are asked for before the page is left, only with edits that are not saved", async () => {
    const { page } = await view();
    await selectLoop(page, 40);
    await page.getByRole("button", { name: "Refuse this loop" }).click();
    await page.locator(".edit-list li").waitFor();
    expect(await asks(page)).toBe(true);
    await page.getByRole("button", { name: "Undo" }).click();
    await page.locator(".edit-list").waitFor({ state: "detached" });
    expect(await asks(page)).toBe(false);
  });
});
