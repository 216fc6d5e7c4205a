// Bodies from shapes, arrays and files.

import { checkNames, finiteNumber, vectorNumbers } from "./numbers.js";
import { Owned, described } from "./owned.js";
import { classes } from "./wasm.js";

export class Body extends Owned {
  /** @hideconstructor Bodies are made by `Body.sphere` and its like. */
  constructor(inner) {
    if (!(inner instanceof classes().Body)) throw new TypeError("a Body is made by Body.fromMesh, Body.sphere or the like");
    super(inner);
  }

  static fromMesh(positions, indices, options) {
    checkNames(options, "options of Body.fromMesh", ["pieces", "surface"]);
    if (!(positions instanceof Float64Array || positions instanceof Float32Array || Array.isArray(positions))) {
      throw new TypeError(`positions: a Float32Array, a Float64Array or an array of numbers is needed, not ${described(positions)}`);
    }
    if (positions.length % 3 !== 0) throw new TypeError(`positions: ${positions.length} numbers are no whole number of vertices`);
    const vertices = positions instanceof Float64Array ? positions : Float64Array.from(positions);
    const corners = indices === undefined || indices === null ? everyVertex(vertices.length / 3) : triangleCorners(indices);
    return new Body(classes().Body.from_mesh(vertices, corners, options?.pieces ?? "auto", options?.surface ?? false));
  }

  static fromFile(name, bytes, options) {
    checkNames(options, "options of Body.fromFile", ["scale", "pieces", "surface"]);
    const content = contentOf(name, bytes);
    const scale = finiteNumber(options?.scale ?? 1, "scale");
    if (scale <= 0) throw new RangeError(`scale: ${scale} is not positive`);
    return new Body(classes().Body.from_file(String(name), content, scale, options?.pieces ?? "auto", options?.surface ?? false));
  }

  static box(halfExtents) {
    const [x, y, z] = vectorNumbers(halfExtents, "halfExtents");
    return new Body(classes().Body.cuboid(x, y, z));
  }

  static sphere(radius) {
    return new Body(classes().Body.sphere(finiteNumber(radius, "radius")));
  }

  static capsule(radius, halfHeight) {
    return new Body(classes().Body.capsule(finiteNumber(radius, "radius"), finiteNumber(halfHeight, "halfHeight")));
  }

  static cylinder(radius, halfHeight, excess) {
    return solidOfRevolution("cylinder", radius, halfHeight, excess);
  }

  static cone(radius, halfHeight, excess) {
    return solidOfRevolution("cone", radius, halfHeight, excess);
  }

  get isSolid() {
    return Owned.inner(this).is_solid();
  }

  get pieces() {
    return Owned.inner(this).piece_count();
  }

  get report() {
    return Owned.inner(this).report();
  }

  get excess() {
    return Owned.inner(this).excess();
  }
}

/** Reads the triangles of a mesh file, to be drawn or changed before they become a body. */
export function readMesh(name, bytes) {
  const mesh = classes().Mesh.read(String(name), contentOf(name, bytes));
  const arrays = { positions: mesh.positions(), indices: mesh.indices() };
  mesh.free();
  return arrays;
}

function contentOf(name, bytes) {
  const content = bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes;
  if (content instanceof Uint8Array) return content;
  throw new TypeError(`${name}: bytes in a Uint8Array or an ArrayBuffer are needed, not ${described(bytes)}`);
}

function solidOfRevolution(name, radius, halfHeight, excess) {
  const allowed = excess === undefined ? undefined : finiteNumber(excess, "excess");
  return new Body(classes().Body[name](finiteNumber(radius, "radius"), finiteNumber(halfHeight, "halfHeight"), allowed));
}

/** The corners of the triangles of a mesh without indices. */
function everyVertex(count) {
  if (count % 3 !== 0) throw new TypeError(`positions: ${count} vertices without indices are no whole number of triangles`);
  return Uint32Array.from({ length: count }, (_, k) => k);
}

function triangleCorners(indices) {
  if (typeof indices.length !== "number" || typeof indices === "string") throw new TypeError(`indices: a list of numbers is needed, not ${described(indices)}`);
  if (indices.length % 3 !== 0) throw new TypeError(`indices: ${indices.length} numbers are no whole number of triangles`);
  if (indices instanceof Uint32Array) return indices;
  return Uint32Array.from(indices, (index, k) => {
    if (!Number.isInteger(index) || index < 0 || index > 0xffffffff) throw new TypeError(`indices[${k}]: ${described(index)} is no number of a vertex`);
    return index;
  });
}
