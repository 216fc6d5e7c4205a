// Reads vectors, poses and motions from arguments.

import { checkNames } from "./numbers.js";
import { described } from "./words.js";

/** Reads a vector, `[x, y, z]` or `{ x, y, z }`. */
export function vectorNumbers(value, argumentName) {
  const numbers = new Float64Array(3);
  writeVector(value, numbers, 0, argumentName);
  return numbers;
}

/** Writes a vector to `numbers` from index `at` on. Messages name it by `argumentName` followed by `part`. */
function writeVector(value, numbers, at, argumentName, part = "") {
  writeCoordinates(value, 3, numbers, at) || throwVectorError(value, 3, argumentName + part);
}

/** Writes a quaternion, `[x, y, z, w]` or `{ x, y, z, w }`, to `numbers`. */
function writeQuaternion(value, numbers, at, argumentName, part = "") {
  writeCoordinates(value, 4, numbers, at) || throwVectorError(value, 4, argumentName + part);
  const isZero = numbers[at] === 0 && numbers[at + 1] === 0 && numbers[at + 2] === 0 && numbers[at + 3] === 0;
  if (isZero) throw new RangeError(`${argumentName}${part}: a quaternion of length zero is no rotation`);
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
 * properties, except for `order`: an object with an order of rotations is three angles, not a vector.
 */
function hasMore(value, count) {
  if (Object.getPrototypeOf(value) !== Object.prototype) return typeof value.order === "string" || (count < 4 && value.w !== undefined);
  for (const name in value) {
    const index = COORDINATES.indexOf(name);
    if (index < 0 || index >= count) return true;
  }
  return false;
}

/** Throws the error for an invalid vector or quaternion: a `RangeError` if only a number is not finite, and otherwise a `TypeError`. */
function throwVectorError(value, count, argumentName) {
  const names = COORDINATES.slice(0, count).join(", ");
  const needed = `${argumentName}: [${names}] or { ${names} } of finite numbers is needed, not`;
  if (typeof value !== "object" || value === null) throw new TypeError(`${needed} ${described(value)}`);
  const hasAllCoordinates = isList(value) ? value.length === count : !hasMore(value, count);
  const parts = Array.from({ length: isList(value) ? Math.min(value.length, 5) : count }, (_, k) => coordinateOf(value, k));
  if (hasAllCoordinates && parts.every((part) => typeof part === "number")) throw new RangeError(`${needed} [${parts}]`);
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
const THROW_PARTS = Object.keys(PARTS);
const MOTION_PARTS = THROW_PARTS.slice(0, 5);
const POSE_PARTS = THROW_PARTS.slice(0, 2);

/** Writes a motion at constant velocities. Missing parts are 0, and a missing rotation is the identity. */
export function writeMotion(motion, argumentName, numbers, at) {
  writeParts(motion, argumentName, MOTION_PARTS, numbers, at);
}

/** Writes the motion of a body that is static at the origin. */
export function writeRest(numbers, at) {
  numbers.fill(0, at, at + MOTION_LENGTH);
  numbers[at + 6] = 1;
}

function writeParts(value, argumentName, known, numbers, at) {
  writeRest(numbers, at);
  checkNames(value, argumentName, known);
  for (const name of known) {
    const part = value[name];
    if (part === undefined) continue;
    const [write, offset] = PARTS[name];
    write(part, numbers, at + offset, argumentName, `.${name}`);
  }
}

export function motionNumbers(motion, argumentName) {
  const numbers = new Float64Array(MOTION_LENGTH);
  writeMotion(motion, argumentName, numbers, 0);
  return numbers;
}

/** Returns the numbers of a throw: the numbers of a motion, then the acceleration. */
export function throwNumbers(motion, argumentName) {
  const numbers = new Float64Array(MOTION_LENGTH + 3);
  writeParts(motion, argumentName, THROW_PARTS, numbers, 0);
  if (motion.acceleration === undefined) throwVectorError(undefined, 3, `${argumentName}.acceleration`);
  return numbers;
}

/** Returns the numbers of a pose, `{ position, rotation }`. */
export function poseNumbers(pose, argumentName) {
  const numbers = new Float64Array(MOTION_LENGTH);
  writeParts(pose, argumentName, POSE_PARTS, numbers, 0);
  return numbers.subarray(0, POSE_LENGTH);
}

export const ORIGIN = new Float64Array(3);
/** The numbers of the identity pose. */
export const IDENTITY = poseNumbers({}, "");

export function poseOfNumbers(numbers) {
  const [px, py, pz, x, y, z, w] = numbers;
  return { position: [px, py, pz], rotation: [x, y, z, w] };
}
