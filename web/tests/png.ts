/** PNG files of 8 bits a channel without interlace. */
import { deflateSync, inflateSync } from "node:zlib";

export interface Picture {
  width: number;
  height: number;
  /** Three bytes a pixel. */
  rgb: Buffer;
}

const SIGNATURE = Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]);

export function encodePng({ width, height, rgb }: Picture): Buffer {
  return encodePixels(width, height, rgb);
}

/** `pixels` are red, green, blue and, if there are four bytes a pixel, opacity. */
export function encodePixels(width: number, height: number, pixels: Uint8Array): Buffer {
  const stride = pixels.length / height;
  const raw = Buffer.alloc((stride + 1) * height);
  for (let y = 0; y < height; y++) raw.set(pixels.subarray(y * stride, (y + 1) * stride), y * (stride + 1) + 1);
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, stride === 4 * width ? 6 : 2, 0, 0, 0], 8);
  return Buffer.concat([
    SIGNATURE,
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(raw, { level: 1 })),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** Colour with or without alpha, which is left out. */
export function decodePng(file: Buffer): Picture {
  const parts: Buffer[] = [];
  const width = file.readUInt32BE(16);
  const height = file.readUInt32BE(20);
  const channels = { 2: 3, 6: 4 }[file[25]];
  if (file[24] !== 8 || channels === undefined || file[28] !== 0) throw new Error("no PNG of 8-bit colour");
  for (let at = 8; at < file.length;) {
    const length = file.readUInt32BE(at);
    if (file.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(file.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = width * channels;
  const rows = Buffer.alloc(stride * height);
  const rgb = Buffer.alloc(3 * width * height);
  for (let y = 0; y < height; y++) {
    unfilter(raw, y * (stride + 1), rows, y * stride, stride, channels);
    for (let x = 0; x < width; x++)
      rows.copy(rgb, 3 * (y * width + x), y * stride + x * channels, y * stride + x * channels + 3);
  }
  return { width, height, rgb };
}

/** Undoes the filter of one row (PNG, section 9). */
function unfilter(raw: Buffer, from: number, rows: Buffer, to: number, stride: number, channels: number): void {
  for (let i = 0; i < stride; i++) {
    const left = i >= channels ? rows[to + i - channels] : 0;
    const up = to >= stride ? rows[to + i - stride] : 0;
    const corner = i >= channels && to >= stride ? rows[to + i - stride - channels] : 0;
    const guess = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][raw[from]];
    rows[to + i] = raw[from + 1 + i] + guess;
  }
}

function paeth(a: number, b: number, c: number): number {
  const [pa, pb, pc] = [Math.abs(b - c), Math.abs(a - c), Math.abs(a + b - 2 * c)];
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/** Means over cells: a small picture that other fonts or a pixel more or less do not change much. */
export function shrink({ width, height, rgb }: Picture, columns: number, rows: number): Picture {
  const sums = new Float64Array(3 * columns * rows);
  const counts = new Float64Array(columns * rows);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const cell = Math.floor((y * rows) / height) * columns + Math.floor((x * columns) / width);
      counts[cell]++;
      for (let k = 0; k < 3; k++) sums[3 * cell + k] += rgb[3 * (y * width + x) + k];
    }
  }
  return {
    width: columns,
    height: rows,
    rgb: Buffer.from(sums.map((sum, i) => Math.round(sum / counts[Math.floor(i / 3)]))),
  };
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
