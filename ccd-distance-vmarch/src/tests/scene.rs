//! Draws random pairs of polytopes of the kinds that are hard for Voronoi marching.

use super::shape::{self, Pcg64, RngExt, Shape, random_direction, random_magnitude, random_vector};
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::{Frame, PiecePair, Pieces};

/// A shape, and the list of pieces that has this shape as its only piece.
pub(crate) struct Body {
    pub(crate) shape: Shape,
    pub(crate) pieces: Pieces,
    /// The mean of the corners: a point well inside the shape.
    middle: DVec3,
}

impl Body {
    pub(crate) fn new(shape: Shape) -> Self {
        let middle = shape.points.iter().sum::<DVec3>() / shape.points.len() as f64;
        Body {
            pieces: shape.pieces(),
            shape,
            middle,
        }
    }
}

/// The kinds of pairs from which tests draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PairKind {
    Random,
    NearParallel,
    Coplanar,
    Sliver,
    Grid,
    Plates,
    Prisms,
    Balls,
    FewPoints,
    Flat,
}

/// Draws the bodies from which pairs of a kind are made.
pub(crate) fn body_pool(kind: PairKind, rng: &mut Pcg64) -> Vec<Body> {
    let shapes = match kind {
        PairKind::Random => hulls(rng, &[4, 4, 5, 6, 8, 8, 10, 12, 16, 20, 20, 24]),
        PairKind::NearParallel | PairKind::Coplanar => shapes_with_faces(rng),
        PairKind::Sliver => slivers(rng),
        PairKind::Grid => grid_shapes(rng),
        PairKind::Plates => plates(rng),
        PairKind::Prisms => {
            let prisms = [3, 5, 8, 16, 40, 100].map(shape::prism).into_iter();
            let antiprisms = [3, 7, 24].map(shape::antiprism);
            let bipyramids = [3, 9, 40].map(shape::bipyramid);
            prisms.chain(antiprisms).chain(bipyramids).collect()
        }
        PairKind::Balls => {
            let sizes = [(3, 5), (6, 9), (9, 16), (19, 26), (31, 32)];
            let mut out = sizes
                .map(|(rings, count)| shape::uv_sphere(rings, count))
                .to_vec();
            out.push(shape::uv_sphere(9, 16).triangulated());
            out.extend(hulls(rng, &[40]));
            out
        }
        PairKind::FewPoints => few_point_shapes(rng),
        PairKind::Flat => {
            let mut out = [3, 4, 6, 12, 40].map(shape::polygon).to_vec();
            out.push(shape::polygon(8).triangulated());
            out.push(shape::polygon(5).with_mapped_points(|p| p * DVec3::new(1.0, 1e-5, 1.0)));
            out.extend(hulls(rng, &[8]));
            out
        }
    };
    // Most pieces have separate frames; some kinds lose their special property if they are turned.
    let kept = matches!(kind, PairKind::Grid | PairKind::Coplanar | PairKind::Sliver);
    let placed = shapes.into_iter().map(|shape| {
        let (turn, shift) = (random_rotation(rng), random_vector(rng));
        let placed = |p| if kept { p } else { turn * p + shift };
        Body::new(shape.with_mapped_points(placed))
    });
    placed.collect()
}

fn hulls(rng: &mut Pcg64, counts: &[usize]) -> Vec<Shape> {
    let hull = |&count: &usize| shape::random_hull(rng, count);
    counts.iter().map(hull).collect()
}

fn shapes_with_faces(rng: &mut Pcg64) -> Vec<Shape> {
    let mut out = vec![shape::cuboid(DVec3::ONE)];
    out.push(shape::cuboid(DVec3::new(0.4, 0.7, 1.1)).triangulated());
    out.extend([3, 4, 5, 6, 8, 12].map(shape::prism));
    out.extend([3, 4, 6].map(shape::antiprism));
    out.extend([4, 6].map(shape::bipyramid));
    out.extend((0..6).map(|_| shape::grid_hull(rng, 9)));
    out
}

fn slivers(rng: &mut Pcg64) -> Vec<Shape> {
    let mut out = [6, 10, 20].map(shape::cyclic_polytope).to_vec();
    for count in [4, 5, 6, 8, 12] {
        for _ in 0..4 {
            let mut thin = || random_magnitude(rng, -8.0, 0.0);
            let squeeze = DVec3::new(1.0, thin(), thin());
            let points: Vec<DVec3> = (0..count)
                .map(|_| squeeze * random_direction(rng))
                .collect();
            out.push(shape::hull(&points));
        }
    }
    out
}

fn grid_shapes(rng: &mut Pcg64) -> Vec<Shape> {
    let mut out = vec![shape::cuboid(DVec3::ONE)];
    out.push(shape::cuboid(DVec3::new(1.0, 2.0, 3.0)));
    for count in [5, 6, 8, 12, 16, 20] {
        out.push(shape::grid_hull(rng, count));
        out.push(shape::grid_hull(rng, count).triangulated());
    }
    out
}

fn plates(rng: &mut Pcg64) -> Vec<Shape> {
    let mut out = Vec::new();
    for _ in 0..6 {
        let thin = random_magnitude(rng, -9.0, -2.0);
        out.push(shape::cuboid(DVec3::new(1.0, 0.7, thin)));
        out.push(shape::prism(7).with_mapped_points(|p| p * DVec3::new(1.0, 1.0, thin)));
        out.push(shape::cuboid(DVec3::new(1.0, thin, thin)));
    }
    out
}

fn few_point_shapes(rng: &mut Pcg64) -> Vec<Shape> {
    let mut out = hulls(rng, &[6, 10]);
    for _ in 0..4 {
        let [p, q, r] = std::array::from_fn(|_| random_vector(rng));
        let beside = p.lerp(q, 0.3) + random_magnitude(rng, -9.0, -1.0) * r;
        out.push(shape::shape_of_points(&[p]));
        out.push(shape::shape_of_points(&[p, q]));
        out.push(shape::shape_of_points(&[p, q, r]));
        out.push(shape::shape_of_points(&[p, q, beside]));
    }
    out
}

pub(crate) fn random_rotation(rng: &mut Pcg64) -> DQuat {
    DQuat::from_axis_angle(random_direction(rng), rng.random_range(-3.1..3.1))
}

/// Draws a rotation that maps coordinate axes to coordinate axes.
fn random_axis_aligned_rotation(rng: &mut Pcg64) -> DMat3 {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let k = rng.random_range(0..3);
    let sign = |rng: &mut Pcg64| if rng.random_bool(0.5) { 1.0 } else { -1.0 };
    let x = axes[k] * sign(rng);
    let y = axes[(k + rng.random_range(1..3)) % 3] * sign(rng);
    DMat3::from_cols(x, y, x.cross(y))
}

/// Two bodies, and the pose of one relative to the other.
pub(crate) struct Scene<'a> {
    pub(crate) a: &'a Body,
    pub(crate) b: &'a Body,
    pub(crate) b_to_a: Frame,
    /// A lower bound of the distance of the bodies; 0 if they were placed to intersect.
    pub(crate) gap: f64,
}

impl Scene<'_> {
    pub(crate) fn pair(&self) -> PiecePair<'_> {
        PiecePair {
            a: self.a.pieces.get(0),
            b: self.b.pieces.get(0),
            b_to_a: self.b_to_a,
        }
    }

    /// Returns the sum of both bodies' largest distances of a point from the origin, and of the distance of the
    /// origins.
    pub(crate) fn reach(&self) -> f64 {
        let largest = |points: &[DVec3]| points.iter().map(|p| p.length()).fold(0.0, greater);
        largest(&self.a.shape.points)
            + largest(&self.b.shape.points)
            + self.b_to_a.translation.length()
    }
}

/// Draws a pair of bodies of a kind, and a pose of B relative to A.
pub(crate) fn draw<'a>(kind: PairKind, pool: &'a [Body], rng: &mut Pcg64) -> Scene<'a> {
    let (a, b) = (
        &pool[rng.random_range(0..pool.len())],
        &pool[rng.random_range(0..pool.len())],
    );
    let aligned = matches!(
        kind,
        PairKind::NearParallel | PairKind::Coplanar | PairKind::Grid
    );
    let mut rotation = match rng.random_range(0..4) {
        0 if !aligned => DMat3::IDENTITY,
        1 if !aligned => random_axis_aligned_rotation(rng),
        _ if !aligned => DMat3::from_quat(random_rotation(rng)),
        0 => DMat3::IDENTITY,
        _ => random_axis_aligned_rotation(rng),
    };
    // Rotated so that a face of B is parallel to a face of A, up to a tiny tilt.
    if kind == PairKind::NearParallel {
        if let (Some(n), Some(m)) = (normal(a, rng), normal(b, rng)) {
            let facing = DMat3::from_quat(DQuat::from_rotation_arc(m, -n));
            rotation = if rng.random_bool(0.7) {
                facing
            } else {
                rotation
            };
        }
        let tilt =
            DQuat::from_scaled_axis(random_magnitude(rng, -16.0, -6.0) * random_direction(rng));
        rotation = DMat3::from_quat(tilt) * rotation;
    }
    let meets = rng.random_bool(0.15)
        && a.shape.points.len() > 3
        && b.shape.points.len() > 3
        && a.shape.loops.len() > 2
        && b.shape.loops.len() > 2;
    let (translation, gap) = if meets {
        let inner = |body: &Body, rng: &mut Pcg64| {
            let corner = body.shape.points[rng.random_range(0..body.shape.points.len())];
            body.middle.lerp(corner, rng.random_range(0.0..0.9))
        };
        (inner(a, rng) - rotation * inner(b, rng), 0.0)
    } else {
        random_separated_position(kind, a, b, rotation, rng)
    };
    let b_to_a = Frame {
        rotation,
        translation,
    };
    Scene { a, b, b_to_a, gap }
}

/// Returns a position of B at which it is apart from A, and the support gap along the direction of separation.
fn random_separated_position(
    kind: PairKind,
    a: &Body,
    b: &Body,
    rotation: DMat3,
    rng: &mut Pcg64,
) -> (DVec3, f64) {
    let whole = kind == PairKind::Grid;
    let n = match rng.random_range(0..4) {
        0 => random_direction(rng),
        1 if has_aligned_axes(kind) => [DVec3::X, DVec3::Y, DVec3::Z][rng.random_range(0..3)],
        2 => random_edge_cross_product(a, b, rotation, rng).unwrap_or(DVec3::Z),
        _ => normal(a, rng).unwrap_or_else(|| random_direction(rng)),
    };
    let gap = if whole {
        f64::from(rng.random_range(1i32..5))
    } else {
        random_magnitude(rng, -6.0, 3.0)
    };
    let high = a
        .shape
        .points
        .iter()
        .map(|p| n.dot(*p))
        .fold(f64::NEG_INFINITY, greater);
    let low = b
        .shape
        .points
        .iter()
        .map(|p| n.dot(rotation * *p))
        .fold(f64::INFINITY, lesser);
    let lateral = match rng.random_range(0..3) {
        0 => DVec3::ZERO,
        1 => random_vector(rng),
        _ => 0.3 * random_vector(rng),
    };
    let lateral = if whole { lateral.round() } else { lateral };
    let base = a.middle - rotation * b.middle + lateral;
    let base = if whole { base.round() } else { base };
    (base + n * (gap + high - low - n.dot(base)), gap)
}

fn has_aligned_axes(kind: PairKind) -> bool {
    matches!(
        kind,
        PairKind::Grid | PairKind::Coplanar | PairKind::NearParallel
    )
}

fn normal(body: &Body, rng: &mut Pcg64) -> Option<DVec3> {
    let shape = &body.shape;
    if shape.loops.is_empty() {
        return None;
    }
    let corners = &shape.loops[rng.random_range(0..shape.loops.len())];
    let at = |k: usize| shape.points[corners[k] as usize];
    (at(1) - at(0)).cross(at(2) - at(0)).try_normalize()
}

fn random_edge_cross_product(
    a: &Body,
    b: &Body,
    rotation: DMat3,
    rng: &mut Pcg64,
) -> Option<DVec3> {
    let edge = |body: &Body, rng: &mut Pcg64| {
        let edges = body.shape.edges();
        if edges.is_empty() {
            return None;
        }
        let [v, w] = edges[rng.random_range(0..edges.len())].map(|v| body.shape.points[v as usize]);
        Some(w - v)
    };
    edge(a, rng)?
        .cross(rotation * edge(b, rng)?)
        .try_normalize()
}
