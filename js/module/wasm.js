// Loads the WebAssembly.

/* global wasm_bindgen, CODE */

import { inflated } from "./inflate.js";
import { checkNames } from "./numbers.js";
import { described } from "./owned.js";

/** The instructions `i8x16.splat` and `i8x16.popcnt`: a module that is valid only with SIMD. */
const VECTOR_MODULE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

let loading = null;
let loaded = null;

export async function init(options) {
  checkNames(options, "options of init", ["simd"]);
  const wanted = options?.simd;
  if (wanted !== undefined && typeof wanted !== "boolean") throw new TypeError(`simd: true or false is needed, not ${described(wanted)}`);
  loading ??= load(wanted ?? WebAssembly.validate(VECTOR_MODULE)).catch((error) => {
    loading = null;
    throw error;
  });
  const { simd } = await loading;
  if (wanted !== undefined && wanted !== simd) throw new Error(`simd: the module ${simd ? "with" : "without"} vector instructions is loaded already`);
  return { simd };
}

export function memoryUsage() {
  return engine().memory.buffer.byteLength;
}

/** Returns the classes of the WebAssembly, or throws if there are none yet. */
export function classes() {
  return engine().classes;
}

/** Returns numbers in the memory of the WebAssembly. They have to be taken anew when it grows. */
export function numbersAt(address, count) {
  return new Float64Array(engine().memory.buffer, address, count);
}

function engine() {
  if (loaded === null) throw new Error("rigid-ccd is not loaded: `await init()` comes first");
  return loaded;
}

async function load(simd) {
  if (simd && !WebAssembly.validate(VECTOR_MODULE)) throw new Error("simd: this engine has no WebAssembly with 128-bit vectors");
  const built = simd ? { code: CODE, bindgen: wasm_bindgen } : await fallback();
  const module = await WebAssembly.compile(await unpacked(bytesOfBase64(built.code)));
  const { memory } = await built.bindgen({ module_or_path: module });
  loaded = { classes: built.bindgen, memory, simd };
  return loaded;
}

/** Fetches the module without vector instructions, which lies beside this one. */
async function fallback() {
  try {
    return await import("./fallback.js");
  } catch (error) {
    throw new Error(`rigid-ccd needs its file fallback.js where WebAssembly has no 128-bit vectors: ${error.message}`, { cause: error });
  }
}

async function unpacked(packed) {
  // Safari 15 and Firefox 112 have no such class.
  if (typeof DecompressionStream === "undefined") return inflated(packed);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

function bytesOfBase64(text) {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let k = 0; k < characters.length; k += 1) bytes[k] = characters.charCodeAt(k);
  return bytes;
}
