//! Makes convex polytopes with known facets, by construction or by trying the planes of all triples of points.

use ccd_core::exact::side_of_plane;
use ccd_core::glam::DVec3;
use ccd_core::{Facet, FacetOrigin, Pieces, Polytope};
pub(crate) use rand::{RngExt, SeedableRng};
pub(crate) use rand_pcg::Pcg64;
use std::cmp::Ordering;
use std::f64::consts::TAU;

/// The corners and the facets of a convex hull.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) points: Vec<DVec3>,
    pub(crate) loops: Vec<Vec<u32>>,
}

impl Shape {
    /// Returns a list of pieces that has this shape as its only piece.
    pub(crate) fn pieces(&self) -> Pieces {
        let facet = |corners: &Vec<u32>| Facet {
            origin: FacetOrigin::Virtual,
            corners: corners.clone(),
        };
        let polytope = Polytope {
            points: self.points.clone(),
            facets: self.loops.iter().map(facet).collect(),
            ..Polytope::default()
        };
        Pieces::from_polytopes(&[polytope]).expect("finite points")
    }

    pub(crate) fn with_mapped_points(mut self, map: impl Fn(DVec3) -> DVec3) -> Self {
        self.points.iter_mut().for_each(|p| *p = map(*p));
        self
    }

    /// Cuts the facets into triangles, as meshes have them.
    pub(crate) fn triangulated(mut self) -> Self {
        let fan = |l: &Vec<u32>| {
            (1..l.len() - 1)
                .map(|k| vec![l[0], l[k], l[k + 1]])
                .collect()
        };
        self.loops = self
            .loops
            .iter()
            .flat_map(|l| -> Vec<_> { fan(l) })
            .collect();
        self
    }

    /// Returns every edge of the shape once, from its lower to its higher corner.
    pub(crate) fn edges(&self) -> Vec<[u32; 2]> {
        if self.loops.is_empty() {
            let count = self.points.len() as u32;
            let all = (0..count).flat_map(|v| (v + 1..count).map(move |w| [v, w]));
            return all.collect();
        }
        let turn = |l: &Vec<u32>| -> Vec<[u32; 2]> {
            (0..l.len()).map(|k| [l[k], l[(k + 1) % l.len()]]).collect()
        };
        let all = self.loops.iter().flat_map(turn);
        // Sides of flat polygons too: both of their facets have them.
        all.filter(|[v, w]| v < w).collect()
    }
}

/// Draws a vector in the cube of side two about the origin.
pub(crate) fn random_vector(rng: &mut Pcg64) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| rng.random_range(-1.0..1.0)))
}

pub(crate) fn random_direction(rng: &mut Pcg64) -> DVec3 {
    loop {
        let v = random_vector(rng);
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// Draws a number between two powers of ten, with every order of magnitude equally likely.
pub(crate) fn random_magnitude(rng: &mut Pcg64, low: f64, high: f64) -> f64 {
    10f64.powf(rng.random_range(low..high))
}

/// Computes the hull of a few points by trying the plane of every three of them, with exact signs.
pub(crate) fn hull(points: &[DVec3]) -> Shape {
    let count = points.len();
    let mut planes: Vec<Vec<u32>> = Vec::new();
    for i in 0..count {
        for j in 0..count {
            for k in j + 1..count {
                if i >= j {
                    continue;
                }
                for [p, q, r] in [[i, j, k], [i, k, j]] {
                    let triangle = [points[p], points[q], points[r]];
                    let sides: Vec<Ordering> =
                        points.iter().map(|&x| side_of_plane(triangle, x)).collect();
                    if sides.iter().all(|&s| s.is_le()) && sides.iter().any(|&s| s.is_lt()) {
                        let on = (0..count as u32).filter(|&v| sides[v as usize].is_eq());
                        let on: Vec<u32> = on.collect();
                        let polygon = match on.len() {
                            3 => [p, q, r].map(|v| v as u32).to_vec(),
                            _ => planar_hull_corners(points, &on, triangle),
                        };
                        if !planes.contains(&polygon) {
                            planes.push(polygon);
                        }
                    }
                }
            }
        }
    }
    Shape {
        points: points.to_vec(),
        loops: planes,
    }
}

/// Returns the corners of the convex hull of points in a plane, counterclockwise from the corner of least index.
fn planar_hull_corners(points: &[DVec3], on: &[u32], [p, q, r]: [DVec3; 3]) -> Vec<u32> {
    let normal = (q - p).cross(r - p);
    let above = p + normal.normalize_or_zero() * (q - p).length();
    let is_side = |v: u32, w: u32| {
        let base = [points[v as usize], points[w as usize], above];
        let turns: Vec<Ordering> = on
            .iter()
            .map(|&x| side_of_plane(base, points[x as usize]))
            .collect();
        // The inside of the polygon is behind a plane through the side, across the polygon; no
        // point is within the side.
        let [a, b] = [v, w].map(|x| points[x as usize]);
        let within = |&&x: &&u32| {
            let c = points[x as usize];
            x != v && x != w && (c - a).dot(c - b) < 0.0
        };
        let on_line = on
            .iter()
            .filter(|&&x| side_of_plane(base, points[x as usize]).is_eq());
        let beyond = on_line.clone().any(|x| {
            let c = points[*x as usize];
            (c - a).dot(b - a) < 0.0 || (c - b).dot(a - b) < 0.0
        });
        turns.iter().all(|&t| t.is_le())
            && !beyond
            && (on_line.clone().filter(within).count() < on.len())
    };
    let mut polygon = Vec::new();
    let mut at = on
        .iter()
        .copied()
        .find(|&v| on.iter().any(|&w| w != v && is_side(v, w)));
    while let Some(v) = at {
        if polygon.first() == Some(&v) || polygon.len() > on.len() {
            break;
        }
        polygon.push(v);
        at = on.iter().copied().find(|&w| w != v && is_side(v, w));
    }
    let least = (0..polygon.len()).min_by_key(|&k| polygon[k]).unwrap_or(0);
    polygon.rotate_left(least);
    polygon
}

pub(crate) fn cuboid(half: DVec3) -> Shape {
    let sign = |k: usize, bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
    let corner = |k| half * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2));
    let loops = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    Shape {
        points: (0..8).map(corner).collect(),
        loops: loops.map(|l| l.to_vec()).to_vec(),
    }
}

fn ring(count: u32, z: f64, turn: f64) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |k| {
        let (y, x) = ((f64::from(k) + turn) * TAU / f64::from(count)).sin_cos();
        DVec3::new(x, y, z)
    })
}

pub(crate) fn prism(corners: u32) -> Shape {
    let sides = (0..corners).map(|k| {
        let next = (k + 1) % corners;
        vec![k, next, next + corners, k + corners]
    });
    let caps = [
        (0..corners).rev().collect(),
        (corners..2 * corners).collect(),
    ];
    Shape {
        points: ring(corners, -1.0, 0.0)
            .chain(ring(corners, 1.0, 0.0))
            .collect(),
        loops: sides.chain(caps).collect(),
    }
}

pub(crate) fn antiprism(corners: u32) -> Shape {
    let sides = (0..corners).flat_map(|k| {
        let next = (k + 1) % corners;
        [
            vec![k, next, k + corners],
            vec![next, next + corners, k + corners],
        ]
    });
    let caps = [
        (0..corners).rev().collect(),
        (corners..2 * corners).collect(),
    ];
    Shape {
        points: ring(corners, -0.7, 0.0)
            .chain(ring(corners, 0.7, 0.5))
            .collect(),
        loops: sides.chain(caps).collect(),
    }
}

pub(crate) fn bipyramid(corners: u32) -> Shape {
    let (low, high) = (corners, corners + 1);
    let sides = (0..corners).flat_map(|k| {
        let next = (k + 1) % corners;
        [vec![k, next, high], vec![next, k, low]]
    });
    Shape {
        points: ring(corners, 0.0, 0.0)
            .chain([-DVec3::Z, DVec3::Z])
            .collect(),
        loops: sides.collect(),
    }
}

/// Creates a finely tessellated ball: rings of corners between two poles.
pub(crate) fn uv_sphere(rings: u32, corners: u32) -> Shape {
    let mut points = vec![-DVec3::Z];
    for k in 1..=rings {
        let (sin, cos) = (f64::from(k) * 0.5 * TAU / f64::from(rings + 1)).sin_cos();
        points.extend(ring(corners, -cos, 0.0).map(|p| DVec3::new(sin * p.x, sin * p.y, p.z)));
    }
    points.push(DVec3::Z);
    let last = points.len() as u32 - 1;
    let at = |ring: u32, k: u32| 1 + ring * corners + k % corners;
    let mut loops = Vec::new();
    for k in 0..corners {
        loops.push(vec![0, at(0, k + 1), at(0, k)]);
        loops.push(vec![last, at(rings - 1, k), at(rings - 1, k + 1)]);
        for ring in 1..rings {
            let (low, high) = (ring - 1, ring);
            loops.push(vec![
                at(low, k),
                at(low, k + 1),
                at(high, k + 1),
                at(high, k),
            ]);
        }
    }
    Shape { points, loops }
}

/// Creates a cyclic polytope, whose thin triangles all have the first or the last corner in common.
pub(crate) fn cyclic_polytope(count: u32) -> Shape {
    let curve = |t: u32| 2.0 * f64::from(t) / f64::from(count - 1) - 1.0;
    let point = |t: u32| DVec3::new(curve(t), curve(t).powi(2), curve(t).powi(3));
    let first = (1..count - 1).map(|i| vec![0, i + 1, i]);
    let last = (0..count - 2).map(|i| vec![i, i + 1, count - 1]);
    Shape {
        points: (0..count).map(point).collect(),
        loops: first.chain(last).collect(),
    }
}

/// Creates a flat regular polygon, with a front and a back facet.
pub(crate) fn polygon(corners: u32) -> Shape {
    Shape {
        points: ring(corners, 0.0, 0.0).collect(),
        loops: vec![(0..corners).collect(), (0..corners).rev().collect()],
    }
}

/// Creates the shape of one, two or three points, without facets.
pub(crate) fn shape_of_points(points: &[DVec3]) -> Shape {
    Shape {
        points: points.to_vec(),
        loops: Vec::new(),
    }
}

/// Computes the hull of random points of the unit sphere.
pub(crate) fn random_hull(rng: &mut Pcg64, count: usize) -> Shape {
    let points: Vec<DVec3> = (0..count).map(|_| random_direction(rng)).collect();
    hull(&points)
}

/// Computes the hull of random points of a small grid, some of them coplanar.
pub(crate) fn grid_hull(rng: &mut Pcg64, count: usize) -> Shape {
    loop {
        let mut whole = || f64::from(rng.random_range(-2i32..=2));
        let mut points: Vec<DVec3> = (0..count)
            .map(|_| DVec3::new(whole(), whole(), whole()))
            .collect();
        points.sort_by(|p, q| p.to_array().partial_cmp(&q.to_array()).expect("finite"));
        points.dedup();
        let shape = hull(&points);
        if shape.loops.len() > 3 {
            return shape;
        }
    }
}
