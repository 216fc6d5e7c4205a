// Reads the arguments of calls. Nothing is converted: a wrong value is an error that names the argument.
//
// A reader is a function of a value and of its name in messages. The fields of an object are listed by name, each as
// `[reader, default]`. A field without a default is required.

import { described, quoted } from "./words.js";

// --- Objects with fields, and lists

/** Reads the fields of an object, each with its reader. */
export function fieldsOf(value, argumentName, fields, prefix = "") {
  checkNames(value, argumentName, Object.keys(fields));
  const read = {};
  for (const [name, [reader, ...defaults]] of Object.entries(fields)) {
    const field = value[name];
    read[name] = field === undefined && defaults.length > 0 ? defaults[0] : reader(field, prefix + name);
  }
  return read;
}

/** Reads the options of a function or class. The caller may leave out the whole object. */
export function optionsOf(options, functionName, fields) {
  return fieldsOf(options === undefined ? {} : options, `options of ${functionName}`, fields);
}

/** Throws a `TypeError` for a value that is not an object, and for a field that is not in `known`, which is probably misspelt. */
export function checkNames(value, argumentName, known) {
  if (typeof value !== "object" || value === null) throw new TypeError(`${argumentName}: an object is needed, not ${described(value)}`);
  for (const name in value) {
    if (!known.includes(name)) throw unknownName(argumentName, name, known.join(", "));
  }
  // The loop above does not see getters of a class. An object of a class must have at least one of the known names,
  // because it may be something else, such as a list.
  if (!isPlain(value) && !known.some((name) => name in value)) {
    throw new TypeError(`${argumentName}: an object with ${known.join(", ")} is needed, not ${described(value)}`);
  }
}

/** Settings of Rust and Python that this package does not have, each with the advice for it. */
const UNSUPPORTED_SETTINGS = { deadline: "a budget limits a question instead" };

function unknownName(argumentName, name, known) {
  return new TypeError(`${argumentName}: there is no ${quoted(name)}; ${UNSUPPORTED_SETTINGS[name] ?? `there are ${known}`}`);
}

/** Returns whether a value is a plain object, of this or another window. */
export function isPlain(value) {
  if (typeof value !== "object" || value === null) return false;
  const prototype = Object.getPrototypeOf(value);
  return prototype === null || Object.getPrototypeOf(prototype) === null;
}

/** Reads a list, each element with a reader. */
export function listOf(value, argumentName, reader) {
  const length = lengthOf(value, argumentName, "a list");
  const read = [];
  for (let k = 0; k < length; k += 1) read.push(reader(value[k], `${argumentName}[${k}]`));
  return read;
}

/** Reads a list of exactly `count` elements. */
export function tupleOf(value, argumentName, count, reader) {
  const read = listOf(value, argumentName, reader);
  if (read.length !== count) throw new TypeError(`${argumentName}: ${count} elements are needed, not ${read.length}`);
  return read;
}

/** Reads numbers into a Float64Array. They may be infinite. */
export function listOfNumbers(value, argumentName) {
  const length = lengthOf(value, argumentName, "a list of numbers");
  const numbers = typedArrayName(value) === undefined ? [] : value;
  for (let k = 0; k < length; k += 1) {
    const element = value[k];
    if (typeof element !== "number" || Number.isNaN(element)) numberOrInfinity(element, `${argumentName}[${k}]`);
    if (numbers !== value) numbers.push(element);
  }
  return numbers instanceof Float64Array ? numbers : Float64Array.from(numbers);
}

/** Concatenates lists of numbers. */
export function joined(lists) {
  return Float64Array.from(lists.flatMap((numbers) => [...numbers]));
}

/** Returns the length of a list: an array, a typed array, or an object like one. */
export function lengthOf(value, argumentName, needed) {
  const length = typeof value === "object" && value !== null ? value.length : undefined;
  if (!Number.isInteger(length) || length < 0) throw new TypeError(`${argumentName}: ${needed} is needed, not ${described(value)}`);
  if (typedArrayName(value) !== undefined) checkNotDetached(value, argumentName);
  return length;
}

const typedArray = Object.getPrototypeOf(Uint8Array.prototype);
const nameOfTypedArray = Object.getOwnPropertyDescriptor(typedArray, Symbol.toStringTag).get;

/** Returns the class name of a typed array, of this or another window. Returns undefined for other values. */
export function typedArrayName(value) {
  return nameOfTypedArray.call(value);
}

/** Throws for a typed array whose memory was transferred or has shrunk. Its length is 0, so it would pass as an empty array. */
function checkNotDetached(value, argumentName) {
  try {
    typedArray.values.call(value);
  } catch (cause) {
    throw new TypeError(`${argumentName}: the memory of the array is detached, or shorter than the array`, { cause });
  }
}

/** Reads bytes: a Uint8Array or an ArrayBuffer. */
export function bytesOf(value, argumentName) {
  const isBuffer = Object.prototype.toString.call(value) === "[object ArrayBuffer]";
  if (!isBuffer && typedArrayName(value) !== "Uint8Array") throw new TypeError(`${argumentName}: bytes in a Uint8Array or an ArrayBuffer are needed, not ${described(value)}`);
  if (!isBuffer) {
    checkNotDetached(value, argumentName);
    return value;
  }
  try {
    return new Uint8Array(value);
  } catch (cause) {
    throw new TypeError(`${argumentName}: the memory of the bytes is detached`, { cause });
  }
}

// --- Numbers, names and settings

export function finiteNumber(value, argumentName) {
  if (!Number.isFinite(number(value, argumentName))) throw new RangeError(`${argumentName}: a finite number is needed, not ${value}`);
  return value;
}

/** Reads a number that may be infinite, such as the limit of a joint. */
export function numberOrInfinity(value, argumentName) {
  if (Number.isNaN(number(value, argumentName))) throw new RangeError(`${argumentName}: a number is needed, not NaN`);
  return value;
}

function number(value, argumentName) {
  if (typeof value !== "number") throw new TypeError(`${argumentName}: a number is needed, not ${described(value)}`);
  return value;
}

export function trueOrFalse(value, argumentName) {
  if (typeof value !== "boolean") throw new TypeError(`${argumentName}: true or false is needed, not ${described(value)}`);
  return value;
}

/** Reads a name, which must be a string. */
export function nameOf(value, argumentName) {
  if (typeof value !== "string") throw new TypeError(`${argumentName}: a string is needed, not ${described(value)}`);
  // Refuses lone surrogates: the WebAssembly would replace them by another character.
  if (/\p{Surrogate}/u.test(value)) throw new TypeError(`${argumentName}: ${quoted(value)} has half of a surrogate pair`);
  return value;
}

/** Makes a reader for one of several texts. `advice` has hints for texts that callers may pass by mistake. */
export function choiceOf(known, advice = {}) {
  const list = `${known.slice(0, -1).map(quoted).join(", ")} or ${quoted(known.at(-1))}`;
  return (value, argumentName) => {
    if (known.includes(nameOf(value, argumentName))) return value;
    const hint = Object.hasOwn(advice, value) ? `: ${advice[value]}` : "";
    throw new TypeError(`${argumentName}: ${quoted(value)} is not ${list}${hint}`);
  };
}

/** The least and the greatest value of each setting. The engine has the same limits; the check is here to name the setting in the message. */
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
