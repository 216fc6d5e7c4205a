//! Tests a statement with poses at sampled times, in binary64, with the distances of another library.

use crate::files::Files;
use ccd_core::glam::{DQuat, DVec3, DVec4};
use ccd_core::order::{greater, lesser};
use ccd_prove::{Statement, StatementLink, StatementWitness};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::distance;
use parry3d_f64::shape::Triangle;
use sha2::{Digest, Sha256};

/// The number of sampled times.
const SAMPLES: u32 = 64;

/// The error bound of a distance between corners that are nearer than `FAR` to the origin.
const ROUNDING: f64 = 1e-9;
const FAR: f64 = 1e6;

/// Returns false if a sample refutes the statement. A file that cannot be read states nothing, and counts as true.
pub(crate) fn is_true(files: &Files) -> bool {
    Statement::read(&files.proof).is_none_or(|statement| {
        let scene = Scene {
            meshes: [0, 1].map(|k| {
                let digest = Sha256::digest(&files.meshes[k]).into();
                (digest, triangles(&files.meshes[k], &files.trees[k]))
            }),
            statement,
        };
        scene.stay_apart() && scene.witness_is_near()
    })
}

/// The corners of a triangle. Each has x, y, z and its radius.
type Corners = [DVec4; 3];

struct Scene {
    /// The digest of each mesh, and its triangles in the order of its tree, if the files can be read.
    meshes: [([u8; 32], Option<Vec<Corners>>); 2],
    statement: Statement,
}

impl Scene {
    fn stay_apart(&self) -> bool {
        let until = self.statement.until;
        (0..=SAMPLES).all(|k| {
            let time = until * f64::from(k) / f64::from(SAMPLES);
            let bodies_at_time: Vec<_> = (0..self.statement.bodies.len())
                .map(|body| self.body(body, time))
                .collect();
            self.statement.pairs.iter().all(|&(bodies, margin)| {
                let [a, b] = bodies.map(|body| bodies_at_time.get(body as usize)?.as_ref());
                let (Some(a), Some(b)) = (a, b) else {
                    return true;
                };
                let least = margin - ROUNDING;
                balls_are_apart(a.as_flattened(), b.as_flattened(), least)
                    || a.iter().all(|a| b.iter().all(|b| are_apart(a, b, least)))
            })
        })
    }

    fn witness_is_near(&self) -> bool {
        let Some(StatementWitness {
            pair,
            time,
            tolerance,
            points,
        }) = &self.statement.witness
        else {
            return true;
        };
        let Some(&(bodies, margin)) = self.statement.pairs.get(*pair as usize) else {
            return true;
        };
        let point = |k: usize| {
            let triangles = self.body(bodies[k] as usize, *time)?;
            let (index, weights) = points[k];
            let corners = triangles.get(index as usize)?;
            let [a, b, c] = weights.map(|weight| weight as f64 / (1u64 << 55) as f64);
            Some(corners[0] * a + corners[1] * b + corners[2] * c)
        };
        let (Some(a), Some(b)) = (point(0), point(1)) else {
            return true;
        };
        let distance = a.truncate().distance(b.truncate());
        !(distance > margin + a.w + b.w + tolerance + ROUNDING)
    }

    /// Returns the triangles of a body in the world at a time. Returns `None` if there is no such body.
    fn body(&self, number: usize, time: f64) -> Option<Vec<Corners>> {
        let &(digest, link) = self.statement.bodies.get(number)?;
        let (_, triangles) = self.meshes.iter().find(|(own, _)| *own == digest)?;
        let mut triangles = triangles.clone()?;
        let mut link = link as usize;
        // Each parent is an earlier link, so the loop ends at the world.
        for _ in 0..=self.statement.links.len() {
            if link == 0 {
                return Some(triangles);
            }
            let statement_link = self.statement.links.get(link - 1)?;
            for corner in triangles.iter_mut().flatten() {
                let moved = on_parent(statement_link, corner.truncate(), time);
                *corner = moved.extend(corner.w);
            }
            link = statement_link.parent as usize;
        }
        None
    }
}

/// Transforms a point of a link to the frame of the parent.
fn on_parent(link: &StatementLink, point: DVec3, time: f64) -> DVec3 {
    let [position, center, velocity, axis] =
        [link.position, link.center, link.velocity, link.axis].map(DVec3::from_array);
    let start = DQuat::from_array(link.quaternion).normalize();
    let by = link.start + time * link.rate;
    if link.axes == 1 {
        // The velocity and the axis are in the frame of the joint, so its rotation is applied last.
        let arm = DQuat::from_scaled_axis(axis * by) * (point - center);
        return position + start * (center + velocity * by + arm);
    }
    let arm = DQuat::from_scaled_axis(axis * by) * (start * (point - center));
    position + start * center + velocity * by + arm
}

/// Returns false if two triangles are nearer than `least`. Corners outside the range, and NaN, count as apart.
fn are_apart(a: &Corners, b: &Corners, least: f64) -> bool {
    // Farther away, rounding in binary64 exceeds the allowance.
    let is_in_range = a
        .iter()
        .chain(b)
        .all(|corner| corner.abs().max_element() < FAR);
    if !is_in_range || balls_are_apart(a, b, least) {
        return true;
    }
    let shape = |t: &Corners| {
        let [a, b, c] = t.map(|v| Vector::new(v.x, v.y, v.z));
        Triangle::new(a, b, c)
    };
    // A triangle with different radii is tested with its least radius, and its corners with their own radii.
    let radius = |t: &Corners| t.iter().map(|corner| corner.w).fold(f64::INFINITY, lesser);
    let here = Pose::IDENTITY;
    let found = distance(&here, &shape(a), &here, &shape(b));
    let least_of_flat = least + radius(a) + radius(b);
    let corners_are_apart = a.iter().all(|a| {
        let is_apart = |b: &DVec4| !(a.truncate().distance(b.truncate()) - a.w - b.w < least);
        b.iter().all(is_apart)
    });
    !found.is_ok_and(|found| found.distance < least_of_flat) && corners_are_apart
}

/// Returns whether the bounding balls of two sets of balls are farther apart than `least`.
fn balls_are_apart(a: &[DVec4], b: &[DVec4], least: f64) -> bool {
    let [(a, reach_a), (b, reach_b)] = [a, b].map(|points| {
        let middle =
            points.iter().map(|point| point.truncate()).sum::<DVec3>() / points.len() as f64;
        let reach = points
            .iter()
            .map(|point| point.truncate().distance(middle) + point.w);
        (middle, reach.fold(0.0, greater))
    });
    a.distance(b) - reach_a - reach_b > least
}

/// Reads the triangles of a mesh in the order of a tree.
fn triangles(mesh: &[u8], tree: &[u8]) -> Option<Vec<Corners>> {
    let index = |file: &[u8], at: usize| -> Option<usize> {
        let bytes = file.get(at..at + 4)?.try_into().ok()?;
        Some(u32::from_le_bytes(bytes) as usize)
    };
    let number = |at: usize| -> Option<f64> {
        Some(f64::from_le_bytes(mesh.get(at..at + 8)?.try_into().ok()?))
    };
    let [vertices, triangles] = [index(mesh, 0)?, index(mesh, 4)?];
    let corner = |at: usize| -> Option<DVec4> {
        let vertex = 8 + 32 * index(mesh, at)?;
        let [x, y, z, radius] = [0, 8, 16, 24].map(|k| number(vertex + k));
        Some(DVec4::new(x?, y?, z?, radius?))
    };
    let triangle = |number: usize| -> Option<Corners> {
        let at = 8 + 32 * vertices + 12 * number;
        Some([corner(at)?, corner(at + 4)?, corner(at + 8)?])
    };
    // The number of triangles of each part that is not read yet.
    let (mut parts, mut ordered) = (vec![triangles.min(mesh.len())], Vec::new());
    for at in (40..).step_by(4) {
        let Some(count) = parts.pop() else { break };
        let number = index(tree, at)?;
        if count == 1 {
            ordered.push(triangle(number)?);
        } else {
            parts.extend([count.checked_sub(number)?, number]);
        }
    }
    Some(ordered)
}
