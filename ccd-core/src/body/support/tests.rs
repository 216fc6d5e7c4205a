//! Tests that climbing finds corners as high as a scan does, on polytopes with integer coordinates.

mod tree;

use super::*;
use crate::body::piece::Piece;
use crate::body::pieces::Pieces;
use crate::body::polytope::{Facet, FacetOrigin, Polytope};
use crate::math::order::greater;
use crate::rounding::HEIGHT_ERROR_F64;
use crate::tests::scene::{RngExt, random_direction, random_power_of_ten, rng};

fn polytope(points: Vec<DVec3>, facets: Vec<Vec<u32>>) -> Pieces {
    let facet = |corners| Facet {
        origin: FacetOrigin::Virtual,
        corners,
    };
    let polytope = Polytope {
        points,
        facets: facets.into_iter().map(facet).collect(),
        ..Polytope::default()
    };
    Pieces::from_polytopes(&[polytope]).unwrap()
}

/// Creates a polytope of a square grid that is lifted to a paraboloid, closed by four side facets and a lid.
fn paraboloid_grid(side: u32) -> Pieces {
    let place = |k: u32| (f64::from(k % side), f64::from(k / side));
    let points = (0..side * side).map(|k| {
        let (x, y) = place(k);
        DVec3::new(x, y, x * x + y * y)
    });
    let last = side - 1;
    let at = |x: u32, y: u32| x + side * y;
    let squares = (0..last * last).map(|k| {
        let (x, y) = (k % last, k / last);
        vec![at(x, y), at(x, y + 1), at(x + 1, y + 1), at(x + 1, y)]
    });
    let arches = [
        (0..side).map(|k| at(k, 0)).collect(),
        (0..side).map(|k| at(k, last)).collect(),
        (0..side).map(|k| at(0, k)).collect(),
        (0..side).map(|k| at(last, k)).collect(),
    ];
    let lid = vec![at(0, 0), at(last, 0), at(last, last), at(0, last)];
    // Four level points make a plate without arches.
    let arches = arches.into_iter().filter(|arch: &Vec<u32>| arch.len() > 2);
    let facets = squares.chain(arches).chain([lid]);
    polytope(points.collect(), facets.collect())
}

/// Creates the cyclic polytope, all of whose thin facets contain the first or the last point.
fn cyclic_polytope(count: u32) -> Pieces {
    let curve = |t: u32| f64::from(t) - 0.5 * f64::from(count);
    let point = |t: u32| DVec3::new(curve(t), curve(t).powi(2), curve(t).powi(3));
    let first = (1..count - 1).map(|i| vec![0, i, i + 1]);
    let last = (0..count - 2).map(|i| vec![i, i + 1, count - 1]);
    polytope((0..count).map(point).collect(), first.chain(last).collect())
}

/// Creates a prism over a convex polygon whose corners are on a parabola.
fn prism(corners: u32) -> Pieces {
    let base = |k: u32| DVec3::new(f64::from(k), f64::from(k * k), 0.0);
    let points = (0..2 * corners).map(|k| {
        if k < corners {
            base(k)
        } else {
            base(k - corners) + 7.0 * DVec3::Z
        }
    });
    let sides = (0..corners).map(|k| {
        let next = (k + 1) % corners;
        vec![k, next, next + corners, k + corners]
    });
    let caps = [
        (0..corners).rev().collect(),
        (corners..2 * corners).collect(),
    ];
    polytope(points.collect(), sides.chain(caps).collect())
}

fn shapes() -> Vec<Pieces> {
    let bowls = [2, 3, 5, 17, 40].map(paraboloid_grid);
    let curves = [4, 5, 30, 200].map(cyclic_polytope);
    let prisms = [3, 4, 50, 300].map(prism);
    bowls.into_iter().chain(curves).chain(prisms).collect()
}

/// Returns random directions of any length; along many of them, several corners have the same height.
fn directions_with_ties(count: usize) -> Vec<DVec3> {
    let mut rng = rng(11);
    let mut whole = || DVec3::from_array([(); 3].map(|()| f64::from(rng.random_range(-3..=3))));
    let mut looks: Vec<DVec3> = (0..count / 2).map(|_| whole()).collect();
    looks.extend((0..count / 4).map(|_| random_direction(&mut rng)));
    looks.extend((0..count / 4).map(|_| {
        let tilt = random_direction(&mut rng) * random_power_of_ten(&mut rng, -17.0, -3.0);
        let whole = DVec3::from_array([(); 3].map(|()| f64::from(rng.random_range(-3..=3))));
        (whole + tilt) * random_power_of_ten(&mut rng, -30.0, 30.0)
    }));
    looks
}

#[test]
fn climbing_agrees_with_a_scan() {
    let mut rng = rng(12);
    for pieces in shapes() {
        let piece = pieces.get(0);
        let table = SupportTable::new(piece.points, piece.facets).unwrap();
        let scan = SupportScan::new(piece.points);
        let reach = piece.points.iter().map(|p| p.abs().max_element());
        let reach = reach.fold(0.0, greater);
        for look in directions_with_ties(2_000) {
            let height = |v: u32| look.dot(piece.points[v as usize]);
            let highest = (0..piece.points.len() as u32)
                .map(height)
                .fold(f64::NEG_INFINITY, greater);
            let slack = 2.0 * HEIGHT_ERROR_F64 * reach * look.abs().element_sum();
            let start = rng.random_range(0..piece.points.len() as u32);
            for found in [
                table.extremal_point(look),
                table.extremal_point_from(start, look),
                scan.extremal_point(look),
            ] {
                assert!(
                    height(found) >= highest - slack,
                    "{found} of {} along {look}: {:e} below",
                    piece.points.len(),
                    highest - height(found)
                );
            }
        }
    }
}

#[test]
fn scanning_takes_the_first_of_the_highest() {
    let mut rng = rng(13);
    for count in 1..40 {
        let points: Vec<DVec3> = (0..count)
            .map(|_| DVec3::from_array([(); 3].map(|()| f64::from(rng.random_range(-2..=2)))))
            .collect();
        let scan = SupportScan::new(&points);
        for look in directions_with_ties(40).into_iter().take(20) {
            let height = |p: &DVec3| look.dot(*p);
            let highest = points.iter().map(height).fold(f64::NEG_INFINITY, greater);
            let first = points.iter().position(|p| height(p) == highest);
            assert_eq!(Some(scan.extremal_point(look) as usize), first);
        }
    }
}

#[test]
fn directions_are_their_own_nearest_and_none_is_far() {
    let all: Vec<DVec3> = directions::table_directions().collect();
    assert_eq!(all.len(), TABLE_DIRECTION_COUNT);
    for (number, direction) in all.iter().enumerate() {
        for scale in [1e-150, 1.0, 1e150] {
            assert_eq!(
                directions::nearest_direction_index(*direction * scale),
                number
            );
        }
    }
    let mut rng = rng(14);
    for _ in 0..10_000 {
        let look = random_direction(&mut rng);
        let angle = look.angle_between(all[directions::nearest_direction_index(look)]);
        // The limit is half a step of latitude, and half a step of longitude on the equator.
        assert!(angle <= 16f64.to_radians(), "{}", angle.to_degrees());
    }
}

#[test]
fn many_corners_with_facets_are_climbed_others_looked_at() {
    let large = paraboloid_grid(40);
    assert!(matches!(
        SupportMap::new(large.get(0).points, large.get(0).facets),
        SupportMap::Climb(_)
    ));
    let bare = Piece::from_points(large.points());
    assert!(matches!(
        SupportMap::new(bare.points, bare.facets),
        SupportMap::Scan(_)
    ));
    assert!(SupportTable::new(bare.points, bare.facets).is_none());
    let small = paraboloid_grid(2);
    assert!(matches!(
        SupportMap::new(small.get(0).points, small.get(0).facets),
        SupportMap::Scan(_)
    ));
}

#[test]
fn invalid_directions_give_some_corner() {
    let pieces = paraboloid_grid(40);
    let table = SupportTable::new(pieces.get(0).points, pieces.get(0).facets).unwrap();
    let scan = SupportScan::new(pieces.points());
    for look in [DVec3::NAN, DVec3::INFINITY, DVec3::ZERO, -DVec3::INFINITY] {
        assert!(table.extremal_point(look) < 1600);
        assert!(table.extremal_point_from(9999, look) < 1600);
        assert!(scan.extremal_point(look) < 1600);
    }
}

#[test]
fn points_on_no_facet_are_no_dead_end() {
    let mut points = paraboloid_grid(3).points().to_vec();
    points.push(DVec3::new(1.0, 1.0, 3.0));
    let pieces = paraboloid_grid(3);
    let facets = pieces.get(0).facets.iter().map(<[u32]>::to_vec).collect();
    let pieces = polytope(points, facets);
    let table = SupportTable::new(pieces.get(0).points, pieces.get(0).facets).unwrap();
    assert!(table.neighbours(9).is_empty());
    assert_eq!(
        table.extremal_point_from(9, DVec3::X + DVec3::Y + DVec3::Z),
        8
    );
}
