/**
 * Lines of some pixels' width, as two triangles a segment. Instanced geometry would be smaller, but
 * graphics in software draw each instance alone, which takes seconds for ten thousand segments.
 */
import { BufferAttribute, BufferGeometry, DoubleSide, Mesh, ShaderMaterial, Vector2 } from "three";

const VERTEX = `
attribute vec3 finish;
attribute vec2 corner; // which end (0 or 1) and which side (-1 or 1)
attribute vec3 tint;
uniform vec2 size;
uniform float width;
varying vec3 shade;
void main() {
  vec4 a = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(finish, 1.0);
  // An end behind the camera is moved to the near plane.
  float da = a.z + a.w;
  float db = b.z + b.w;
  if (da < 0.0 && db > 0.0) a = mix(a, b, da / (da - db));
  if (db < 0.0 && da > 0.0) b = mix(b, a, db / (db - da));
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  vec2 across = dot(along, along) > 1e-12 ? normalize(vec2(-along.y, along.x)) : vec2(0.0, 1.0);
  vec4 end = corner.x < 0.5 ? a : b;
  end.xy += across * corner.y * width / size * end.w;
  gl_Position = end;
  shade = tint;
}`;

const FRAGMENT = `
varying vec3 shade;
void main() { gl_FragColor = vec4(shade, 1.0); }`;

const CORNERS: [number, number][] = [
  [0, -1],
  [0, 1],
  [1, -1],
  [1, 1],
];

/** `positions` and `colours` have six values a segment: those of its two ends. */
export function wideLineMesh(positions: number[], colours: number[], width: number, order: number): Mesh {
  const segments = positions.length / 6;
  const start = new Float32Array(12 * segments);
  const finish = new Float32Array(12 * segments);
  const tint = new Float32Array(12 * segments);
  const corner = new Float32Array(8 * segments);
  const index = new Uint32Array(6 * segments);
  for (let s = 0; s < segments; s++) {
    CORNERS.forEach(([end, side], c) => {
      const vertex = 4 * s + c;
      for (let k = 0; k < 3; k++) {
        start[3 * vertex + k] = positions[6 * s + k];
        finish[3 * vertex + k] = positions[6 * s + 3 + k];
        tint[3 * vertex + k] = colours[6 * s + 3 * end + k];
      }
      corner.set([end, side], 2 * vertex);
    });
    index.set(
      [0, 1, 2, 2, 1, 3].map((c) => 4 * s + c),
      6 * s,
    );
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(start, 3));
  geometry.setAttribute("finish", new BufferAttribute(finish, 3));
  geometry.setAttribute("corner", new BufferAttribute(corner, 2));
  geometry.setAttribute("tint", new BufferAttribute(tint, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  return meshOf(geometry, width, order);
}

function meshOf(geometry: BufferGeometry, width: number, order: number): Mesh {
  const uniforms = { size: { value: new Vector2(1, 1) }, width: { value: width } };
  // The triangles have both windings, as segments point to either side.
  const material = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, side: DoubleSide });
  // Transparent materials are drawn last, in their order.
  material.depthTest = order === 0;
  material.transparent = order > 0;
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = order;
  mesh.onBeforeRender = (renderer) => {
    renderer.getDrawingBufferSize(uniforms.size.value);
    uniforms.width.value = Math.max(width * renderer.getPixelRatio(), 1);
    material.uniformsNeedUpdate = true;
  };
  return mesh;
}
