//! Makes a failure small: the fewest triangles and round numbers that still fail.

use super::attempt::{Attempt, complexity};
use std::io;

/// The significant digits to which numbers are rounded, the fewest first.
const DIGITS: [usize; 6] = [0, 1, 2, 3, 5, 8];

/// Makes an attempt smaller in all ways, as long as it still fails, but no face flat that is not. Ends at one that no single step makes
/// smaller, or after a number of tries.
///
/// # Errors
/// Those of `fails`.
pub(super) fn shrink(
    attempt: Attempt,
    mut tries: usize,
    mut fails: impl FnMut(&Attempt) -> io::Result<bool>,
) -> io::Result<Attempt> {
    let mut best = attempt;
    // The numbers may get longer by this, and are rounded after it.
    for seen in [Attempt::seen_from_b, Attempt::unturned] {
        let next = seen(&best);
        if fails(&next)? {
            best = next;
        }
    }
    loop {
        let size = (best.triangles(), best.complexity());
        for step in [without_faces, with_corners_joined, with_round_numbers] {
            for smaller in step(&best) {
                if tries == 0 {
                    return Ok(best);
                }
                // A step may have been overtaken by an earlier one.
                let Some(next) = smaller.of(&best) else {
                    continue;
                };
                if next.flat_faces() > best.flat_faces() {
                    continue;
                }
                tries -= 1;
                if fails(&next)? {
                    best = next;
                }
            }
        }
        if (best.triangles(), best.complexity()) >= size {
            return Ok(best);
        }
    }
}

/// A way to make an attempt smaller.
#[derive(Clone, Copy, Debug)]
enum Smaller {
    /// Without a run of faces of a body.
    Faces {
        body: usize,
        from: usize,
        count: usize,
    },
    /// With one corner in place of another, of a body.
    Corner { body: usize, from: u32, to: u32 },
    /// With a number rounded to that many digits.
    Number { at: usize, digits: usize },
    /// With a number replaced by another.
    Equal { at: usize, to: f64 },
}

impl Smaller {
    /// Returns the smaller attempt, or `None` if it would not be smaller.
    fn of(self, attempt: &Attempt) -> Option<Attempt> {
        let mut next = attempt.clone();
        match self {
            Smaller::Faces { body, from, count } => {
                let body = &mut next.bodies[body];
                let end = from + count;
                if count >= body.faces.len() || end > body.faces.len() {
                    return None;
                }
                body.faces.drain(from..end);
                body.compact();
            }
            Smaller::Corner { body, from, to } => {
                let body = &mut next.bodies[body];
                let known = body.vertices.len() as u32;
                if from >= known || to >= known {
                    return None;
                }
                for corner in body.faces.iter_mut().flatten() {
                    if *corner == from {
                        *corner = to;
                    }
                }
                body.faces.retain(|[p, q, r]| p != q && q != r && r != p);
                body.compact();
                if body.faces.is_empty() {
                    return None;
                }
            }
            Smaller::Number { at, digits } => {
                let mut numbers = next.numbers();
                let number = numbers.get_mut(at)?;
                let round = rounded(**number, digits)?;
                if complexity(round) >= complexity(**number) {
                    return None;
                }
                **number = round;
            }
            Smaller::Equal { at, to } => {
                let mut numbers = next.numbers();
                let number = numbers.get_mut(at)?;
                if complexity(to) >= complexity(**number) {
                    return None;
                }
                **number = to;
            }
        }
        (next != *attempt).then_some(next)
    }
}

/// Removes faces: many at once first, the last ones first.
fn without_faces(attempt: &Attempt) -> Vec<Smaller> {
    let mut steps = Vec::new();
    for (body, count) in attempt.bodies.iter().map(|b| b.faces.len()).enumerate() {
        let mut run = count / 2;
        while run > 0 {
            let starts = (0..count.div_ceil(run)).rev().map(|k| k * run);
            steps.extend(starts.map(|from| Smaller::Faces {
                body,
                from,
                count: run,
            }));
            run /= 2;
        }
    }
    steps
}

/// Joins corners along the edges.
fn with_corners_joined(attempt: &Attempt) -> Vec<Smaller> {
    let mut steps = Vec::new();
    for (body, faces) in attempt.bodies.iter().map(|b| &b.faces).enumerate() {
        let edges = faces.iter().flat_map(|&[p, q, r]| [[p, q], [q, r], [r, p]]);
        steps.extend(edges.map(|[from, to]| Smaller::Corner { body, from, to }));
    }
    steps
}

/// Rounds each number, to few digits first.
fn with_round_numbers(attempt: &Attempt) -> Vec<Smaller> {
    let count = attempt.clone().numbers().len();
    let of_number = |at| {
        let equal = [0.0, 1.0, -1.0].map(|to| Smaller::Equal { at, to });
        let rounded = DIGITS.map(|digits| Smaller::Number { at, digits });
        equal.into_iter().chain(rounded)
    };
    (0..count).flat_map(of_number).collect()
}

/// Rounds a number to some digits after its first one.
fn rounded(x: f64, digits: usize) -> Option<f64> {
    format!("{x:.digits$e}").parse().ok()
}
