//! Tests every peer on cases with exact answers, including cases that are known to fail.

use super::PeerKind;
use crate::method::Method;
use crate::method::solver::{ContactClaim, Reply, TimedReply};
use crate::method::wire::{format_query, parse_query};
use crate::names::name_of;
use crate::scene::model;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use clap::ValueEnum;
use rstest::rstest;
use std::f64::consts::{FRAC_PI_4, PI, SQRT_2};

const TOLERANCE: f64 = 1e-3;

/// Two meshes, a query, and the exact time of the first contact.
#[derive(Debug)]
struct ExactCase {
    a: TriangleMesh,
    b: TriangleMesh,
    query: Motions,
    contact_time: f64,
    /// The closing speed at the contact, in units of length per unit of time.
    closing_speed: f64,
}

impl ExactCase {
    fn reply_of_peer(&self, kind: PeerKind) -> Reply {
        let mut peer = kind.solver(&self.a, &self.b).unwrap();
        peer.answer(&self.query, TOLERANCE)
    }

    /// Asserts that a peer reports the contact time to within its allowed error.
    fn assert_contact_within_error(&self, kind: PeerKind) {
        let reply = self.reply_of_peer(kind);
        let ContactClaim::Contact { time } = reply.claim else {
            panic!("{}: {reply:?}", name_of(&kind));
        };
        let late = time - self.contact_time;
        let (early_by, late_by) = allowed_earliness_and_lateness(kind);
        assert!(
            (-early_by / self.closing_speed..=late_by).contains(&late),
            "{}: {late} late",
            name_of(&kind)
        );
    }
}

/// Returns how early, as a distance, and how late, as a time, a peer may report a contact.
fn allowed_earliness_and_lateness(kind: PeerKind) -> (f64, f64) {
    match kind {
        PeerKind::ParryF64 => (1e-9, 1e-9),
        // Sixteen roundings of coordinates between 8 and 16; the largest are 9.
        PeerKind::ParryF32 => (16.0 * f64::from(8.0 * f32::EPSILON), 1e-5),
        PeerKind::ParrySweepF32 => (1.01 * TOLERANCE, 1e-6),
        PeerKind::ParrySweepF64 | PeerKind::RapierStepF64 => (1.01 * TOLERANCE, 1e-12),
    }
}

fn cuboid(x: f64, y: f64, z: f64) -> TriangleMesh {
    model::cuboid(x, y, z).unwrap()
}

fn query(a: Motion, b: Motion) -> Motions {
    let id = String::new();
    let duration = 1.0;
    Motions { id, a, b, duration }
}

fn motion(at: DVec3, turned: DQuat, velocity: DVec3, spin: DVec3) -> Motion {
    Motion::new(Pose::new(at, turned).unwrap(), velocity, spin).unwrap()
}

/// Returns the case of a cube that falls flat onto a slab (T1 of `tests/it/scenes.rs`).
fn face_on_face() -> ExactCase {
    let falling = motion(
        3.0 * DVec3::Z,
        DQuat::IDENTITY,
        -4.0 * DVec3::Z,
        DVec3::ZERO,
    );
    let slab = motion(-DVec3::Z, DQuat::IDENTITY, DVec3::ZERO, DVec3::ZERO);
    ExactCase {
        a: cuboid(0.5, 0.5, 0.5),
        b: cuboid(9.0, 9.0, 1.0),
        query: query(falling, slab),
        contact_time: 0.625,
        closing_speed: 4.0,
    }
}

/// Returns the case of two cubes that meet with crossed edges (T8 of `tests/it/scenes.rs`).
fn edge_on_edge() -> ExactCase {
    let about = DQuat::from_axis_angle;
    let upper = motion(
        3.0 * DVec3::Z,
        about(DVec3::X, FRAC_PI_4),
        -4.0 * DVec3::Z,
        DVec3::ZERO,
    );
    let lower = motion(
        DVec3::ZERO,
        about(DVec3::Y, FRAC_PI_4),
        DVec3::ZERO,
        DVec3::ZERO,
    );
    ExactCase {
        a: cuboid(0.5, 0.5, 0.5),
        b: cuboid(0.5, 0.5, 0.5),
        query: query(upper, lower),
        contact_time: (3.0 - SQRT_2) / 4.0,
        closing_speed: 4.0,
    }
}

/// Returns the case of two balls that move towards each other and meet vertex on vertex.
fn ball_on_ball() -> ExactCase {
    let left = motion(
        -2.5 * DVec3::X,
        DQuat::IDENTITY,
        3.0 * DVec3::X,
        DVec3::ZERO,
    );
    let right = motion(2.5 * DVec3::X, DQuat::IDENTITY, -DVec3::X, DVec3::ZERO);
    ExactCase {
        a: ball(),
        b: ball(),
        query: query(left, right),
        contact_time: 0.75,
        closing_speed: 4.0,
    }
}

/// Returns the case of an upright rod that rotates by `turns` half circles and hits a wall with an edge (T4 of
/// `tests/it/scenes.rs`).
fn rod_on_wall(turns: f64) -> ExactCase {
    let (length, width, wall) = (2.0_f64, 0.05_f64, 1.2);
    let spin = turns * PI;
    let time = ((wall / length.hypot(width)).asin() - width.atan2(length)) / spin;
    let rod = motion(DVec3::ZERO, DQuat::IDENTITY, DVec3::ZERO, spin * DVec3::Y);
    let far = motion(
        (wall + 1.0) * DVec3::X,
        DQuat::IDENTITY,
        DVec3::ZERO,
        DVec3::ZERO,
    );
    ExactCase {
        a: cuboid(width, 0.3, length),
        b: cuboid(1.0, 9.0, 9.0),
        query: query(rod, far),
        contact_time: time,
        // The speed of the edge across the wall; the edge is at length · cos from the axis there.
        closing_speed: spin * (length.hypot(width).powi(2) - wall * wall).sqrt(),
    }
}

/// Returns a triangulated unit ball: an octahedron with each face divided into 16 triangles.
fn ball() -> TriangleMesh {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let mut triangles = Vec::new();
    for octant in 0..8 {
        let sign = |k: usize| if octant >> k & 1 == 1 { -1.0 } else { 1.0 };
        let [x, y, z] = [0, 1, 2].map(|k| sign(k) * axes[k]);
        let outward = sign(0) * sign(1) * sign(2) > 0.0;
        triangles.push(if outward { [x, y, z] } else { [x, z, y] });
    }
    for _ in 0..2 {
        triangles = triangles
            .into_iter()
            .flat_map(subdivide_spherical_triangle)
            .collect();
    }
    let faces: Vec<[u32; 3]> = (0..triangles.len() as u32)
        .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
        .collect();
    TriangleMesh::new(triangles.concat(), &faces).unwrap()
}

fn subdivide_spherical_triangle([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 4] {
    let middle = |p: DVec3, q: DVec3| (p + q).normalize();
    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

#[rstest]
fn straight_motions_are_right_with_every_peer(
    #[values(face_on_face(), edge_on_edge(), ball_on_ball())] exact: ExactCase,
) {
    for kind in PeerKind::value_variants().iter().copied() {
        exact.assert_contact_within_error(kind);
    }
}

#[rstest]
fn half_a_turn_is_right_except_with_rapier_steps(#[values(0.5, 1.0)] turns: f64) {
    for kind in PeerKind::value_variants().iter().copied() {
        if kind != PeerKind::RapierStepF64 {
            rod_on_wall(turns).assert_contact_within_error(kind);
        }
    }
}

#[rstest]
fn more_than_half_a_turn_is_right_with_sweeps(#[values(1.9, 2.0, 7.0)] turns: f64) {
    for kind in [PeerKind::ParrySweepF64, PeerKind::ParrySweepF32] {
        rod_on_wall(turns).assert_contact_within_error(kind);
    }
}

/// Tests a known error of parry's casts: with a whole turn or more, they report a contact later than the first. They
/// bisect a distance that is not monotone over the whole time.
#[rstest]
fn a_whole_turn_or_more_is_late_with_casts(#[values(2.0, 7.0)] turns: f64) {
    let exact = rod_on_wall(turns);
    for kind in [PeerKind::ParryF64, PeerKind::ParryF32] {
        let ContactClaim::Contact { time } = exact.reply_of_peer(kind).claim else {
            panic!("{}: no contact", name_of(&kind));
        };
        assert!(
            time - exact.contact_time > 0.1,
            "{}: {time}",
            name_of(&kind)
        );
    }
}

/// Tests two known errors of a rapier step: it reports a contact within half a turn late, and misses one within a whole
/// turn. It interpolates quaternions instead of rotating at a constant rate, and a whole turn counts as no rotation.
#[test]
fn large_turns_are_wrong_with_a_whole_step() {
    let half = rod_on_wall(1.0);
    let ContactClaim::Contact { time } = half.reply_of_peer(PeerKind::RapierStepF64).claim else {
        panic!("half a turn has no contact");
    };
    assert!(time - half.contact_time > 0.02, "{time}");
    let whole = rod_on_wall(2.0).reply_of_peer(PeerKind::RapierStepF64);
    assert_eq!(whole.claim, ContactClaim::NoContact);
}

#[test]
fn a_near_miss_is_free_with_every_peer() {
    let mut passing = face_on_face();
    let aside = Pose::new(DVec3::new(9.6, 0.0, 3.0), DQuat::IDENTITY).unwrap();
    passing.query.a = Motion::new(aside, -4.0 * DVec3::Z, DVec3::ZERO).unwrap();
    for kind in PeerKind::value_variants().iter().copied() {
        assert_eq!(
            passing.reply_of_peer(kind).claim,
            ContactClaim::NoContact,
            "{}",
            name_of(&kind)
        );
    }
}

#[test]
fn a_second_query_is_answered_as_the_first() {
    let exact = edge_on_edge();
    for kind in PeerKind::value_variants().iter().copied() {
        let mut peer = kind.solver(&exact.a, &exact.b).unwrap();
        let first = peer.answer(&exact.query, TOLERANCE);
        let mut other = exact.query.clone();
        other.a = motion(9.0 * DVec3::X, DQuat::IDENTITY, DVec3::ONE, DVec3::ONE);
        assert_eq!(
            peer.answer(&other, TOLERANCE).claim,
            ContactClaim::NoContact,
            "{}",
            name_of(&kind)
        );
        assert_eq!(
            peer.answer(&exact.query, TOLERANCE),
            first,
            "{}",
            name_of(&kind)
        );
    }
}

#[test]
fn a_body_at_rest_in_rapier_does_not_turn() {
    let mut exact = edge_on_edge();
    exact.query.b = motion(DVec3::ZERO, DQuat::IDENTITY, DVec3::ZERO, DVec3::X);
    assert_eq!(
        exact.reply_of_peer(PeerKind::RapierStepF64).claim,
        ContactClaim::Refused
    );
}

#[test]
fn tighter_tolerances_tighten_sweeps_alone() {
    let exact = ball_on_ball();
    for kind in PeerKind::value_variants().iter().copied() {
        let at = |tolerance| {
            let mut peer = kind.solver(&exact.a, &exact.b).unwrap();
            peer.answer(&exact.query, tolerance).claim
        };
        assert_eq!(
            at(1e-2) != at(1e-4),
            kind.takes_tolerance(),
            "{}",
            name_of(&kind)
        );
    }
}

#[test]
fn every_method_is_found_by_its_name() {
    for method in Method::known_methods() {
        assert_eq!(Method::from_name(&method.to_string()), Some(method));
    }
    assert_eq!(Method::from_name("unicorn"), None);
}

#[test]
fn queries_and_replies_survive_the_line() {
    let asked = rod_on_wall(1.0).query;
    assert_eq!(parse_query(&format_query(&asked)), Some(asked));
    for claim in [
        ContactClaim::Contact { time: 0.1 + 0.2 },
        ContactClaim::NoContact,
        ContactClaim::Unresolved { safe_until: 1e-300 },
    ] {
        let plain = Reply::new(claim, 7);
        let full = Reply {
            tolerance: Some(0.1 + 0.2),
            reason: Some("a, b and c".to_owned()),
            ..plain.clone()
        };
        for reply in [plain, full] {
            let timed = TimedReply { reply, micros: 1.5 };
            let line = serde_json::to_string(&timed).unwrap();
            assert_eq!(serde_json::from_str::<TimedReply>(&line).unwrap(), timed);
        }
    }
    for broken in ["", "1 2 3", "[[1, 2], [3], 4]"] {
        assert_eq!(parse_query(broken), None);
    }
}
