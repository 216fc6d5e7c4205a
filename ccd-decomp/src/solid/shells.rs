//! The connected parts of a closed surface, and whether the solid is on the inner side of each.

use super::error::DecomposeError;
use super::manifold::Manifold;
use crate::exact::triangles::crossing;
use crate::exact::volume::SignedVolume;
use crate::search::region::Region;
use crate::tolerance::RAY_TRIES;
use crate::work::Work;
use ccd_core::glam::DVec3;

/// Checks that the solid, which is where the winding number is not 0, is behind every face.
///
/// As faces only meet where they share an edge or vertex, it is enough to look at one point of every
/// shell: its other faces see the same of the rest.
///
/// # Errors
/// [`DecomposeError`]; [`TooLong`](DecomposeError::TooLong) when the work does not suffice to tell.
pub(crate) fn check_orientation(
    manifold: &Manifold<'_>,
    work: &Work,
) -> Result<(), DecomposeError> {
    let shell_of = shells(manifold);
    let count = shell_of.iter().max().map_or(0, |&last| last as usize + 1);
    let mut volumes = vec![SignedVolume::default(); count];
    let near = manifold.triangle(0)[0];
    for (face, &shell) in shell_of.iter().enumerate() {
        volumes[shell as usize].add(manifold.triangle(face as u32), near);
    }
    let mut faces_of = vec![Vec::new(); count];
    for (face, &shell) in shell_of.iter().enumerate() {
        faces_of[shell as usize].push(face as u32);
    }
    for (faces, volume) in faces_of.iter().zip(&volumes) {
        let face = manifold.mesh().face_ids()[faces[0] as usize];
        let Some(outward) = volume.is_positive() else {
            return Err(DecomposeError::NoVolume { face });
        };
        let around = match count {
            1 => Some(0),
            _ => winding_of_others(manifold, &shell_of, faces, work),
        };
        work.check()?;
        let Some(around) = around else {
            return Err(DecomposeError::Entangled { face });
        };
        // An outward shell adds 1 within it; behind the faces of an inward one is what surrounds it.
        let behind = if outward { around + 1 } else { around };
        if behind == 0 {
            return Err(DecomposeError::InsideOut { face });
        }
    }
    Ok(())
}

/// The number of the shell of every face; shells are connected over edges.
pub(crate) fn shells(manifold: &Manifold<'_>) -> Vec<u32> {
    const UNSEEN: u32 = u32::MAX;
    let mut shell_of = vec![UNSEEN; manifold.faces().len()];
    let mut count = 0;
    let mut stack = Vec::new();
    for seed in 0..shell_of.len() as u32 {
        if shell_of[seed as usize] != UNSEEN {
            continue;
        }
        shell_of[seed as usize] = count;
        stack.push(seed);
        // Each face is put there once.
        while let Some(face) = stack.pop() {
            for next in manifold.neighbours(face) {
                if shell_of[next as usize] == UNSEEN {
                    shell_of[next as usize] = count;
                    stack.push(next);
                }
            }
        }
        count += 1;
    }
    shell_of
}

/// How often the other shells wind about the faces of one; none when all rays graze something.
fn winding_of_others(
    manifold: &Manifold<'_>,
    shell_of: &[u32],
    faces: &[u32],
    work: &Work,
) -> Option<i32> {
    let shell = shell_of[faces[0] as usize];
    let near = manifold.triangle(faces[0])[0];
    let size = manifold.boxes().reach(near);
    (0..RAY_TRIES).find_map(|k| {
        // Shells may touch at a corner, so that it is another one each time.
        let from = manifold.triangle(faces[k % faces.len()])[k % 3];
        // Nearly along an axis, so that few boxes meet the ray's, and in no special relation to any.
        let (along, tilt) = (DVec3::AXES[k % 3], 1e-3 * (1.0 + 0.618 * k as f64));
        let across = DVec3::new(0.7548, 0.5698, -0.3247) * tilt;
        let to = from + 3.0 * size * (along + across);
        let mut windings = Some(0);
        manifold
            .boxes()
            .all_meeting(&Region::segment([from, to]), work, |f| {
                if shell_of[f as usize] != shell {
                    let crossing = crossing([from, to], manifold.triangle(f));
                    windings = windings.zip(crossing).map(|(sum, one)| sum + one);
                }
                windings.is_some()
            });
        windings
    })
}

#[cfg(test)]
mod tests;
