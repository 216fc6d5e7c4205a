// Loads the WebAssembly.

/* global wasm_bindgen, CODE */

import { inflated } from "./inflate.js";
import { optionsOf, trueOrFalse } from "./numbers.js";

/** A module with the instructions `i8x16.splat` and `i8x16.popcnt`. It is valid only in engines with SIMD. */
const VECTOR_MODULE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

let loading = null;
/** The engine: its classes, its memory, whether it uses vector instructions, and the error that ended it. */
let loaded = null;

/** The engine has ended, and all objects in its memory are lost. Calling `init` again loads a new engine. */
export class EngineError extends Error {
  constructor(reason, event, cause) {
    super(`${event}: all bodies, movements, robots and cells are lost; \`await init()\` loads a new engine`, { cause });
    this.name = "EngineError";
    this.reason = reason;
  }
}

export async function init(options) {
  const { simd: requested } = optionsOf(options, "init", { simd: [trueOrFalse, undefined] });
  // Loads a new engine if the old one has ended.
  if (loaded !== null) engineEnd(loaded);
  loading ??= load(requested ?? WebAssembly.validate(VECTOR_MODULE)).catch((error) => {
    loading = null;
    throw error;
  });
  const { simd } = await loading;
  if (requested !== undefined && requested !== simd) throw new Error(`simd: the module ${simd ? "with" : "without"} vector instructions is already loaded`);
  return { simd };
}

export function memoryUsage() {
  return engine().memory.buffer.byteLength;
}

/** Returns the classes of the WebAssembly. Throws if it is not loaded. */
export function classes() {
  return engine().classes;
}

/** Returns a view of numbers in the memory of the WebAssembly. The view is detached when the memory grows. */
export function numbersAt(address, count) {
  return new Float64Array(engine().memory.buffer, address, count);
}

export function engine() {
  if (loaded === null) throw new Error("rigid-ccd is not loaded: call `await init()` first");
  const end = engineEnd(loaded);
  if (end !== null) throw end;
  return loaded;
}

async function load(simd) {
  if (simd && !WebAssembly.validate(VECTOR_MODULE)) throw new Error("simd: this engine has no WebAssembly with 128-bit vectors");
  const build = simd ? { code: CODE, bindgen: wasm_bindgen } : await fallback();
  const module = await WebAssembly.compile(await unpacked(bytesOfBase64(build.code)));
  const started = { classes: null, memory: null, simd, fault: null, failure: null, ended: null };
  started.classes = build.bindgen(guard(started), { remark, fault: (text) => (started.fault = text) });
  ({ memory: started.memory } = await started.classes({ module_or_path: module }));
  loaded = started;
  return loaded;
}

/** Returns a replacement of the global `WebAssembly`. It wraps each exported function, so that a fault in any call ends the engine. */
function guard(started) {
  const guarded = (call) => (...values) => {
    // The garbage collector may still free objects of an engine that has ended: do nothing.
    if (engineEnd(started) !== null) return undefined;
    try {
      return call(...values);
    } catch (error) {
      // If the stack is full, the next call may fail. This assignment does not.
      started.failure = error;
      throw failed(started, error);
    }
  };
  return {
    Instance: WebAssembly.Instance,
    async instantiate(module, imports) {
      const { exports } = await WebAssembly.instantiate(module, imports);
      const entries = Object.entries(exports).map(([name, value]) => [name, typeof value === "function" ? guarded(value) : value]);
      return { instance: { exports: Object.fromEntries(entries) }, module };
    },
  };
}

/** Returns the error that ended an engine, or null. */
export function engineEnd(engine) {
  if (engine.failure !== null) failed(engine, engine.failure);
  return engine.ended;
}

/** Ends an engine if it cannot continue after an error. Returns the error to throw. */
function failed(started, error) {
  // A stack overflow is an error of the JavaScript engine: a RangeError, or an InternalError.
  if (!(error instanceof WebAssembly.RuntimeError || error instanceof RangeError || error.name === "InternalError")) {
    started.failure = null;
    return error;
  }
  const { fault, memory } = started;
  // If no fault was reported, unreachable code means that memory is exhausted.
  const isMemory = fault === null ? /unreachable/i.test(error.message) : /capacity overflow/.test(fault);
  const event = isMemory ? `the memory of the WebAssembly is exhausted at ${memory.buffer.byteLength} bytes` : `a fault of rigid-ccd: ${fault ?? error.message}`;
  started.ended = new EngineError(isMemory ? "memory" : "fault", event, error);
  if (loaded === started) loading = null;
  started.failure = null;
  return started.ended;
}

const shownRemarks = new Set();

/** Writes a remark on a probable mistake to the console, once for each kind. */
function remark(kind, text) {
  if (shownRemarks.has(kind)) return;
  shownRemarks.add(kind);
  console.warn(`rigid-ccd: ${text}`);
}

/** Loads the module without vector instructions, in the same folder as this one. */
async function fallback() {
  try {
    return await import("./fallback.js");
  } catch (error) {
    throw new Error(`rigid-ccd needs its file fallback.js where WebAssembly has no 128-bit vectors: ${error.message}`, { cause: error });
  }
}

async function unpacked(packed) {
  // Safari 15 and Firefox 112 do not have this class.
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
