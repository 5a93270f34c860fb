import { deflateSync } from "node:zlib";

const WIDTH = 96;
const HEIGHT = 54;

/** A street as the camera with heading `angle` at `position` sees it, as a PNG in a data URI. */
export function thumbnail(angle: number, position: number): string {
  const pixels = new Uint8Array(3 * WIDTH * HEIGHT);
  for (let y = 0; y < HEIGHT; y++)
    for (let x = 0; x < WIDTH; x++) pixels.set(pixel(x, y, angle, position), 3 * (y * WIDTH + x));
  return png(WIDTH, HEIGHT, pixels);
}

/** A PNG in a data URI; `pixels` are red, green, blue and, if there are four a pixel, opacity. */
export function png(width: number, height: number, pixels: Uint8Array): string {
  const channels = pixels.length / (width * height);
  const raw = Buffer.alloc((width * channels + 1) * height);
  for (let y = 0; y < height; y++)
    raw.set(pixels.subarray(y * width * channels, (y + 1) * width * channels), y * (width * channels + 1) + 1);
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, channels === 4 ? 6 : 2, 0, 0, 0], 8);
  const signature = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);
  const file = Buffer.concat([
    signature,
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(raw, { level: 1 })),
    chunk("IEND", Buffer.alloc(0)),
  ]);
  return `data:image/png;base64,${file.toString("base64")}`;
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

function chunk(type: string, data: Buffer): Buffer {
  const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
  const length = Buffer.alloc(4);
  length.writeUInt32BE(data.length);
  const check = Buffer.alloc(4);
  check.writeUInt32BE(crc32(body));
  return Buffer.concat([length, body, check]);
}

const CRC = Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

function crc32(bytes: Buffer): number {
  let c = 0xffffffff;
  for (const byte of bytes) c = CRC[(c ^ byte) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}
