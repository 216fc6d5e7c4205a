// Reads numbers, vectors, poses and settings that a caller passes.

import { described, quoted } from "./owned.js";

export function finiteNumber(value, what) {
  if (!Number.isFinite(number(value, what))) throw new RangeError(`${what}: a finite number is needed, not ${value}`);
  return value;
}

/** A limit may be infinite. */
export function numberOrInfinity(value, what) {
  if (Number.isNaN(number(value, what))) throw new RangeError(`${what}: a number is needed, not NaN`);
  return value;
}

/** The least and the greatest value of each setting, as the WebAssembly has them. */
const SETTINGS = {
  tolerance: [1e-100, 1e12],
  margin: [0, 1e12],
  clearance: [0, 1e12],
  duration: [0, Number.MAX_VALUE],
  budget: [0, Infinity],
  resolution: [1e-9, Number.MAX_VALUE],
  maxPoseError: [0, Number.MAX_VALUE],
};

export function settingNumber(value, name) {
  const [least, greatest] = SETTINGS[name];
  // Written so that NaN is refused.
  if (!(number(value, name) >= least && value <= greatest)) {
    const allowed = greatest >= Number.MAX_VALUE ? `at least ${least}` : `from ${least} to ${greatest}`;
    const finite = greatest === Number.MAX_VALUE ? " and finite" : "";
    throw new RangeError(`${name}: ${value} is not ${allowed}${finite}`);
  }
  if (name === "budget" && !Number.isInteger(value) && value !== Infinity) throw new RangeError(`budget: ${value} is no whole number`);
  return value;
}

/** Returns a name, which has to be a string. */
export function nameOf(value, what) {
  if (typeof value !== "string") throw new TypeError(`${what}: a string is needed, not ${described(value)}`);
  return value;
}

function number(value, what) {
  if (typeof value !== "number") throw new TypeError(`${what}: a number is needed, not ${described(value)}`);
  return value;
}

/** Writes a vector, `[x, y, z]` or `{ x, y, z }`, into numbers from a place on. `part` is what it is of `what`. */
export function writeVector(value, numbers, at, what, part = "") {
  writeCoordinates(value, 3, numbers, at) || refuse(value, "[x, y, z] or { x, y, z } of finite numbers", what, part);
}

/** Writes a quaternion, `[x, y, z, w]` or `{ x, y, z, w }`. */
export function writeQuaternion(value, numbers, at, what, part = "") {
  writeCoordinates(value, 4, numbers, at) || refuse(value, "[x, y, z, w] or { x, y, z, w } of finite numbers", what, part);
}

/** Returns whether all coordinates are finite numbers. */
function writeCoordinates(value, count, numbers, at) {
  if (typeof value !== "object" || value === null) return false;
  const isList = typeof value.length === "number";
  if (isList && value.length !== count) return false;
  let areNumbers = true;
  for (let k = 0; k < count; k += 1) {
    const coordinate = isList ? value[k] : value[COORDINATES[k]];
    areNumbers &&= typeof coordinate === "number" && Number.isFinite(coordinate);
    numbers[at + k] = coordinate;
  }
  return areNumbers;
}

function refuse(value, needed, what, part) {
  const given = typeof value?.length === "number" ? `[${Array.from(value).slice(0, 5)}]` : described(value);
  throw new TypeError(`${what}${part}: ${needed} is needed, not ${given}`);
}

const COORDINATES = ["x", "y", "z", "w"];

/** The number of numbers of a pose: a position and a quaternion. */
export const POSE_LENGTH = 7;
/** Those of a motion: a pose, a velocity, a spin and a center. */
export const MOTION_LENGTH = POSE_LENGTH + 9;

/** Writes a motion at constant velocities; what is left out is 0, and no rotation. */
export function writeMotion(motion, what, numbers, at) {
  numbers.fill(0, at, at + MOTION_LENGTH);
  numbers[at + 6] = 1;
  if (motion === undefined || motion === null) return;
  if (typeof motion !== "object") throw new TypeError(`${what}: a motion is needed, not ${described(motion)}`);
  for (const name in motion) {
    const value = motion[name];
    if (value === undefined) continue;
    if (name === "position") writeVector(value, numbers, at, what, ".position");
    else if (name === "rotation") writeQuaternion(value, numbers, at + 3, what, ".rotation");
    else if (name === "velocity") writeVector(value, numbers, at + 7, what, ".velocity");
    else if (name === "spin") writeVector(value, numbers, at + 10, what, ".spin");
    else if (name === "center") writeVector(value, numbers, at + 13, what, ".center");
    else throw unknownName(what, name, "position, rotation, velocity, spin, center");
  }
}

export function motionNumbers(motion, what) {
  const numbers = new Float64Array(MOTION_LENGTH);
  writeMotion(motion, what, numbers, 0);
  return numbers;
}

/** Returns the numbers of a pose, `{ position, rotation }`; without one they are those of no offset. */
export function poseNumbers(pose, what) {
  const numbers = motionNumbers(pose, what);
  if (pose?.velocity !== undefined || pose?.spin !== undefined || pose?.center !== undefined) throw new TypeError(`${what}: a pose has a position and a rotation`);
  return numbers.subarray(0, POSE_LENGTH);
}

export function poseOfNumbers(numbers) {
  const [px, py, pz, x, y, z, w] = numbers;
  return { position: [px, py, pz], rotation: [x, y, z, w] };
}

export function vectorNumbers(value, what) {
  const numbers = new Float64Array(3);
  if (value !== undefined) writeVector(value, numbers, 0, what);
  return numbers;
}

/** Returns a list of numbers as a Float64Array. */
export function listOfNumbers(value, what) {
  if (value instanceof Float64Array) return value;
  if (typeof value?.length !== "number" || typeof value === "string") throw new TypeError(`${what}: a list of numbers is needed, not ${described(value)}`);
  return Float64Array.from(value, (one, k) => numberOrInfinity(one, `${what}[${k}]`));
}

/** Refuses options that are not known, which are typing errors. */
export function checkNames(options, what, known) {
  if (options === undefined) return;
  if (typeof options !== "object" || options === null) throw new TypeError(`${what}: an object is needed, not ${described(options)}`);
  for (const name in options) {
    if (!known.includes(name)) throw unknownName(what, name, known.join(", "));
  }
}

/** What Rust and Python have, and this package has not. */
const NO_SETTINGS = { deadline: "a budget ends a question" };

export function unknownName(what, name, known) {
  return new TypeError(`${what}: there is no ${quoted(name)}; ${NO_SETTINGS[name] ?? `there are ${known}`}`);
}
