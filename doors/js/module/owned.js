// An object whose memory is in the WebAssembly.

import { engineEnd, engine } from "./wasm.js";
import { described, nameOfClass } from "./words.js";

/**
 * Holds an object of the WebAssembly until `free`, or until the garbage collector finds that nothing refers to it: wasm-bindgen
 * registers its objects for that.
 */
export class Owned {
  #inner;
  /** The engine whose memory holds the object. */
  #home = engine();

  constructor(inner) {
    this.#inner = inner;
  }

  /** Returns the object of the WebAssembly. */
  static inner(owned) {
    if (owned.#inner === null) throw new Error(`this ${nameOfClass(owned)} was freed`);
    const end = engineEnd(owned.#home);
    if (end !== null) throw end;
    return owned.#inner;
  }

  free() {
    if (engineEnd(this.#home) === null) this.#inner?.free();
    this.#inner = null;
  }
}

// Engines without `using` have no such symbol.
if (Symbol.dispose) Object.defineProperty(Owned.prototype, Symbol.dispose, { value: Owned.prototype.free });

/** Returns the inner object of an argument that has to be of a class. */
export function innerOf(value, type, what) {
  if (value instanceof type) return Owned.inner(value);
  const name = nameOfClass(type.prototype);
  const copy = nameOfClass(value) === name ? " of another copy of this module" : "";
  throw new TypeError(`${what}: a ${name} is needed, not ${described(value)}${copy}`);
}
