import {
  BufferAttribute,
  BufferGeometry,
  DoubleSide,
  Frustum,
  Group,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  type PerspectiveCamera,
  Texture,
  Vector3,
} from "three";
import { bytesFromBase64 } from "../data/column";
import type { RunData } from "../data/model";
import { frameRowOfKeyframe, isPosed } from "../data/run_view";
import { isPicture } from "../page/dom";
import { imageShape } from "./frusta_layer";
import { poseMatrix } from "./map_frame";

const SHOWN = 24;
const KEPT = 160;

/** Thumbnails in the frusta of the keyframes nearest to the camera, decoded when they are needed. */
export class ImagesLayer {
  readonly object: Group;
  private readonly quads: Mesh<BufferGeometry, MeshBasicMaterial>[] = [];
  private readonly textures = new Map<number, Texture>();
  private readonly keyframes: number[] = [];
  private readonly positions: Vector3[] = [];
  private disposed = false;
  private choice = 0;

  constructor(
    private readonly run: RunData,
    component: number | null,
    private readonly size: number,
    parent: Object3D,
    private readonly request: () => void,
  ) {
    this.object = new Group();
    const geometry = quad(run, size);
    for (let i = 0; i < SHOWN; i++) {
      const mesh = new Mesh(geometry, new MeshBasicMaterial({ side: DoubleSide }));
      mesh.matrixAutoUpdate = false;
      mesh.visible = false;
      this.quads.push(mesh);
      this.object.add(mesh);
    }
    for (let k = 0; k < run.keyframes.count; k++) {
      const row = frameRowOfKeyframe(run, k);
      if (row < 0 || !isPosed(run, row, component) || !isPicture(run.keyframes.thumbnails[k])) continue;
      this.keyframes.push(k);
      this.positions.push(new Vector3().fromArray(run.frames.pose, 7 * row).applyMatrix4(parent.matrixWorld));
    }
  }

  /** Chooses the keyframes to show; thumbnails smaller than a few pixels are left out. */
  async update(camera: PerspectiveCamera): Promise<void> {
    const choice = ++this.choice;
    const near = this.nearest(camera);
    const wanted = await Promise.all(near.map(async (k) => [k, await this.texture(k)] as const));
    if (this.disposed || choice !== this.choice) return;
    this.quads.forEach((mesh, i) => {
      const [k, texture] = wanted[i] ?? [0, null];
      mesh.visible = texture !== null;
      if (texture === null) return;
      if (mesh.material.map === null) mesh.material.needsUpdate = true;
      mesh.material.map = texture;
      poseMatrix(this.run.frames.pose, frameRowOfKeyframe(this.run, k), mesh.matrix);
      mesh.matrixWorldNeedsUpdate = true;
    });
    this.forget(new Set(near));
    this.request();
  }

  dispose(): void {
    this.disposed = true;
    for (const texture of this.textures.values()) release(texture);
    this.textures.clear();
  }

  private nearest(camera: PerspectiveCamera): number[] {
    camera.updateMatrixWorld();
    const view = new Frustum().setFromProjectionMatrix(
      new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse),
    );
    const farthest = this.size * 90;
    return this.positions
      .map((position, i) => ({ k: this.keyframes[i], position, distance: position.distanceTo(camera.position) }))
      .filter(({ position, distance }) => distance < farthest && view.containsPoint(position))
      .sort((a, b) => a.distance - b.distance)
      .slice(0, SHOWN)
      .map(({ k }) => k);
  }

  private async texture(k: number): Promise<Texture | null> {
    const known = this.textures.get(k);
    if (known) return known;
    const bitmap = await decodeThumbnail(this.run.keyframes.thumbnails[k]);
    if (bitmap === null || this.disposed) return null;
    const texture = new Texture(bitmap);
    texture.flipY = false;
    texture.needsUpdate = true;
    this.textures.set(k, texture);
    return texture;
  }

  private forget(needed: Set<number>): void {
    for (const [k, texture] of this.textures) {
      if (this.textures.size <= KEPT) return;
      if (needed.has(k)) continue;
      release(texture);
      this.textures.delete(k);
    }
  }
}

function release(texture: Texture): void {
  (texture.image as ImageBitmap).close();
  texture.dispose();
}

async function decodeThumbnail(uri: string): Promise<ImageBitmap | null> {
  const comma = uri.indexOf(",");
  try {
    const type = uri.slice(5, uri.indexOf(";"));
    return await createImageBitmap(new Blob([bytesFromBase64(uri.slice(comma + 1))], { type }));
  } catch {
    return null; // a damaged thumbnail is not shown
  }
}

/** The image rectangle of the camera at depth `size`. */
function quad(run: RunData, size: number): BufferGeometry {
  const { halfWidth: w, halfHeight: h, x, y } = imageShape(run);
  const corners = [x - w, y - h, 1, x + w, y - h, 1, x + w, y + h, 1, x - w, y + h, 1];
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.map((c) => c * size)), 3));
  geometry.setAttribute("uv", new BufferAttribute(new Float32Array([0, 0, 1, 0, 1, 1, 0, 1]), 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  return geometry;
}
