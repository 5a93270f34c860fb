import { BufferAttribute, BufferGeometry, DataTexture, Points, PointsMaterial } from "three";
import { type Rgb, cssColour } from "../data/colour_scale";

const SIZE = 32;

/** A white disc with smooth borders. */
function discTexture(): DataTexture {
  const bytes = new Uint8Array(4 * SIZE * SIZE).fill(255);
  for (let y = 0; y < SIZE; y++) {
    for (let x = 0; x < SIZE; x++) {
      const radius = Math.hypot(x - (SIZE - 1) / 2, y - (SIZE - 1) / 2);
      bytes[4 * (y * SIZE + x) + 3] = Math.max(0, Math.min(255, 255 * (SIZE / 2 - radius)));
    }
  }
  const texture = new DataTexture(bytes, SIZE, SIZE);
  texture.needsUpdate = true;
  return texture;
}

let shared: DataTexture | null = null;

/** Round points of `pixels` pixels. */
export function discs(
  positions: ArrayLike<number>,
  colour: Rgb,
  pixels: number,
): Points<BufferGeometry, PointsMaterial> {
  shared ??= discTexture();
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(positions), 3));
  const points = new Points(
    geometry,
    new PointsMaterial({
      color: cssColour(colour),
      map: shared,
      transparent: true,
      alphaTest: 0.3,
      sizeAttenuation: false,
      size: pixels * Math.min(window.devicePixelRatio, 2),
    }),
  );
  points.frustumCulled = false;
  return points;
}
