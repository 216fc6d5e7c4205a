// Decompresses gzip [RFC 1951, RFC 1952], for engines without `DecompressionStream`.

/** For each symbol of a length and of a distance: the least value, and the number of extra bits added to it. */
const LENGTHS = symbolValues([0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5], 3);
const DISTANCES = symbolValues([0, 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13], 1);
/** The greatest length has a symbol of its own, without extra bits. */
LENGTHS.push({ least: 258, bits: 0 });

const LENGTH_CODE_ORDER = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
const HEADER_LENGTH = 10;
const END_OF_BLOCK = 256;

/** Decompresses a gzip file. It must have one member, and no optional parts in its header. */
export function inflated(packed) {
  const size = new DataView(packed.buffer, packed.byteOffset).getUint32(packed.length - 4, true);
  const input = { packed, at: HEADER_LENGTH, bits: 0, count: 0 };
  const output = new Uint8Array(size);
  let length = 0;
  let isLast = false;
  while (!isLast) {
    isLast = take(input, 1) === 1;
    const kind = take(input, 2);
    if (kind === 0) length = copyStored(input, output, length);
    else length = unpackBlock(input, output, length, kind === 1 ? fixedCodes() : readCodes(input));
  }
  return output;
}

function symbolValues(bits, first) {
  let least = first;
  return bits.map((count) => {
    const value = { least, bits: count };
    least += 2 ** count;
    return value;
  });
}

/** Reads bits of the input, lowest first. */
function take(input, count) {
  while (input.count < count) {
    input.bits |= input.packed[input.at] << input.count;
    input.at += 1;
    input.count += 8;
  }
  const taken = input.bits & ((1 << count) - 1);
  input.bits >>>= count;
  input.count -= count;
  return taken;
}

function copyStored(input, output, length) {
  // Skips the rest of the byte, and the complement of the length.
  input.bits = 0;
  input.count = 0;
  const size = take(input, 16);
  input.at += 2;
  output.set(input.packed.subarray(input.at, input.at + size), length);
  input.at += size;
  return length + size;
}

/** Decompresses a block to the output from index `from` on, and returns the index of its end. */
function unpackBlock(input, output, from, [symbols, distances]) {
  let at = from;
  for (;;) {
    const symbol = decode(input, symbols);
    if (symbol === END_OF_BLOCK) return at;
    if (symbol < END_OF_BLOCK) {
      output[at] = symbol;
      at += 1;
      continue;
    }
    const end = at + valueOf(input, LENGTHS[symbol - END_OF_BLOCK - 1]);
    const distance = valueOf(input, DISTANCES[decode(input, distances)]);
    // Copies byte by byte, because source and destination may overlap.
    for (; at < end; at += 1) output[at] = output[at - distance];
  }
}

function valueOf(input, { least, bits }) {
  return least + take(input, bits);
}

/** Returns the prefix code with these code lengths: the number of codes of each length, and the symbols in the order of their codes. */
function codeOf(lengths) {
  const counts = new Uint16Array(16);
  for (const length of lengths) counts[length] += 1;
  counts[0] = 0;
  const symbols = [...lengths.keys()].filter((symbol) => lengths[symbol] > 0);
  symbols.sort((one, other) => lengths[one] - lengths[other] || one - other);
  return { counts, symbols };
}

/** Reads a symbol. Codes of one length are consecutive numbers, and come after all shorter codes. */
function decode(input, { counts, symbols }) {
  let [word, first, index] = [0, 0, 0];
  for (let length = 1; length < counts.length; length += 1) {
    word |= take(input, 1);
    const count = counts[length];
    if (word - first < count) return symbols[index + word - first];
    index += count;
    first = (first + count) << 1;
    word <<= 1;
  }
  throw new Error("the WebAssembly of rigid-ccd is damaged");
}

function fixedCodes() {
  const lengths = Array.from({ length: 288 }, (_, symbol) => (symbol < 144 ? 8 : symbol < 256 ? 9 : symbol < 280 ? 7 : 8));
  return [codeOf(lengths), codeOf(new Array(30).fill(5))];
}

/** Reads both prefix codes of a block. A third code encodes their code lengths. */
function readCodes(input) {
  const [symbols, distances, packed] = [take(input, 5) + 257, take(input, 5) + 1, take(input, 4) + 4];
  const codeLengths = new Array(19).fill(0);
  for (const symbol of LENGTH_CODE_ORDER.slice(0, packed)) codeLengths[symbol] = take(input, 3);
  const code = codeOf(codeLengths);
  const lengths = [];
  while (lengths.length < symbols + distances) {
    const symbol = decode(input, code);
    if (symbol < 16) lengths.push(symbol);
    else if (symbol === 16) repeat(lengths, lengths[lengths.length - 1], 3 + take(input, 2));
    else if (symbol === 17) repeat(lengths, 0, 3 + take(input, 3));
    else repeat(lengths, 0, 11 + take(input, 7));
  }
  return [codeOf(lengths.slice(0, symbols)), codeOf(lengths.slice(symbols))];
}

function repeat(list, value, count) {
  for (let k = 0; k < count; k += 1) list.push(value);
}
