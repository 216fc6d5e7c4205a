// Bodies from shapes, arrays and files.

import { bytesOf, choiceOf, finiteNumber, lengthOf, listOfNumbers, nameOf, optionsOf, trueOrFalse, typedArrayName } from "./numbers.js";
import { innerOf, Owned } from "./owned.js";
import { vectorNumbers } from "./places.js";
import { classes } from "./wasm.js";
import { described } from "./words.js";

const MESH_OPTIONS = { pieces: [choiceOf(["auto", "triangles", "patches", "hull", "outer-hull"]), "auto"], surface: [trueOrFalse, false] };
const FILE_OPTIONS = { scale: [positiveNumber, 1], unit: [choiceOf(["um", "mm", "cm", "m", "in", "ft"]), undefined] };

export class Body extends Owned {
  get [Symbol.toStringTag]() {
    return "Body";
  }

  /** @hideconstructor `Body.sphere` and the other static functions make bodies. */
  constructor(inner) {
    if (!(inner instanceof classes().Body)) throw new TypeError("a Body is made by Body.fromMesh, Body.sphere or the like");
    super(inner);
  }

  static fromMesh(positions, indices, options) {
    const { pieces, surface } = optionsOf(options, "Body.fromMesh", MESH_OPTIONS);
    const vertices = coordinatesOf(positions);
    const corners = indices === undefined || indices === null ? everyVertex(vertices.length / 3) : triangleCorners(indices);
    return new Body(classes().Body.from_mesh(vertices, corners, pieces, surface));
  }

  static fromFile(name, bytes, options) {
    const { pieces, surface, ...file } = optionsOf(options, "Body.fromFile", { ...FILE_OPTIONS, ...MESH_OPTIONS });
    return withMesh(name, bytes, file, (mesh) => new Body(classes().Body.from_read_mesh(mesh, pieces, surface)));
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

  get pieceCount() {
    return Owned.inner(this).piece_count();
  }

  get report() {
    return Owned.inner(this).report();
  }

  get excess() {
    return Owned.inner(this).excess();
  }
}

/** Reads the triangles of a mesh file, to draw them, or to change them before making a body. */
export function readMesh(name, bytes, options) {
  const file = optionsOf(options, "readMesh", FILE_OPTIONS);
  return withMesh(name, bytes, file, (mesh) => ({ positions: mesh.positions(), indices: mesh.indices(), unit: mesh.unit() ?? null }));
}

/** Reads the mesh in a file, calls a function with it, and returns the result. */
function withMesh(name, bytes, { scale, unit }, call) {
  const mesh = classes().Mesh.read(nameOf(name, "name"), bytesOf(bytes, name), scale, unit);
  try {
    return call(mesh);
  } finally {
    mesh.free();
  }
}

/** Checks that an argument is a body, and returns its object in the WebAssembly. */
export function bodyOf(value, argumentName) {
  return innerOf(value, Body, argumentName);
}

function positiveNumber(value, argumentName) {
  if (finiteNumber(value, argumentName) <= 0) throw new RangeError(`${argumentName}: ${value} is not positive`);
  return value;
}

function solidOfRevolution(name, radius, halfHeight, excess) {
  const excessOrDefault = excess === undefined ? undefined : finiteNumber(excess, "excess");
  return new Body(classes().Body[name](finiteNumber(radius, "radius"), finiteNumber(halfHeight, "halfHeight"), excessOrDefault));
}

function coordinatesOf(positions) {
  if (!Array.isArray(positions) && !["Float32Array", "Float64Array"].includes(typedArrayName(positions))) {
    throw new TypeError(`positions: a Float32Array, a Float64Array or an array of numbers is needed, not ${described(positions)}`);
  }
  const numbers = listOfNumbers(positions, "positions");
  if (numbers.length % 3 !== 0) throw new TypeError(`positions: ${numbers.length} numbers are not three for each vertex`);
  return numbers;
}

/** Returns the indices of a mesh without indices: every three vertices are a triangle. */
function everyVertex(count) {
  if (count % 3 !== 0) throw new TypeError(`positions: ${count} vertices without indices are not three for each triangle`);
  return Uint32Array.from({ length: count }, (_, k) => k);
}

function triangleCorners(indices) {
  const length = lengthOf(indices, "indices", "a list of numbers");
  if (length % 3 !== 0) throw new TypeError(`indices: ${length} numbers are not three for each triangle`);
  if (indices instanceof Uint32Array) return indices;
  const corners = [];
  for (let k = 0; k < length; k += 1) {
    const index = indices[k];
    if (!Number.isInteger(index) || index < 0 || index > 0xffffffff) throw new TypeError(`indices[${k}]: ${described(index)} is no index of a vertex`);
    corners.push(index);
  }
  return Uint32Array.from(corners);
}
