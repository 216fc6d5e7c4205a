// Answers to random questions, with all their bits.

/** A knotted tube. Its vertices are sums of products, without functions that engines may round differently. */
function tube(random) {
  const [around, along] = [8, 40];
  const [positions, indices] = [[], []];
  for (let row = 0; row < along; row += 1) {
    for (let column = 0; column < around; column += 1) {
      positions.push(row / along + 0.02 * random(-1, 1), (column % 4) / 8 + 0.02 * random(-1, 1), column / 20 + 0.02 * random(-1, 1));
      if (row + 1 === along) continue;
      const [here, next] = [row * around + column, row * around + ((column + 1) % around)];
      indices.push(here, next, next + around, here, next + around, here + around);
    }
  }
  return [new Float64Array(positions), new Uint32Array(indices)];
}

/** Returns the answers to random questions as a text that has all bits of each number. */
export function answers(ccd, randomNumbers) {
  const random = randomNumbers(7);
  const vector = (size) => [0, 1, 2].map(() => random(-size, size));
  const mesh = tube(random);
  const bodies = [ccd.Body.fromMesh(...mesh), ccd.Body.box([0.3, 0.2, 0.4]), ccd.Body.capsule(0.1, 0.4), ccd.Body.cone(0.3, 0.3), ccd.Body.sphere(0.2)];
  const questions = [ccd.firstContact, ccd.anyContact, ccd.contactInterval, ccd.closestApproach];
  const found = [];
  for (let k = 0; k < 400; k += 1) {
    const [a, b] = [bodies[k % 2 === 0 ? 0 : Math.floor(random(0, 5))], bodies[Math.floor(random(0, 5))]];
    const position = vector(1.5);
    const velocity = position.map((place) => -2 * place * random(0.7, 1.3));
    const rotation = [...vector(1), 1];
    found.push(questions[k % 4](a, b, { motionA: { position, rotation, velocity, angularVelocity: vector(6) } }));
  }
  for (const body of bodies) body.free();
  const kinds = new Set(found.map(({ kind }) => kind));
  return { kinds, text: JSON.stringify(found) };
}
