// Objects whose memory is in the WebAssembly.

import { engineEnd, engine } from "./wasm.js";
import { described, nameOfClass } from "./words.js";

/**
 * Owns an object of the WebAssembly until `free`, or until garbage collection: wasm-bindgen registers its objects for
 * it.
 */
export class Owned {
  #inner;
  /** The engine whose memory holds the object. */
  #engine = engine();

  constructor(inner) {
    this.#inner = inner;
  }

  /** Returns the object in the WebAssembly. Throws if it was freed, or if its engine has ended. */
  static inner(owned) {
    if (owned.#inner === null) throw new Error(`this ${nameOfClass(owned)} was freed`);
    const end = engineEnd(owned.#engine);
    if (end !== null) throw end;
    return owned.#inner;
  }

  free() {
    if (engineEnd(this.#engine) === null) this.#inner?.free();
    this.#inner = null;
  }
}

// JavaScript engines without `using` do not have this symbol.
if (Symbol.dispose) Object.defineProperty(Owned.prototype, Symbol.dispose, { value: Owned.prototype.free });

/** Checks that an argument is of a class, and returns its object in the WebAssembly. */
export function innerOf(value, type, argumentName) {
  if (value instanceof type) return Owned.inner(value);
  const name = nameOfClass(type.prototype);
  const copy = nameOfClass(value) === name ? " of another copy of this module" : "";
  throw new TypeError(`${argumentName}: a ${name} is needed, not ${described(value)}${copy}`);
}
