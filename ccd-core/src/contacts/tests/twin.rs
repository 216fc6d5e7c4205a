//! Finds the contacts of two meshes by brute force over all pairs of features, as a reference.

use crate::body::feature::Feature;
use crate::body::pieces::Pieces;
use crate::body::{Body, Solidity};
use crate::math::order::{greater, lesser};
use crate::motion::pose::Pose;
use crate::tests::nearest::{Triangle, nearest_points};
use crate::tests::scene::{Pcg64, RngExt};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// A triangle mesh with shared vertices.
pub(super) struct Mesh {
    pub(super) points: Vec<DVec3>,
    pub(super) faces: Vec<[u32; 3]>,
}

/// The pairs of features that a search must report, with their distances, and those that it may report due to rounding.
pub(super) struct ExpectedPairs {
    pub(super) certain_pairs: BTreeMap<String, f64>,
    pub(super) uncertain_pairs: BTreeSet<String>,
}

impl Mesh {
    pub(super) fn from_triangles(triangles: Vec<Triangle>) -> Self {
        Mesh {
            faces: (0..triangles.len() as u32)
                .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
                .collect(),
            points: triangles.into_iter().flatten().collect(),
        }
    }

    /// Creates a box of 12 triangles with the given half extents. Corner `k` has a positive x, y, z where bit 0, 1, 2
    /// of `k` is set.
    pub(super) fn cuboid(half: DVec3) -> Self {
        let sign = |k: u32, bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let quads = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        Mesh {
            points: (0..8)
                .map(|k| half * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2)))
                .collect(),
            faces: quads
                .iter()
                .flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]])
                .collect(),
        }
    }

    /// Creates a square terrain about the origin, of `cells × cells` squares, with heights from −`rough` to 0.
    pub(super) fn terrain(rng: &mut Pcg64, cells: u32, half: f64, rough: f64) -> Self {
        let place = |k: u32| half * (2.0 * f64::from(k) / f64::from(cells) - 1.0);
        let vertex = |i: u32, j: u32| i * (cells + 1) + j;
        let squares = (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j)));
        Mesh {
            points: (0..=cells)
                .flat_map(|i| (0..=cells).map(move |j| DVec3::new(place(i), place(j), 0.0)))
                .map(|p| p - rough * rng.random_range(0.0..1.0) * DVec3::Z)
                .collect(),
            faces: squares
                .flat_map(|(i, j)| {
                    let [a, b, c, d] = [
                        vertex(i, j),
                        vertex(i + 1, j),
                        vertex(i + 1, j + 1),
                        vertex(i, j + 1),
                    ];
                    [[a, b, c], [a, c, d]]
                })
                .collect(),
        }
    }

    pub(super) fn body(&self, volume: Solidity) -> Body {
        let ids: Vec<u32> = (0..self.faces.len() as u32).collect();
        let pieces = Pieces::from_triangles(&self.points, &self.faces, &ids).unwrap();
        Body::new(&pieces, volume).unwrap()
    }

    pub(super) fn at_pose(&self, pose: &Pose) -> Mesh {
        Mesh {
            points: self
                .points
                .iter()
                .map(|&p| pose.transform_point(p))
                .collect(),
            faces: self.faces.clone(),
        }
    }

    fn triangle(&self, face: usize) -> Triangle {
        self.faces[face].map(|v| self.points[v as usize])
    }

    /// Returns each edge once, with its two faces if these are coplanar.
    fn edges(&self, rounding: f64) -> Vec<([u32; 2], Option<[u32; 2]>)> {
        let mut sides: BTreeMap<[u32; 2], Vec<(u32, u32)>> = BTreeMap::new();
        for (k, face) in (0u32..).zip(&self.faces) {
            for i in 0..3 {
                let (v, w, tip) = (face[i], face[(i + 1) % 3], face[(i + 2) % 3]);
                sides
                    .entry([v.min(w), v.max(w)])
                    .or_default()
                    .push((k, tip));
            }
        }
        let at = |v: u32| self.points[v as usize];
        let flat = |[v, w]: [u32; 2], sides: &[(u32, u32)]| match *sides {
            [(first, p), (second, q)] => {
                let along = at(w) - at(v);
                let normal = along.cross(at(p) - at(v)).normalize();
                let beyond = along.cross(at(q) - at(v)).dot(normal) < 0.0;
                let level = normal.dot(at(q) - at(v)).abs() <= rounding;
                (beyond && level).then_some([first, second])
            }
            _ => None,
        };
        let flat = |(ends, sides): ([u32; 2], Vec<_>)| (ends, flat(ends, &sides));
        sides.into_iter().map(flat).collect()
    }

    /// Returns whether one feature is on the boundary of another.
    fn is_on_boundary(&self, part: Feature, of: Feature) -> bool {
        match (part, of) {
            (Feature::Vertex(v), Feature::Edge(a, b)) => v == a || v == b,
            (Feature::Vertex(v), Feature::Face(face)) => self.faces[face as usize].contains(&v),
            (Feature::Edge(v, w), Feature::Face(face)) => {
                let corners = self.faces[face as usize];
                corners.contains(&v) && corners.contains(&w)
            }
            _ => false,
        }
    }
}

/// A feature of A and a feature of B.
type Key = [Feature; 2];

/// Returns the pairs of features of two meshes that are at most `reach` apart.
pub(super) fn contacts(a: &Mesh, b: &Mesh, reach: f64, rounding: f64) -> ExpectedPairs {
    let mut offers = CollectedPairs {
        reach,
        rounding,
        certain_pairs: BTreeMap::new(),
        uncertain_pairs: BTreeSet::new(),
    };
    for (one, other, order) in [(a, b, [0, 1]), (b, a, [1, 0])] {
        let used: BTreeSet<u32> = one.faces.iter().flatten().copied().collect();
        for v in used {
            for face in 0..other.faces.len() {
                let pair = |part| order.map(|k| [Feature::Vertex(v), part][k]);
                offers.add_vertex_face_pair(one.points[v as usize], other, face, pair);
            }
        }
    }
    let edges = |mesh: &Mesh| -> Vec<[u32; 2]> {
        let all = mesh.edges(rounding).into_iter();
        all.filter(|it| it.1.is_none()).map(|it| it.0).collect()
    };
    for e in edges(a) {
        for f in edges(b) {
            let ends = |mesh: &Mesh, ends: [u32; 2]| ends.map(|v| mesh.points[v as usize]);
            let names = [e, f].map(|[v, w]| Feature::Edge(v, w));
            offers.add_edge_pair(ends(a, e), ends(b, f), names);
        }
    }
    offers.into_expected_pairs([a, b])
}

/// The pairs of features found so far: those certainly within reach, with their distances, and those possibly within
/// reach.
struct CollectedPairs {
    reach: f64,
    rounding: f64,
    certain_pairs: BTreeMap<Key, f64>,
    uncertain_pairs: BTreeSet<Key>,
}

impl CollectedPairs {
    /// Adds a pair if its distance is at most the reach, up to rounding.
    fn add_if_near(&mut self, key: Key, distance: f64, clear: bool) {
        if distance > self.reach + 4.0 * self.rounding {
        } else if clear && distance <= self.reach {
            let least = self.certain_pairs.entry(key).or_insert(distance);
            *least = lesser(*least, distance);
        } else {
            self.uncertain_pairs.insert(key);
        }
    }

    /// Adds the pair of a vertex and the corner, edge or inside of a face that is nearest to it. The pair is clear if
    /// no smaller part is equally near.
    fn add_vertex_face_pair(
        &mut self,
        v: DVec3,
        mesh: &Mesh,
        face: usize,
        pair: impl Fn(Feature) -> Key,
    ) {
        let (triangle, ids) = (mesh.triangle(face), mesh.faces[face]);
        let distance = nearest_points(&[v; 3], &triangle).distance;
        let margin = 16.0 * self.rounding;
        let as_near =
            |corners: Triangle| nearest_points(&[v; 3], &corners).distance <= distance + margin;
        let corner = (0..3).find(|&k| as_near([triangle[k]; 3]));
        let edge = (0..3).find(|&k| {
            let next = triangle[(k + 1) % 3];
            as_near([triangle[k], next, next])
        });
        let edge_name = |k: usize| Feature::edge(ids[k], ids[(k + 1) % 3]);
        let part = match (corner, edge) {
            (Some(k), _) => Feature::Vertex(ids[k]),
            (None, Some(k)) => edge_name(k),
            (None, None) => Feature::Face(face as u32),
        };
        // This tests for equal distances, not merely equal up to rounding.
        let exact = |corners: Triangle| {
            nearest_points(&[v; 3], &corners).distance <= distance + 0.25 * self.rounding
        };
        let clear = match part {
            Feature::Vertex(_) => corner.is_some_and(|k| exact([triangle[k]; 3])),
            Feature::Edge(..) => edge.is_some_and(|k| {
                let next = triangle[(k + 1) % 3];
                exact([triangle[k], next, next])
            }),
            _ => true,
        };
        self.add_if_near(pair(part), distance, clear);
        if !clear {
            let all = (0..3).flat_map(|k| [Feature::Vertex(ids[k]), edge_name(k)]);
            for part in all.chain([Feature::Face(face as u32)]) {
                self.add_if_near(pair(part), distance, false);
            }
        }
    }

    /// Adds the pair of two edges whose nearest points are inside both edges. The pair is clear if the edges are nearer
    /// there than at any end.
    fn add_edge_pair(&mut self, e: [DVec3; 2], f: [DVec3; 2], names: Key) {
        let (d, along, way) = (e[1] - e[0], f[1] - f[0], f[0] - e[0]);
        let across = d.cross(along);
        let s = way.cross(along).dot(across) / across.length_squared();
        let t = way.cross(d).dot(across) / across.length_squared();
        if !(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) {
            return;
        }
        let distance = (e[0] + s * d).distance(f[0] + t * along);
        let segment = |[p, q]: [DVec3; 2]| [p, q, q];
        let end = |p: DVec3, edge| nearest_points(&[p; 3], &segment(edge)).distance;
        let ends = [end(e[0], f), end(e[1], f), end(f[0], e), end(f[1], e)];
        let nearest_end = ends.into_iter().fold(f64::INFINITY, lesser);
        let slanted = across.length() > 1e-4 * d.length() * along.length();
        let clear = slanted && nearest_end > distance + 16.0 * self.rounding;
        self.add_if_near(names, distance, clear);
    }

    /// Removes a vertex's pairs with the boundary of any feature that it pairs with, and names edges inside flat parts
    /// by a face.
    fn into_expected_pairs(self, meshes: [&Mesh; 2]) -> ExpectedPairs {
        let larger = |key: &Key, other: &Key| {
            (0..2).any(|k| {
                let corner = matches!(key[1 - k], Feature::Vertex(_)) && key[1 - k] == other[1 - k];
                corner && meshes[k].is_on_boundary(key[k], other[k])
            })
        };
        let within = meshes.map(|mesh| -> BTreeMap<Feature, [u32; 2]> {
            let edges = mesh.edges(self.rounding).into_iter();
            let flat = edges.filter_map(|([v, w], faces)| Some((Feature::Edge(v, w), faces?)));
            flat.collect()
        });
        let name = |key: &Key| {
            let side = |k: usize| match within[k].get(&key[k]) {
                Some(faces) => Feature::Face(faces[0]),
                None => key[k],
            };
            format!("{} {}", side(0), side(1))
        };
        // The distance by which one of the faces at an edge within a plane is nearer than a point
        // on it.
        let nearer = |key: &Key, distance: f64| -> f64 {
            let of_side = |k: usize| {
                let Feature::Vertex(v) = key[1 - k] else {
                    return 0.0;
                };
                let from = [meshes[1 - k].points[v as usize]; 3];
                let faces = within[k].get(&key[k]).into_iter().flatten();
                faces
                    .map(|&face| {
                        distance
                            - nearest_points(&from, &meshes[k].triangle(face as usize)).distance
                    })
                    .fold(0.0, greater)
            };
            greater(of_side(0), of_side(1))
        };
        let (mut sure, mut doubtful) = (BTreeMap::new(), BTreeSet::new());
        for (key, &distance) in &self.certain_pairs {
            if self.certain_pairs.keys().any(|other| larger(key, other)) {
                continue;
            }
            let nearer = nearer(key, distance);
            if nearer > 16.0 * self.rounding {
                continue;
            }
            let brink = nearer > 0.25 * self.rounding;
            if brink || self.uncertain_pairs.iter().any(|other| larger(key, other)) {
                doubtful.insert(name(key));
            } else {
                sure.insert(name(key), distance);
            }
        }
        doubtful.extend(self.uncertain_pairs.iter().map(name));
        ExpectedPairs {
            certain_pairs: sure,
            uncertain_pairs: doubtful,
        }
    }
}
