// Assertions of the cases, for Node and browsers.

export function ok(condition, message) {
  if (!condition) throw new Error(message);
}

export function equal(actual, expected) {
  const [one, other] = [actual, expected].map((value) => JSON.stringify(value));
  ok(one === other, `${one} is not ${other}`);
}

/** Checks that a number is at most `by` less than another one, and not greater. */
export function justBefore(actual, expected, by) {
  ok(actual <= expected && actual >= expected - by, `${actual} is not within ${by} before ${expected}`);
}

export function between(actual, low, high) {
  ok(actual >= low && actual <= high, `${actual} is not from ${low} to ${high}`);
}

export function throws(run, pattern) {
  let error = null;
  try {
    run();
  } catch (caught) {
    error = caught;
  }
  ok(error instanceof Error, `nothing is thrown that matches ${pattern}`);
  ok(pattern.test(error.message), `"${error.message}" does not match ${pattern}`);
  return error;
}

/** Random numbers that are the same everywhere (mulberry32). */
export function randomNumbers(seed) {
  let state = seed;
  return (low, high) => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return low + ((high - low) * ((mixed ^ (mixed >>> 14)) >>> 0)) / 4294967296;
  };
}
