// Answers queries, compares the answers with native ones, and returns the times over native ones, a line for each family.

const ROUNDS = 15;
// Native answers may differ in their last bits.
const ROUNDING = 1e-12;

export function compare(ccd, { knot, families }, clock) {
  const make = {
    box: () => ccd.Body.box([0.5, 0.3, 0.2]),
    capsule: () => ccd.Body.capsule(0.2, 0.5),
    knot: () => ccd.Body.fromFile("knot.obj", new TextEncoder().encode(knot)),
  };
  return families.map(({ name, kind, motions, micros, times }) => {
    const [body, target] = [make[kind](), make[kind === "capsule" ? "box" : kind]()];
    const options = motions.map(([position, rotation, velocity, spin]) => ({ motionA: { position, rotation, velocity, spin }, duration: 1 }));
    const taken = [];
    let answers = [];
    for (let round = 0; round < ROUNDS; round += 1) {
      const begun = clock.now();
      answers = options.map((option) => ccd.firstContact(body, target, option));
      taken.push((1000 * (clock.now() - begun)) / options.length);
    }
    const differ = answers.filter((answer, k) => (times[k] === null ? answer.kind !== "free" : !(Math.abs(answer.time - times[k]) <= ROUNDING)));
    for (const made of [body, target]) made.free();
    const median = taken.sort((a, b) => a - b)[ROUNDS >> 1];
    const hits = times.filter((time) => time !== null).length;
    return `  ${name}: ${median.toFixed(2)} µs a query, native ${micros.toFixed(2)}, ${(median / micros).toFixed(2)} times; ${hits} of ${times.length} touch, ${differ.length} differ`;
  });
}
