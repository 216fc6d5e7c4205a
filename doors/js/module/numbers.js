// Reads arguments of callers. Nothing is converted: a wrong value is an error that names the argument.
//
// A reader takes a value and its name in messages. Classes list their arguments as fields: for each name a reader and
// a default value. A field without a default is required.

import { described, quoted } from "./words.js";

// --- Objects with fields, and lists

/** Reads the fields of an object, each with its reader. */
export function fieldsOf(value, what, fields, prefix = "") {
  checkNames(value, what, Object.keys(fields));
  const read = {};
  for (const [name, [reader, ...otherwise]] of Object.entries(fields)) {
    const given = value[name];
    read[name] = given === undefined && otherwise.length > 0 ? otherwise[0] : reader(given, prefix + name);
  }
  return read;
}

/** Reads options. The whole object may be left out. */
export function optionsOf(options, owner, fields) {
  return fieldsOf(options === undefined ? {} : options, `options of ${owner}`, fields);
}

/** Refuses a value that is not an object with fields, and unknown fields, which are typing errors. */
export function checkNames(value, what, known) {
  if (typeof value !== "object" || value === null) throw new TypeError(`${what}: an object is needed, not ${described(value)}`);
  for (const name in value) {
    if (!known.includes(name)) throw unknownName(what, name, known.join(", "));
  }
  // The loop above does not see members of a class. An object of a class must have at least one of the names;
  // otherwise it is something else, such as a list.
  if (!isPlain(value) && !known.some((name) => name in value)) {
    throw new TypeError(`${what}: an object with ${known.join(", ")} is needed, not ${described(value)}`);
  }
}

/** Settings of Rust and Python that this package does not have. */
const NO_SETTINGS = { deadline: "a budget ends a question" };

function unknownName(what, name, known) {
  return new TypeError(`${what}: there is no ${quoted(name)}; ${NO_SETTINGS[name] ?? `there are ${known}`}`);
}

/** Returns whether a value is a plain object, of this or another window. */
export function isPlain(value) {
  if (typeof value !== "object" || value === null) return false;
  const parent = Object.getPrototypeOf(value);
  return parent === null || Object.getPrototypeOf(parent) === null;
}

/** Reads a list, each element with a reader. */
export function listOf(value, what, reader) {
  const length = lengthOf(value, what, "a list");
  const read = [];
  for (let k = 0; k < length; k += 1) read.push(reader(value[k], `${what}[${k}]`));
  return read;
}

/** Reads a list of exactly `count` elements. */
export function tupleOf(value, what, count, reader) {
  const read = listOf(value, what, reader);
  if (read.length !== count) throw new TypeError(`${what}: ${count} elements are needed, not ${read.length}`);
  return read;
}

/** Reads numbers into a Float64Array. They may be infinite. */
export function listOfNumbers(value, what) {
  const length = lengthOf(value, what, "a list of numbers");
  const numbers = typedArrayName(value) === undefined ? [] : value;
  for (let k = 0; k < length; k += 1) {
    const one = value[k];
    if (typeof one !== "number" || Number.isNaN(one)) numberOrInfinity(one, `${what}[${k}]`);
    if (numbers !== value) numbers.push(one);
  }
  return numbers instanceof Float64Array ? numbers : Float64Array.from(numbers);
}

/** Concatenates lists of numbers. */
export function joined(lists) {
  return Float64Array.from(lists.flatMap((numbers) => [...numbers]));
}

/** Returns the length of a list: an array, a typed array, or an object like one. */
export function lengthOf(value, what, needed) {
  const length = typeof value === "object" && value !== null ? value.length : undefined;
  if (!Number.isInteger(length) || length < 0) throw new TypeError(`${what}: ${needed} is needed, not ${described(value)}`);
  if (typedArrayName(value) !== undefined) checkMemory(value, what);
  return length;
}

const typedArray = Object.getPrototypeOf(Uint8Array.prototype);
const nameOfTypedArray = Object.getOwnPropertyDescriptor(typedArray, Symbol.toStringTag).get;

/** Returns the class name of a typed array, of this or another window. Returns undefined for other values. */
export function typedArrayName(value) {
  return nameOfTypedArray.call(value);
}

/** Refuses an array whose memory was transferred or has shrunk. Its length is 0, so it would look empty. */
function checkMemory(value, what) {
  try {
    typedArray.values.call(value);
  } catch (cause) {
    throw new TypeError(`${what}: the memory of the array is detached, or ends before it`, { cause });
  }
}

/** Reads bytes: a Uint8Array or an ArrayBuffer. */
export function bytesOf(value, what) {
  const isBuffer = Object.prototype.toString.call(value) === "[object ArrayBuffer]";
  if (!isBuffer && typedArrayName(value) !== "Uint8Array") throw new TypeError(`${what}: bytes in a Uint8Array or an ArrayBuffer are needed, not ${described(value)}`);
  if (!isBuffer) {
    checkMemory(value, what);
    return value;
  }
  try {
    return new Uint8Array(value);
  } catch (cause) {
    throw new TypeError(`${what}: the memory of the bytes is detached`, { cause });
  }
}

// --- Numbers, names and settings

export function finiteNumber(value, what) {
  if (!Number.isFinite(number(value, what))) throw new RangeError(`${what}: a finite number is needed, not ${value}`);
  return value;
}

/** Reads a limit, which may be infinite. */
export function numberOrInfinity(value, what) {
  if (Number.isNaN(number(value, what))) throw new RangeError(`${what}: a number is needed, not NaN`);
  return value;
}

function number(value, what) {
  if (typeof value !== "number") throw new TypeError(`${what}: a number is needed, not ${described(value)}`);
  return value;
}

export function trueOrFalse(value, what) {
  if (typeof value !== "boolean") throw new TypeError(`${what}: true or false is needed, not ${described(value)}`);
  return value;
}

/** Reads a name, which must be a string. */
export function nameOf(value, what) {
  if (typeof value !== "string") throw new TypeError(`${what}: a string is needed, not ${described(value)}`);
  // Refuses lone surrogates: the WebAssembly would replace them by another character.
  if (/\p{Surrogate}/u.test(value)) throw new TypeError(`${what}: ${quoted(value)} has half of a character`);
  return value;
}

/** Makes a reader for one of several known texts. For some wrong texts, `advice` has the right replacement. */
export function choiceOf(known, advice = {}) {
  const list = `${known.slice(0, -1).map(quoted).join(", ")} or ${quoted(known.at(-1))}`;
  return (value, what) => {
    if (known.includes(nameOf(value, what))) return value;
    const more = Object.hasOwn(advice, value) ? `: ${advice[value]}` : "";
    throw new TypeError(`${what}: ${quoted(value)} is not ${list}${more}`);
  };
}

/** The least and the greatest value of each setting, the same as in the WebAssembly. */
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
  // The comparison is written so that NaN is refused.
  if (!(number(value, name) >= least && value <= greatest)) {
    const allowed = greatest >= Number.MAX_VALUE ? `at least ${least}` : `from ${least} to ${greatest}`;
    const finite = greatest === Number.MAX_VALUE ? " and finite" : "";
    throw new RangeError(`${name}: ${value} is not ${allowed}${finite}`);
  }
  if (name === "budget" && !Number.isInteger(value) && value !== Infinity) throw new RangeError(`budget: ${value} is no whole number`);
  return value;
}
