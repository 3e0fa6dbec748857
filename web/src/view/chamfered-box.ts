// Geometry of a block: a box with chamfered edges.

import { BufferAttribute, BufferGeometry, Vector3 } from 'three';

/** Width of the chamfer, m. */
const CHAMFER = 0.0009;

/**
 * Returns a centred box with chamfered edges. Faces and chamfers have flat normals, so that the
 * chamfers catch the light.
 */
export function chamferedBox(size: Vector3, chamfer = CHAMFER): BufferGeometry {
  const half = size.clone().multiplyScalar(0.5);
  /** Corner on the sides `s` that lies in the face of axis `inset`. */
  const corner = (s: number[], inset: number) =>
    new Vector3(...([0, 1, 2] as const).map(k => s[k] * (half.getComponent(k) - (k === inset ? 0 : chamfer))));
  const triangles: Vector3[][] = [];
  const polygon = (points: Vector3[]) => triangles.push(...triangulated(points));
  const signs = [-1, 1];
  for (let k = 0; k < 3; k++) {
    const [u, v] = [(k + 1) % 3, (k + 2) % 3];
    const at = (sk: number, su: number, sv: number) => {
      const s = [0, 0, 0];
      s[k] = sk;
      s[u] = su;
      s[v] = sv;
      return s;
    };
    for (const side of signs) {
      polygon([at(side, -1, -1), at(side, 1, -1), at(side, 1, 1), at(side, -1, 1)].map(s => corner(s, k)));
    }
    // The four edges along axis k.
    for (const su of signs) {
      for (const sv of signs) {
        const [a, b] = [at(-1, su, sv), at(1, su, sv)];
        polygon([corner(a, u), corner(b, u), corner(b, v), corner(a, v)]);
      }
    }
  }
  for (const x of signs)
    for (const y of signs) for (const z of signs) polygon([0, 1, 2].map(k => corner([x, y, z], k)));
  return geometryOf(triangles);
}

/** Splits a convex polygon into triangles that face away from the origin. */
function triangulated(points: Vector3[]): Vector3[][] {
  const outward = points.reduce((sum, p) => sum.add(p), new Vector3());
  const normal = points[1].clone().sub(points[0]).cross(points[2].clone().sub(points[0]));
  const ring = normal.dot(outward) < 0 ? [...points].reverse() : points;
  return ring.slice(2).map((point, i) => [ring[0], ring[i + 1], point]);
}

function geometryOf(triangles: Vector3[][]): BufferGeometry {
  const position = new Float32Array(triangles.length * 9);
  const normals = new Float32Array(triangles.length * 9);
  triangles.forEach(([a, b, c], t) => {
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    [a, b, c].forEach((p, i) => {
      p.toArray(position, t * 9 + i * 3);
      normal.toArray(normals, t * 9 + i * 3);
    });
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  return geometry;
}
