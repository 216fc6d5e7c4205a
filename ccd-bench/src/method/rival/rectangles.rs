//! Computes the shortest vector between two rectangles in space.

use super::Placement;
use super::lanes::{ShortestVectors, Vec3x4};
use ccd_core::glam::{DVec2, DVec3};
use wide::f64x4;

#[cfg(test)]
mod tests;

/// Returns the shortest vector from rectangle A to rectangle B in the frame of A; zero if they meet.
///
/// A rectangle spans the x and y axes of its frame, from the origin to the given lengths, either of
/// which may be zero. `placement` is the frame of B as seen from that of A.
///
/// # Guarantee
/// Exact except for rounding; zero if coordinates are not finite.
///
/// # Complexity
/// Constant: the least of the 16 pairs of edges and the 8 pairs of a corner and a face \[PQP99
/// §4\], four at a time. PQP tests pair by pair whether it is the nearest and stops there. Four at
/// a time, it is faster to compute all.
pub(super) fn shortest_vector(a: DVec2, b: DVec2, placement: &Placement) -> DVec3 {
    let corners_b = corners(b, placement);
    let back = Placement {
        rotation: placement.rotation.transpose(),
        translation: -placement.rotation.transpose_mul_vec3(placement.translation),
    };
    let corners_a = corners(a, &back);
    if straddles_plane(corners_a)
        && straddles_plane(corners_b)
        && (edges_pierce(corners_a, b) || edges_pierce(corners_b, a))
    {
        return DVec3::ZERO;
    }
    let mut shortest = ShortestVectors::empty().include_four(vectors_from_rectangle(corners_b, a));
    shortest = include_edge_vectors::<0, 0>(shortest, a, b, placement);
    shortest = include_edge_vectors::<0, 1>(shortest, a, b, placement);
    shortest = include_edge_vectors::<1, 0>(shortest, a, b, placement);
    shortest = include_edge_vectors::<1, 1>(shortest, a, b, placement);
    let (squared, to_b) = shortest.shortest();
    let (squared_off_b, off_b) = ShortestVectors::empty()
        .include_four(vectors_from_rectangle(corners_a, b))
        .shortest();
    if squared_off_b < squared {
        -(placement.rotation * off_b)
    } else {
        to_b
    }
}

/// Returns the corners of a rectangle in cyclic order.
#[inline(always)]
fn corners(lengths: DVec2, placement: &Placement) -> Vec3x4 {
    let x = f64x4::new([0.0, lengths.x, lengths.x, 0.0]);
    let y = f64x4::new([0.0, 0.0, lengths.y, lengths.y]);
    Vec3x4::splat(placement.translation)
        .plus_scaled(x, placement.rotation.x_axis)
        .plus_scaled(y, placement.rotation.y_axis)
}

/// Returns the vector to each given point from the nearest point of a rectangle, in the rectangle's frame.
#[inline(always)]
fn vectors_from_rectangle(Vec3x4([x, y, z]): Vec3x4, face: DVec2) -> Vec3x4 {
    let zero = f64x4::splat(0.0);
    Vec3x4([
        x - x.fast_clamp(zero, f64x4::splat(face.x)),
        y - y.fast_clamp(zero, f64x4::splat(face.y)),
        z,
    ])
}

/// Includes in `shortest` the shortest vectors between four pairs of edges: each of A's two edges along its axis `I`
/// with each of B's two edges along its axis `J`.
#[inline(always)]
fn include_edge_vectors<const I: usize, const J: usize>(
    shortest: ShortestVectors,
    a: DVec2,
    b: DVec2,
    placement: &Placement,
) -> ShortestVectors {
    let zero = f64x4::splat(0.0);
    let (axes_a, axes_b) = ([DVec3::X, DVec3::Y], &placement.rotation);
    let (along, aside) = (axes_b.col(J), axes_b.col(1 - J));
    let aside_a = f64x4::new([0.0, a[1 - I], 0.0, a[1 - I]]);
    let aside_b = f64x4::new([0.0, 0.0, b[1 - J], b[1 - J]]);
    // From the start of A's edge to that of B's; s and t are the positions of the points along them.
    let mut apart = Vec3x4::splat(placement.translation).plus_scaled(aside_b, aside);
    apart.0[1 - I] -= aside_a;
    let (ahead_a, ahead_b) = (apart.0[I], apart.dot(along));
    let cosine = f64x4::splat(along.dot(axes_a[I]));
    // By the sine, not by 1 − cos²: edges a hundred millionth of a radian apart still cross somewhere.
    let sine = axes_a[I].cross(along);
    let sine_squared = sine.length_squared();
    let square_to_b = if sine_squared > 0.0 {
        along.cross(sine) / sine_squared
    } else {
        DVec3::ZERO
    };
    let (length_a, length_b) = (f64x4::splat(a[I]), f64x4::splat(b[J]));
    let s = apart.dot(square_to_b).fast_clamp(zero, length_a);
    let t = cosine.mul_sub(s, ahead_b).fast_clamp(zero, length_b);
    let s = cosine.mul_add(t, ahead_a).fast_clamp(zero, length_a);
    let mut vectors = apart.plus_scaled(t, along);
    vectors.0[I] -= s;
    shortest.include_four(vectors)
}

/// Returns true if there are points on both sides of the plane z = 0.
#[inline(always)]
fn straddles_plane(Vec3x4([_, _, z]): Vec3x4) -> bool {
    let zero = f64x4::splat(0.0);
    z.simd_lt(zero).any() && z.simd_gt(zero).any()
}

/// Returns true if an edge between two successive corners passes through a rectangle, in that rectangle's frame.
fn edges_pierce(Vec3x4([x, y, z]): Vec3x4, face: DVec2) -> bool {
    let next = |v: f64x4| {
        let [a, b, c, d] = v.to_array();
        f64x4::new([b, c, d, a])
    };
    let zero = f64x4::splat(0.0);
    let z_next = next(z);
    let fraction = z / (z - z_next);
    let x = fraction.mul_add(next(x) - x, x);
    let y = fraction.mul_add(next(y) - y, y);
    let crosses = (z * z_next).simd_lt(zero);
    let inside_x = zero.simd_le(x) & x.simd_le(f64x4::splat(face.x));
    let inside_y = zero.simd_le(y) & y.simd_le(f64x4::splat(face.y));
    (crosses & inside_x & inside_y).any()
}
