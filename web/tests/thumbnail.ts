import { encodePng } from "./png";

export const WIDTH = 96;
export const HEIGHT = 54;

/** A street as the camera with heading `angle` at `position` sees it, as a PNG in a data URI. */
export function thumbnail(angle: number, position: number): string {
  return `data:image/png;base64,${street(angle, position, 1).toString("base64")}`;
}

/** The same as a PNG file, `scale` times as large. */
export function street(angle: number, position: number, scale: number): Buffer {
  const rgb = Buffer.alloc(3 * WIDTH * scale * HEIGHT * scale);
  for (let y = 0, at = 0; y < HEIGHT * scale; y++) {
    for (let x = 0; x < WIDTH * scale; x++, at += 3) {
      rgb.set(pixel(Math.floor(x / scale), Math.floor(y / scale), angle, position), at);
    }
  }
  return encodePng({ width: WIDTH * scale, height: HEIGHT * scale, rgb });
}

function pixel(x: number, y: number, angle: number, position: number): [number, number, number] {
  const bearing = angle + (x - WIDTH / 2) * 0.012;
  const wall = Math.floor((bearing * 40 + 1000) / 3);
  const roof = 14 + ((wall * 7919) % 9);
  const grain = ((x * 37 + y * 91 + Math.floor(position * 3)) * 2654435761) >>> 27;
  if (y < roof) return [120 + y, 160 + y, 215];
  if (y > 36) {
    const mark = Math.abs(x - WIDTH / 2) < (y - 36) * 0.15 && Math.floor(position + 60 / (y - 34)) % 2 === 0;
    return mark ? [225, 225, 215] : [72 + grain, 74 + grain, 78 + grain];
  }
  const window = (x + wall) % 7 > 3 && y % 8 > 4;
  const tone = (wall * 131) % 70;
  return window ? [40, 50, 66] : [120 + tone + grain / 2, 96 + tone + grain / 2, 78 + (tone + grain) / 2];
}
