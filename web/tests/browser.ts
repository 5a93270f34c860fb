import { existsSync } from "node:fs";
import { type Picture, decodePng, shrink } from "./png";
import { type Browser, type Page, chromium } from "playwright-core";

export const CHROMIUM = "/usr/bin/chromium";

/** Graphics in software on a machine that does other things too are slow. */
const PATIENCE_MS = 90000;

export function hasChromium(): boolean {
  return existsSync(CHROMIUM);
}

/** Chromium with graphics in software. */
export function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: CHROMIUM,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
}

/** Waits until an expression is true; unlike waitForFunction it works under the policy of the page. */
export async function until(page: Page, expression: string): Promise<void> {
  for (const end = Date.now() + PATIENCE_MS; Date.now() < end;) {
    if ((await page.evaluate(expression)) === true) return;
    await page.waitForTimeout(100);
  }
  throw new Error(`never true: ${expression}`);
}

/** The 3D picture without what lies over it, as a small picture of means. */
export async function smallScene(page: Page): Promise<Picture> {
  await page.evaluate(
    "for (const e of document.querySelectorAll('.layers, .legend, .tools, .tip')) e.style.visibility = 'hidden'",
  );
  await page.mouse.move(2, 2);
  await page.waitForTimeout(800); // until all is drawn
  return shrink(decodePng(await page.locator(".scene canvas").screenshot()), 64, 40);
}

export interface Watched {
  page: Page;
  /** Everything that the page wrote to the console, errors that nothing caught, and dialogs. */
  messages: string[];
}

export interface PageOptions {
  width?: number;
  height?: number;
  scheme?: "dark" | "light";
  touch?: boolean;
  /** A browser without WebGL. */
  flat?: boolean;
}

/** Opens a page and waits until its first picture is drawn. */
export async function open(browser: Browser, url: string, options: PageOptions = {}): Promise<Watched> {
  const page = await browser.newPage({
    viewport: { width: options.width ?? 1200, height: options.height ?? 760 },
    colorScheme: options.scheme ?? "dark",
    hasTouch: options.touch ?? false,
  });
  page.setDefaultTimeout(PATIENCE_MS);
  if (options.flat) {
    await page.addInitScript(`{
      const original = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind.startsWith("webgl") ? null : original.call(this, kind, ...rest);
      };
    }`);
  }
  const messages: string[] = [];
  page.on("console", (message) => messages.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => messages.push(`error: ${error.message}`));
  page.on("dialog", (dialog) => {
    messages.push(`dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  await page.goto(url);
  await page.waitForSelector("#page.report, #page.message");
  await page.waitForTimeout(700); // until the camera is still and thumbnails are decoded
  return { page, messages };
}
