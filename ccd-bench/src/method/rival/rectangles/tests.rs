use super::shortest_vector;
use crate::method::rival::Placement;
use crate::method::rival::triangles_apart::nearest_points;
use ccd_core::glam::{DMat3, DQuat, DVec2, DVec3};
use ccd_core::order::{greater, lesser};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::FRAC_PI_2;

fn random_vec(rng: &mut Pcg64, size: f64) -> DVec3 {
    size * DVec3::from_array([0; 3].map(|_| rng.random_range(-1.0..1.0)))
}

/// Returns two random rectangles, and the placement of the second in the first one's frame. A side may be zero, and a
/// turn may be a multiple of a right angle, exactly or nearly.
fn random_rectangle_pair(rng: &mut Pcg64) -> (DVec2, DVec2, Placement) {
    let mut lengths = || {
        DVec2::from_array([0, 1].map(|_| match rng.random_range(0..6) {
            0 => 0.0,
            _ => rng.random_range(0.0..2.0),
        }))
    };
    let (a, b) = (lengths(), lengths());
    let right = |rng: &mut Pcg64| FRAC_PI_2 * f64::from(rng.random_range(0..4));
    let turn = match rng.random_range(0..4) {
        0 => {
            let little = [0.0, 1e-12, 1e-8, 1e-4][rng.random_range(0..4)] * random_vec(rng, 1.0);
            DQuat::from_scaled_axis(little)
                * DQuat::from_rotation_x(right(rng))
                * DQuat::from_rotation_z(right(rng))
        }
        _ => DQuat::from_scaled_axis(random_vec(rng, 3.0)),
    };
    let placement = Placement {
        rotation: DMat3::from_quat(turn),
        translation: random_vec(rng, 1.0),
    };
    (a, b, placement)
}

fn corners(lengths: DVec2, placement: &Placement) -> [DVec3; 4] {
    [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]
        .map(|(x, y)| placement.apply(DVec3::new(x * lengths.x, y * lengths.y, 0.0)))
}

const IDENTITY_PLACEMENT: Placement = Placement {
    rotation: DMat3::IDENTITY,
    translation: DVec3::ZERO,
};

/// Returns the distance of two rectangles, computed with each rectangle as two triangles.
fn distance_by_triangles(a: DVec2, b: DVec2, placement: &Placement) -> f64 {
    let halves = |[p, q, r, s]: [DVec3; 4]| [[p, q, r], [q, r, s]];
    let mut least = f64::INFINITY;
    for half_a in halves(corners(a, &IDENTITY_PLACEMENT)) {
        for half_b in halves(corners(b, placement)) {
            least = lesser(
                least,
                nearest_points(&half_a, &half_b)
                    .vector_from_a_to_b()
                    .length(),
            );
        }
    }
    least
}

/// Returns the distance of two rectangles, computed by coordinate descent over the coordinates of one point in each.
fn distance_by_coordinate_descent(a: DVec2, b: DVec2, placement: &Placement) -> f64 {
    let axes = [
        DVec3::X,
        DVec3::Y,
        placement.rotation.x_axis,
        placement.rotation.y_axis,
    ];
    let signs = [-1.0, -1.0, 1.0, 1.0];
    let longest = [a.x, a.y, b.x, b.y];
    let mut at = [0.5 * a.x, 0.5 * a.y, 0.5 * b.x, 0.5 * b.y];
    let vector = |at: &[f64; 4]| {
        (0..4).fold(placement.translation, |sum, k| {
            sum + signs[k] * at[k] * axes[k]
        })
    };
    for _ in 0..20_000 {
        let before = at;
        for k in 0..4 {
            let off = signs[k] * vector(&at).dot(axes[k]);
            at[k] = (at[k] - off).clamp(0.0, longest[k]);
        }
        if before == at {
            break;
        }
    }
    vector(&at).length()
}

#[test]
fn the_vector_is_the_shortest() {
    let mut rng = Pcg64::seed_from_u64(1);
    let (mut apart, mut meeting) = (0, 0);
    for _ in 0..6_000 {
        let (a, b, placement) = random_rectangle_pair(&mut rng);
        let vector = shortest_vector(a, b, &placement);
        let distance = vector.length();
        let twin = distance_by_triangles(a, b, &placement);
        assert!(
            (distance - twin).abs() < 1e-9,
            "{distance} {twin} {a} {b} {placement:?}"
        );
        // This converges slowly if edges are nearly parallel.
        let twin = distance_by_coordinate_descent(a, b, &placement);
        assert!(
            distance < twin + 1e-12,
            "{distance} {twin} {a} {b} {placement:?}"
        );
        assert!(
            twin < distance + 1e-3,
            "{distance} {twin} {a} {b} {placement:?}"
        );
        if distance > 1e-6 {
            // No plane could separate them by more than their distance, so this proves the distance.
            let n = vector / distance;
            let low = corners(b, &placement)
                .map(|p| n.dot(p))
                .into_iter()
                .fold(f64::INFINITY, lesser);
            let high = corners(a, &IDENTITY_PLACEMENT)
                .map(|p| n.dot(p))
                .into_iter()
                .fold(f64::NEG_INFINITY, greater);
            assert!(
                low - high > distance - 1e-9,
                "{distance} {} {a} {b} {placement:?}",
                low - high
            );
            apart += 1;
        } else {
            meeting += 1;
        }
    }
    assert!(
        apart > 3_000 && meeting > 150,
        "{apart} apart, {meeting} meeting"
    );
}

#[test]
fn a_crossing_inside_both_is_a_meeting() {
    let placement = Placement {
        rotation: DMat3::from_rotation_x(FRAC_PI_2),
        translation: DVec3::new(0.4, 0.5, -0.3),
    };
    let cross = shortest_vector(DVec2::ONE, DVec2::new(0.2, 1.0), &placement);
    assert_eq!(cross, DVec3::ZERO);
}

#[test]
fn invalid_numbers_give_no_distance() {
    let placement = Placement {
        rotation: DMat3::IDENTITY,
        translation: DVec3::splat(f64::NAN),
    };
    assert_eq!(
        shortest_vector(DVec2::ONE, DVec2::ONE, &placement),
        DVec3::ZERO
    );
}
