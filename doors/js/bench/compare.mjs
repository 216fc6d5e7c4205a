// Answers queries, and compares the answers with native ones. Returns the ratios of the times to native times, a line
// for each family.

// Takes the least time of all rounds, because other load of the machine only adds time. The first rounds run before
// the engine optimises.
const ROUNDS = 60;
// Native answers may differ in their last bits.
const ROUNDING = 1e-12;

export function compare(ccd, { knot, families }, clock) {
  const make = {
    box: () => ccd.Body.box([0.5, 0.3, 0.2]),
    capsule: () => ccd.Body.capsule(0.2, 0.5),
    knot: () => ccd.Body.fromFile("knot.obj", new TextEncoder().encode(knot)),
  };
  return families.map(({ name, kind, motions, micros, micros128, times }) => {
    const [body, target] = [make[kind](), make[kind === "capsule" ? "box" : kind]()];
    const options = motions.map(([position, rotation, velocity, spin]) => ({ motionA: { position, rotation, velocity, angularVelocity: spin }, duration: 1 }));
    let least = Infinity;
    let answers = [];
    for (let round = 0; round < ROUNDS; round += 1) {
      const begun = clock.now();
      answers = options.map((option) => ccd.firstContact(body, target, option));
      least = Math.min(least, (1000 * (clock.now() - begun)) / options.length);
    }
    const differ = answers.filter((answer, k) => (times[k] === null ? answer.kind !== "free" : !(Math.abs(answer.time - times[k]) <= ROUNDING)));
    for (const made of [body, target]) made.free();
    const hits = times.filter((time) => time !== null).length;
    const native = `native ${micros.toFixed(2)} (${micros128.toFixed(2)} with 128 bits), ${(least / micros).toFixed(2)} times (${(least / micros128).toFixed(2)})`;
    return `  ${name}: ${least.toFixed(2)} µs a query, ${native}; ${hits} of ${times.length} touch, ${differ.length} differ`;
  });
}
