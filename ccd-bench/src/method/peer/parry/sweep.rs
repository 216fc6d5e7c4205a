//! Swept triangles: `query::sweep_time_of_impact` over the pairs of triangles that may meet.
//!
//! The library sweeps convex bodies from one pose to another. Its own composition for composites
//! holds the composite still. Here both bodies may move, so the same composition is made again,
//! over the library's hierarchies of both meshes. Boxes swept from start to end lead to pairs of
//! triangles. Each pair is swept until the earliest hit so far. Every earlier hit counts, whether
//! its status is `Hit` or `Failed`, as in the library and in the physics engine on top of it.
//!
//! Its sweeps interpolate two quaternions by a normalised mix, the shorter way, which does not turn
//! at a constant rate. A motion is therefore cut into segments of equal length. A segment is short
//! enough for the mix to stay within a quarter of the tolerance of the motion, and for no body to
//! travel far beyond the size of the smaller one, which keeps swept boxes small. Unlike in the
//! library's own composition, boxes are widened by the bulge of the arcs.
//!
//! # Tolerance
//! It reports a hit at a gap of at most 1.25 times its `linear_slop`, which is set so that this is
//! the tolerance.
//!
//! # Guarantee
//! None. The root finder may miss roots that lie between two poses. It gives up after 25 axes and
//! then returns the last time that it considers safe, which is taken for a contact.

use super::library::bounding_volume::{Aabb, BoundingVolume};
use super::library::math::{Pose, Real};
use super::library::query::sweep_toi::{Sweep, SweepToiStatus, ToiProxy, sweep_time_of_impact};
use super::library::shape::TriMesh;
use super::shapes::{pose_at, to_parry_vector, to_tri_mesh};
use crate::method::peer::contact_claim_at;
use crate::method::solver::{ContactClaim, Reply, Solver};
use anyhow::Result;
use ccd_core::Motion;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use std::f64::consts::FRAC_PI_4;

/// Two meshes whose triangles are swept against each other. Steps are the segments examined.
#[derive(Clone, Debug)]
pub struct SweptMeshPair {
    a: MeshWithAabb,
    b: MeshWithAabb,
}

/// The largest distance at which a hit is reported, as a multiple of the library's `linear_slop`.
const MAX_HIT_DISTANCE_IN_SLOPS: f64 = 1.25;
/// The largest error due to the interpolation of rotations within a segment, as a fraction of the tolerance.
const ROTATION_ERROR_FRACTION: f64 = 0.25;
/// The largest rotation, in radians, for which the library's documentation calls its sweeps a good approximation.
const MAX_SWEEP_ROTATION: f64 = FRAC_PI_4;
/// The largest displacement of one body relative to the other in a segment, as a multiple of the smaller body's radius.
const MAX_RELATIVE_TRAVEL: f64 = 0.5;
/// The maximum number of segments of a motion; queries that need more are unresolved.
const MAX_SEGMENT_COUNT: f64 = 65_536.0;

impl SweptMeshPair {
    /// Converts two meshes, with their bounding boxes.
    ///
    /// # Errors
    /// If the library refuses a mesh.
    pub fn new(a: &TriangleMesh, b: &TriangleMesh) -> Result<Self> {
        Ok(SweptMeshPair {
            a: MeshWithAabb::new(a)?,
            b: MeshWithAabb::new(b)?,
        })
    }

    /// Returns the number of segments that a query is cut into; `None` if there are too many.
    fn segment_count(&self, query: &Motions, tolerance: f64) -> Option<u64> {
        let bodies = [(&self.a, &query.a), (&self.b, &query.b)];
        let turns = bodies.map(|(body, motion)| {
            let turn = motion.angular_velocity().length() * query.duration;
            turn / max_segment_rotation(body.radius_bound_about_center(motion), tolerance)
        });
        let speed = (query.a.velocity() - query.b.velocity()).length();
        let travel = speed * query.duration
            / (MAX_RELATIVE_TRAVEL * lesser(self.a.aabb_half_diagonal, self.b.aabb_half_diagonal));
        let count = greater(1.0, turns.into_iter().fold(travel, greater).ceil());
        (count <= MAX_SEGMENT_COUNT).then_some(count as u64)
    }

    /// Returns the first time in a segment at which triangles meet, as a fraction of the segment; `None` if none meet.
    fn first_hit_fraction(
        &self,
        query: &Motions,
        tolerance: f64,
        [from, to]: [f64; 2],
    ) -> Option<Real> {
        let a = self.a.segment_motion(&query.a, from, to);
        let b = self.b.segment_motion(&query.b, from, to);
        // Boxes are compared in B's frame at the start, where B needs no second box when it is at rest.
        let frame = b.poses[0].inverse();
        let (in_frame_a, in_frame_b) = (a.poses.map(|p| frame * p), b.poses.map(|p| frame * p));
        let still = b.poses[0] == b.poses[1];
        let slack = a.path_deviation_bound + b.path_deviation_bound + tolerance as Real;
        let swept_a = |aabb: Aabb| box_around_both_poses(&aabb, &in_frame_a).loosened(slack);
        let swept_b = |aabb: Aabb| {
            if still {
                aabb
            } else {
                box_around_both_poses(&aabb, &in_frame_b)
            }
        };
        let pairs = self
            .a
            .mesh
            .bvh()
            .leaf_pairs(self.b.mesh.bvh(), |node_a, node_b| {
                swept_a(node_a.aabb()).intersects(&swept_b(node_b.aabb()))
            });
        let slop = (tolerance / MAX_HIT_DISTANCE_IN_SLOPS) as Real;
        let mut first = None;
        for (i, j) in pairs {
            let before = first.unwrap_or(1.0);
            let (p, q) = (self.a.triangle_proxy(i), self.b.triangle_proxy(j));
            let hit = sweep_time_of_impact(&p, &a.sweep, &q, &b.sweep, before, slop);
            if hit.status != SweepToiStatus::Separated && hit.fraction <= before {
                first = Some(hit.fraction);
            }
        }
        first
    }
}

impl Solver for SweptMeshPair {
    fn answer(&mut self, query: &Motions, tolerance: f64) -> Reply {
        let Some(count) = self.segment_count(query, tolerance) else {
            let claim = ContactClaim::Unresolved { safe_until: 0.0 };
            return Reply::new(claim, 0);
        };
        let time = |k: u64| query.duration * (k as f64 / count as f64);
        for k in 0..count {
            let (from, to) = (time(k), time(k + 1));
            if let Some(fraction) = self.first_hit_fraction(query, tolerance, [from, to]) {
                let time = from + f64::from(fraction) * (to - from);
                let claim = contact_claim_at(time, query.duration);
                return Reply::new(claim, k + 1);
            }
        }
        Reply::new(ContactClaim::NoContact, count)
    }
}

/// A mesh with its bounding box and the box's radius, in the body's frame.
#[derive(Clone, Debug)]
struct MeshWithAabb {
    mesh: TriMesh,
    /// The lowest and the highest corner of the box.
    aabb_corners: [DVec3; 2],
    aabb_half_diagonal: f64,
}

/// The motion of a body over a segment of time.
struct SegmentMotion {
    poses: [Pose; 2],
    sweep: Sweep,
    /// An upper bound of how far any point of the body leaves the straight line from its start to its end position.
    path_deviation_bound: Real,
}

impl MeshWithAabb {
    fn new(mesh: &TriangleMesh) -> Result<Self> {
        let corners = mesh.bounding_box();
        Ok(MeshWithAabb {
            mesh: to_tri_mesh(mesh)?,
            aabb_corners: corners,
            aabb_half_diagonal: 0.5 * (corners[1] - corners[0]).length(),
        })
    }

    /// Returns an upper bound of the distance of the mesh's points from the motion's center of rotation.
    fn radius_bound_about_center(&self, motion: &Motion) -> f64 {
        let [low, high] = self.aabb_corners.map(|c| (c - motion.center()).abs());
        low.max(high).length()
    }

    fn segment_motion(&self, motion: &Motion, from: f64, to: f64) -> SegmentMotion {
        let poses = [pose_at(motion, from), pose_at(motion, to)];
        let turn = motion.angular_velocity().length() * (to - from);
        SegmentMotion {
            sweep: Sweep::from_poses(&poses[0], &poses[1], to_parry_vector(motion.center())),
            poses,
            // Half of the bound on the second derivative, ρ θ²/8, is for a constant rate. The interpolation
            // adds less than that.
            path_deviation_bound: (0.25 * self.radius_bound_about_center(motion) * turn * turn)
                as Real,
        }
    }

    fn triangle_proxy(&self, triangle: u32) -> ToiProxy<'static> {
        let t = self.mesh.triangle(triangle);
        ToiProxy::from_array([t.a, t.b, t.c], 0.0)
    }
}

/// Returns the largest rotation per segment, in radians, at which the interpolation error stays within its fraction of the
/// tolerance.
fn max_segment_rotation(reach: f64, tolerance: f64) -> f64 {
    // The mix misses a turn θ by 2 (atan(s tan(θ/4)) − s θ/4) for s of −1 to 1, which is at most
    // 4/(9 √3) (θ/4)³ to leading order; the next term of tan adds less than a tenth up to π/4.
    let off = ROTATION_ERROR_FRACTION * tolerance / (0.2567 * 1.1 * reach);
    lesser(MAX_SWEEP_ROTATION, 4.0 * off.cbrt())
}

/// Returns the smallest axis-aligned box that contains the given box at both poses.
fn box_around_both_poses(aabb: &Aabb, poses: &[Pose; 2]) -> Aabb {
    aabb.transform_by(&poses[0])
        .merged(&aabb.transform_by(&poses[1]))
}
