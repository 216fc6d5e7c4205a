//! The kinds of forgeries.

use crate::files::{AXES, Files, LINK, Random, WITNESS};
use sha2::{Digest, Sha256};

/// The number of bytes of a vertex.
const VERTEX: usize = 32;

type Forge = fn(&mut Random, &mut Files, &[Files]);

/// Each kind of forgery, with its name. A change that is impossible for a proof leaves it unchanged.
pub(crate) const KINDS: [(&str, Forge); 35] = [
    ("a unit", |random, files, _| {
        flip(random, &mut files.proof[8..16]);
    }),
    (
        "the number of links, bodies or pairs",
        |random, files, _| {
            add(random, &mut files.proof[16..28]);
        },
    ),
    ("a link's parent or axes", |random, files, _| {
        let at = *pick(random, &files.positions().links) + [0, AXES][random.below(2)];
        files.proof[at] = random.below(4) as u8;
    }),
    ("a bit of a link's motion", |random, files, _| {
        let at = *pick(random, &files.positions().links);
        flip(random, &mut files.proof[at + 4..at + LINK]);
    }),
    ("a number of a link's motion", |random, files, _| {
        let at = *pick(random, &files.positions().links);
        let number = 8 * random.below((LINK - 8) / 8) + 4;
        let number = if number < AXES { number } else { number + 4 };
        change_number(random, files, at + number);
    }),
    (
        "a velocity or an axis of another link",
        |random, files, _| {
            // Copies velocity, axis, start and rate, or a single number of these.
            let links = files.positions().links;
            let [a, b] = [0, 1].map(|_| *pick(random, &links) + AXES + 4);
            let size = [LINK - AXES - 4, 8][random.below(2)];
            let [a, b] = [a, b].map(|at| at + 8 * random.below((LINK - AXES - 4 - size) / 8 + 1));
            let text = files.proof[a..a + size].to_vec();
            files.proof.copy_within(b..b + size, a);
            files.proof[b..b + size].copy_from_slice(&text);
        },
    ),
    ("two links' motions exchanged", |random, files, _| {
        let links = files.positions().links;
        let [a, b] = [0, 1].map(|_| *pick(random, &links) + 4);
        let text = files.proof[a..a + LINK - 4].to_vec();
        files.proof.copy_within(b..b + LINK - 4, a);
        files.proof[b..b + LINK - 4].copy_from_slice(&text);
    }),
    ("a digest", |random, files, _| {
        let at = *pick(random, &files.positions().bodies);
        flip(random, &mut files.proof[at..at + 32]);
    }),
    ("meshes exchanged", |random, files, _| {
        let bodies = files.positions().bodies;
        let [a, b] = [0, 1].map(|_| *pick(random, &bodies));
        let digest = files.proof[a..a + 32].to_vec();
        files.proof.copy_within(b..b + 32, a);
        files.proof[b..b + 32].copy_from_slice(&digest);
    }),
    ("a body's link", |random, files, _| {
        let at = *pick(random, &files.positions().bodies) + 32;
        files.proof[at] = random.below(8) as u8;
    }),
    ("a radius, with all digests", |random, files, _| {
        let side = random.below(2);
        let count = u32::from_le_bytes([0, 1, 2, 3].map(|k| files.meshes[side][k])) as usize;
        let at = 8 + VERTEX * random.below(count) + 24;
        change_number_at(random, &mut files.meshes[side], at);
        renew_digests(files, side);
    }),
    ("a pair's bodies", |random, files, _| {
        let at = *pick(random, &files.positions().pairs) + 4 * random.below(2);
        files.proof[at] = random.below(4) as u8;
    }),
    ("a margin", |random, files, _| {
        let at = *pick(random, &files.positions().pairs) + 8;
        change_number(random, files, at);
    }),
    ("the end of the time", |random, files, _| {
        let at = files.positions().until;
        change_number(random, files, at);
    }),
    ("a witness left out, or added", |_, files, _| {
        let positions = files.positions();
        let at = positions.until + 8;
        match positions.witness {
            Some(witness) => drop(files.proof.splice(at..witness + WITNESS, [0; 4])),
            None => files.proof[at] = 1,
        }
    }),
    ("the time of a witness", |random, files, _| {
        if let Some(at) = files.positions().witness {
            change_number(random, files, at + 4);
        }
    }),
    ("the tolerance of a witness", |random, files, _| {
        if let Some(at) = files.positions().witness {
            change_number(random, files, at + 12);
        }
    }),
    ("the points of a witness", |random, files, _| {
        if let Some(at) = files.positions().witness {
            flip(random, &mut files.proof[at + 20..at + WITNESS]);
        }
    }),
    ("a step left out", |random, files, _| {
        let step = pick(random, &files.positions().steps).clone();
        files.proof.drain(step);
    }),
    ("a step twice", |random, files, _| {
        let step = pick(random, &files.positions().steps).clone();
        let text = files.proof[step.clone()].to_vec();
        files.proof.splice(step.start..step.start, text);
    }),
    ("two steps exchanged", |random, files, _| {
        let steps = files.positions().steps;
        let k = random.below(steps.len().max(2) - 1);
        if let [a, b] = &steps[k..(k + 2).min(steps.len())] {
            files.proof[a.start..b.end].rotate_left(a.len());
        }
    }),
    ("a plane moved", |random, files, _| {
        let leaves = steps_of(files, 3..6);
        if !leaves.is_empty() {
            let leaf = pick(random, &leaves).clone();
            flip(random, &mut files.proof[leaf.end - 7..leaf.end]);
        }
    }),
    ("a normal or an offset changed", |random, files, _| {
        let leaves = steps_of(files, 3..6);
        if !leaves.is_empty() {
            let leaf = pick(random, &leaves).clone();
            flip(random, &mut files.proof[leaf.start + 1..leaf.end]);
        }
    }),
    ("a plane with another frame", |random, files, _| {
        let leaves = steps_of(files, 3..6);
        if !leaves.is_empty() {
            let at = pick(random, &leaves).start;
            files.proof[at] = 3 + random.below(3) as u8;
        }
    }),
    ("a ball around the other part", |random, files, _| {
        let leaves = steps_of(files, 6..8);
        if !leaves.is_empty() {
            let at = pick(random, &leaves).start;
            files.proof[at] ^= 1;
        }
    }),
    ("a leaf with a ball instead", |random, files, _| {
        let step = pick(random, &files.positions().steps).clone();
        files.proof.splice(step, [6 + random.below(2) as u8]);
    }),
    ("another kind of split", |random, files, _| {
        let splits = steps_of(files, 0..3);
        if !splits.is_empty() {
            let at = pick(random, &splits).start;
            files.proof[at] = random.below(3) as u8;
        }
    }),
    ("the steps of another proof", |random, files, scenes| {
        let other = pick(random, scenes);
        let [own, theirs] = [&*files, other].map(|files| files.positions().steps);
        if let ([own, ..], [theirs, ..]) = (&own[..], &theirs[..]) {
            files.proof.truncate(own.start);
            files.proof.extend(&other.proof[theirs.start..]);
        }
    }),
    ("any byte of a proof", |random, files, _| {
        let at = random.below(files.proof.len());
        files.proof[at] = random.bits() as u8;
    }),
    (
        "the end of a file cut off, or a byte added",
        |random, files, _| {
            let side = random.below(2);
            let file = match random.below(3) {
                0 => &mut files.proof,
                1 => &mut files.meshes[side],
                _ => &mut files.trees[side],
            };
            if random.below(2) == 0 {
                file.truncate(random.below(file.len()));
            } else {
                file.push(random.below(4) as u8);
            }
        },
    ),
    ("a mesh alone", |random, files, _| {
        let side = random.below(2);
        flip(random, &mut files.meshes[side]);
    }),
    ("a vertex moved, with all digests", |random, files, _| {
        // Moves it by one unit in the last place, or by more.
        let side = random.below(2);
        let count = u32::from_le_bytes([0, 1, 2, 3].map(|k| files.meshes[side][k])) as usize;
        let at = 8 + VERTEX * random.below(count) + 8 * random.below(3);
        change_number_at(random, &mut files.meshes[side], at);
        renew_digests(files, side);
    }),
    (
        "a triangle changed or left out, with all digests",
        |random, files, _| {
            let side = random.below(2);
            let mesh = &mut files.meshes[side];
            let count = u32::from_le_bytes([0, 1, 2, 3].map(|k| mesh[k])) as usize;
            if random.below(2) == 0 {
                let corners = (mesh.len() - 8 - VERTEX * count) / 4;
                mesh[8 + VERTEX * count + 4 * random.below(corners)] = random.below(count) as u8;
            } else {
                mesh.truncate(mesh.len() - 12);
                mesh[4] -= 1;
            }
            renew_digests(files, side);
        },
    ),
    ("a part of a tree", |random, files, _| {
        let side = random.below(2);
        let tree = &mut files.trees[side];
        let [a, b] = [0, 1].map(|_| 40 + 4 * random.below((tree.len() - 40) / 4));
        let number = u32::from_le_bytes([0, 1, 2, 3].map(|k| tree[b + k]));
        let number = match random.below(3) {
            0 => number,
            1 => number + 1,
            _ => number.saturating_sub(1),
        };
        tree[a..a + 4].copy_from_slice(&number.to_le_bytes());
    }),
    ("two numbers of a tree exchanged", |random, files, _| {
        let side = random.below(2);
        let tree = &mut files.trees[side];
        let [a, b] = [0, 1].map(|_| 40 + 4 * random.below((tree.len() - 40) / 4));
        let number = tree[a..a + 4].to_vec();
        tree.copy_within(b..b + 4, a);
        tree[b..b + 4].copy_from_slice(&number);
    }),
];

/// Returns a random element.
fn pick<'a, T>(random: &mut Random, of: &'a [T]) -> &'a T {
    &of[random.below(of.len())]
}

/// Changes a random bit.
fn flip(random: &mut Random, bytes: &mut [u8]) {
    let at = random.below(bytes.len());
    bytes[at] ^= 1 << random.below(8);
}

/// Adds 1 to a random count, or subtracts 1.
fn add(random: &mut Random, counts: &mut [u8]) {
    let at = 4 * random.below(counts.len() / 4);
    counts[at] = counts[at].wrapping_add([1, 255][random.below(2)]);
}

/// Returns the steps whose opcodes are in a range.
fn steps_of(files: &Files, codes: std::ops::Range<u8>) -> Vec<std::ops::Range<usize>> {
    let mut steps = files.positions().steps;
    steps.retain(|step| codes.contains(&files.proof[step.start]));
    steps
}

/// Changes a number of a proof.
fn change_number(random: &mut Random, files: &mut Files, at: usize) {
    change_number_at(random, &mut files.proof, at);
}

/// Changes a number: in its last bit, by a small amount, in any bit, or to a special value.
fn change_number_at(random: &mut Random, bytes: &mut [u8], at: usize) {
    let number = f64::from_le_bytes([0, 1, 2, 3, 4, 5, 6, 7].map(|k| bytes[at + k]));
    let new = match random.below(8) {
        0 => number.next_up(),
        1 => number.next_down(),
        2..=4 => number + random.number() * 0.5f64.powi(random.below(40) as i32),
        5 => [f64::NAN, f64::INFINITY, 1e300, -0.0, 5e-324][random.below(5)],
        6 => -number,
        _ => f64::from_bits(number.to_bits() ^ 1 << random.below(64)),
    };
    bytes[at..at + 8].copy_from_slice(&new.to_le_bytes());
}

/// Writes the new digest of a changed mesh into the certificate of its tree and into the proof.
fn renew_digests(files: &mut Files, side: usize) {
    let old = files.trees[side][8..40].to_vec();
    let new = Sha256::digest(&files.meshes[side]);
    files.trees[side][8..40].copy_from_slice(&new);
    for at in files.positions().bodies {
        if files.proof[at..at + 32] == old {
            files.proof[at..at + 32].copy_from_slice(&new);
        }
    }
}
