// Reads vectors, poses and motions from arguments.

import { checkNames } from "./numbers.js";
import { described } from "./words.js";

/** Reads a vector, `[x, y, z]` or `{ x, y, z }`. */
export function vectorNumbers(value, what) {
  const numbers = new Float64Array(3);
  writeVector(value, numbers, 0, what);
  return numbers;
}

/** Writes a vector to `numbers` from index `at` on. Messages name it as `part` of `what`. */
function writeVector(value, numbers, at, what, part = "") {
  writeCoordinates(value, 3, numbers, at) || refuse(value, 3, what + part);
}

/** Writes a quaternion, `[x, y, z, w]` or `{ x, y, z, w }`, to `numbers`. */
function writeQuaternion(value, numbers, at, what, part = "") {
  writeCoordinates(value, 4, numbers, at) || refuse(value, 4, what + part);
  const isZero = numbers[at] === 0 && numbers[at + 1] === 0 && numbers[at + 2] === 0 && numbers[at + 3] === 0;
  if (isZero) throw new RangeError(`${what}${part}: a quaternion of length zero names no orientation`);
}

const COORDINATES = ["x", "y", "z", "w"];

/** Writes the coordinates of a value. Returns false if it does not have `count` coordinates that are finite numbers. */
function writeCoordinates(value, count, numbers, at) {
  if (typeof value !== "object" || value === null) return false;
  if (isList(value) ? value.length !== count : hasMore(value, count)) return false;
  for (let k = 0; k < count; k += 1) {
    const coordinate = coordinateOf(value, k);
    if (typeof coordinate !== "number" || !Number.isFinite(coordinate)) return false;
    numbers[at + k] = coordinate;
  }
  return true;
}

function isList(value) {
  return typeof value.length === "number";
}

function coordinateOf(value, k) {
  return isList(value) ? value[k] : value[COORDINATES[k]];
}

/**
 * Returns whether an object has more than `count` coordinates. Objects of a class, as in three.js, may have other
 * properties. They must not have an order of rotations: an object with one holds three angles, not a vector.
 */
function hasMore(value, count) {
  if (Object.getPrototypeOf(value) !== Object.prototype) return typeof value.order === "string" || (count < 4 && value.w !== undefined);
  for (const name in value) {
    const place = COORDINATES.indexOf(name);
    if (place < 0 || place >= count) return true;
  }
  return false;
}

/** Throws the error for a value that is not a vector or quaternion of finite numbers: a `RangeError` if a number is not finite, and otherwise a `TypeError`. */
function refuse(value, count, what) {
  const names = COORDINATES.slice(0, count).join(", ");
  const needed = `${what}: [${names}] or { ${names} } of finite numbers is needed, not`;
  if (typeof value !== "object" || value === null) throw new TypeError(`${needed} ${described(value)}`);
  const isWhole = isList(value) ? value.length === count : !hasMore(value, count);
  const parts = Array.from({ length: isList(value) ? Math.min(value.length, 5) : count }, (_, k) => coordinateOf(value, k));
  if (isWhole && parts.every((part) => typeof part === "number")) throw new RangeError(`${needed} [${parts}]`);
  throw new TypeError(`${needed} ${isList(value) ? `[${parts.map(described)}]` : described(value)}`);
}

/** The number of values of a pose: a position and a quaternion. */
export const POSE_LENGTH = 7;
/** The number of values of a motion: a pose, a velocity, an angular velocity and a center. */
export const MOTION_LENGTH = POSE_LENGTH + 9;

/** The parts of a motion and of a throw: for each, the function that writes it, and its index. */
const PARTS = {
  position: [writeVector, 0],
  rotation: [writeQuaternion, 3],
  velocity: [writeVector, 7],
  angularVelocity: [writeVector, 10],
  center: [writeVector, 13],
  acceleration: [writeVector, MOTION_LENGTH],
};
const THROW = Object.keys(PARTS);
const MOTION = THROW.slice(0, 5);
const POSE = THROW.slice(0, 2);

/** Writes a motion at constant velocities. Parts that are left out are 0, or no rotation. */
export function writeMotion(motion, what, numbers, at) {
  writeParts(motion, what, MOTION, numbers, at);
}

/** Writes the motion of a body that is static at the origin. */
export function writeRest(numbers, at) {
  numbers.fill(0, at, at + MOTION_LENGTH);
  numbers[at + 6] = 1;
}

function writeParts(value, what, known, numbers, at) {
  writeRest(numbers, at);
  checkNames(value, what, known);
  for (const name of known) {
    const part = value[name];
    if (part === undefined) continue;
    const [write, place] = PARTS[name];
    write(part, numbers, at + place, what, `.${name}`);
  }
}

export function motionNumbers(motion, what) {
  const numbers = new Float64Array(MOTION_LENGTH);
  writeMotion(motion, what, numbers, 0);
  return numbers;
}

/** Returns the numbers of a throw: those of a motion, then the acceleration. */
export function throwNumbers(motion, what) {
  const numbers = new Float64Array(MOTION_LENGTH + 3);
  writeParts(motion, what, THROW, numbers, 0);
  if (motion.acceleration === undefined) refuse(undefined, 3, `${what}.acceleration`);
  return numbers;
}

/** Returns the numbers of a pose, `{ position, rotation }`. */
export function poseNumbers(pose, what) {
  const numbers = new Float64Array(MOTION_LENGTH);
  writeParts(pose, what, POSE, numbers, 0);
  return numbers.subarray(0, POSE_LENGTH);
}

export const ORIGIN = new Float64Array(3);
/** The numbers of the identity pose. */
export const NO_OFFSET = poseNumbers({}, "");

export function poseOfNumbers(numbers) {
  const [px, py, pz, x, y, z, w] = numbers;
  return { position: [px, py, pz], rotation: [x, y, z, w] };
}
