import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  Texture,
} from "three";
import type { StreetShape } from "../data/model";
import { isPicture } from "../page/dom";

/** The street from above, laid on the ground below it; `onLoad` is called when its image is there. */
export function streetMesh(street: StreetShape, onLoad: () => void): Mesh {
  const { columns, rows, ground } = street;
  const uv = new Float32Array(2 * (columns + 1) * (rows + 1));
  for (let row = 0, i = 0; row <= rows; row++)
    for (let column = 0; column <= columns; column++, i += 2) uv.set([column / columns, row / rows], i);
  const geometry = new BufferGeometry();
  // Points that no triangle uses: not a number would spoil the bounds of the mesh.
  const positions = Float32Array.from(ground, (value) => (Number.isFinite(value) ? value : 0));
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("uv", new BufferAttribute(uv, 2));
  geometry.setIndex(triangles(street));
  const texture = new Texture();
  texture.flipY = false;
  texture.magFilter = NearestFilter;
  // Unknown pixels are left out, and what lies on the ground is drawn over it.
  const material = new MeshBasicMaterial({ map: texture, alphaTest: 0.5, side: DoubleSide });
  material.polygonOffset = true;
  material.polygonOffsetFactor = 1;
  material.polygonOffsetUnits = 4;
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false; // its bounds contain those points
  if (isPicture(street.image)) {
    const image = new Image();
    image.addEventListener("load", () => {
      texture.image = image;
      texture.needsUpdate = true;
      onLoad();
    });
    image.src = street.image;
  }
  return mesh;
}

/** Two triangles for each square whose corners are known. */
function triangles({ columns, rows, ground }: StreetShape): number[] {
  const index: number[] = [];
  const known = (i: number): boolean => Number.isFinite(ground[3 * i]);
  for (let row = 0; row < rows; row++)
    for (let column = 0; column < columns; column++) {
      const a = row * (columns + 1) + column;
      const c = a + columns + 1;
      if (known(a) && known(a + 1) && known(c) && known(c + 1)) index.push(a, a + 1, c, c, a + 1, c + 1);
    }
  return index;
}
