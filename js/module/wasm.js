// Loads the WebAssembly.

/* global wasm_bindgen, CODE */

/** The instructions `i8x16.splat` and `i8x16.popcnt`: a module that is valid only with SIMD. */
const VECTOR_MODULE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

let loading = null;
let memory = null;

export function init() {
  loading ??= load().catch((error) => {
    loading = null;
    throw error;
  });
  return loading;
}

export function memoryUsage() {
  return loaded().buffer.byteLength;
}

/** Returns the classes of the WebAssembly, or throws if there are none yet. */
export function classes() {
  loaded();
  return wasm_bindgen;
}

/** Returns numbers in the memory of the WebAssembly. They have to be taken anew when it grows. */
export function numbersAt(address, count) {
  return new Float64Array(loaded().buffer, address, count);
}

function loaded() {
  if (memory === null) throw new Error("rigid-ccd is not loaded: `await init()` comes first");
  return memory;
}

async function load() {
  if (!WebAssembly.validate(VECTOR_MODULE)) throw new Error("rigid-ccd needs WebAssembly with 128-bit vectors: Chrome 91, Firefox 89, Safari 16.4, Node 18 or newer");
  const unpacked = new Blob([bytesOfBase64(CODE)]).stream().pipeThrough(new DecompressionStream("gzip"));
  const code = await WebAssembly.compile(await new Response(unpacked).arrayBuffer());
  memory = (await wasm_bindgen({ module_or_path: code })).memory;
}

function bytesOfBase64(text) {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let k = 0; k < characters.length; k += 1) bytes[k] = characters.charCodeAt(k);
  return bytes;
}
