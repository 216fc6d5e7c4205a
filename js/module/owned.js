// An object whose memory is in the WebAssembly.

/**
 * Holds an object of the WebAssembly until `free`, or until the garbage collector finds that nothing refers to it: wasm-bindgen
 * registers its objects for that.
 */
export class Owned {
  #inner;

  constructor(inner) {
    this.#inner = inner;
  }

  /** Returns the object of the WebAssembly. */
  static inner(owned) {
    if (owned.#inner === null) throw new Error(`this ${owned.constructor.name} was freed`);
    return owned.#inner;
  }

  free() {
    this.#inner?.free();
    this.#inner = null;
  }
}

// Engines without `using` have no such symbol.
if (Symbol.dispose) Object.defineProperty(Owned.prototype, Symbol.dispose, { value: Owned.prototype.free });

/** Returns the inner object of an argument that has to be of a class. */
export function innerOf(value, type, what) {
  if (!(value instanceof type)) throw new TypeError(`${what}: a ${type.name} is needed, not ${described(value)}`);
  return Owned.inner(value);
}

/** Writes a string in messages as JavaScript does, so that it is told from all around it. */
export function quoted(text) {
  return JSON.stringify(text);
}

/** Describes a value in messages. */
export function described(value) {
  if (typeof value === "string") return quoted(value);
  if (value === null || typeof value !== "object") return String(value);
  return `an object of ${value.constructor?.name ?? "no class"}`;
}
