//! Computes distances of triangles by brute force, except for pairs that bounding boxes exclude.

use crate::models::Mesh;
use ccd_core::glam::DVec3;
use ccd_core::order::lesser;
use std::f64::consts::PI;

/// A mesh with its vertices at the body's pose at one time.
pub(super) struct PosedMesh<'a> {
    mesh: &'a Mesh,
    points: Vec<DVec3>,
    faces: Vec<Face>,
    boxes: Vec<Bounds>,
    face_group_boxes: Vec<Bounds>,
}

/// The number of faces in a group, which share a bounding box.
const FACES_PER_GROUP: usize = 8;

impl<'a> PosedMesh<'a> {
    pub(super) fn new(mesh: &'a Mesh, points: Vec<DVec3>) -> Self {
        let of_face = |face: &[u32; 3]| {
            face.iter().fold(Bounds::EMPTY, |all, &v| {
                all.bounds_with_point(points[v as usize])
            })
        };
        let boxes: Vec<Bounds> = mesh.faces.iter().map(of_face).collect();
        let face = |face: &[u32; 3]| Face::new(face.map(|v| points[v as usize]));
        let group = |some: &[Bounds]| some.iter().fold(Bounds::EMPTY, |all, b| all.union(*b));
        PosedMesh {
            mesh,
            faces: mesh.faces.iter().map(face).collect(),
            face_group_boxes: boxes.chunks(FACES_PER_GROUP).map(group).collect(),
            boxes,
            points,
        }
    }

    pub(super) fn mesh(&self) -> &'a Mesh {
        self.mesh
    }

    pub(super) fn points(&self) -> &[DVec3] {
        &self.points
    }

    pub(super) fn first_vertex(&self) -> Option<DVec3> {
        self.points.first().copied()
    }

    /// Returns the least distance over all pairs of faces; 0 if two faces intersect.
    pub(super) fn distance(&self, other: &PosedMesh<'_>) -> f64 {
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (i, a) in self.face_group_boxes.iter().enumerate() {
            for (j, b) in other.face_group_boxes.iter().enumerate() {
                pairs.push((a.distance_squared(b), i, j));
            }
        }
        pairs.sort_unstable_by(|x, y| x.0.total_cmp(&y.0));
        let mut best = f64::INFINITY;
        for (bound, i, j) in pairs {
            if bound > best || best == 0.0 {
                break;
            }
            best = lesser(best, self.face_group_distance_squared(other, [i, j], best));
        }
        best.sqrt()
    }

    fn face_group_distance_squared(
        &self,
        other: &PosedMesh<'_>,
        groups: [usize; 2],
        limit: f64,
    ) -> f64 {
        let mut best = limit;
        for i in members(groups[0], self.boxes.len()) {
            for j in members(groups[1], other.boxes.len()) {
                if self.boxes[i].distance_squared(&other.boxes[j]) <= best {
                    best = lesser(best, distance_squared(&self.faces[i], &other.faces[j]));
                }
            }
        }
        best
    }
}

fn members(group: usize, count: usize) -> std::ops::Range<usize> {
    group * FACES_PER_GROUP..((group + 1) * FACES_PER_GROUP).min(count)
}

/// Returns the squared distance of two triangles, over all vertex-face and edge-edge pairs; 0 if an edge of one passes
/// through the other.
pub(crate) fn distance_squared(a: &Face, b: &Face) -> f64 {
    let edges = |Face { corners: t, .. }: &Face| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let (edges_a, edges_b) = (edges(a), edges(b));
    if edges_a.iter().any(|&e| pierces(e, b.corners))
        || edges_b.iter().any(|&e| pierces(e, a.corners))
    {
        return 0.0;
    }
    let mut best = f64::INFINITY;
    for k in 0..3 {
        for (p, face) in [(a.corners[k], b), (b.corners[k], a)] {
            best = lesser(best, face.nearest_point(p).distance_squared(p));
        }
    }
    for e in edges_a {
        for f in edges_b {
            best = lesser(best, edge_interior_distance_squared(e, f));
        }
    }
    best
}

/// Returns true if an edge passes through the interior of a triangle.
fn pierces([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let volume = |u: DVec3, v: DVec3, w: DVec3| (u - p).dot((v - p).cross(w - p));
    let normal = (b - a).cross(c - a);
    let (s, t) = (normal.dot(p - a), normal.dot(q - a));
    let sides = [volume(q, a, b), volume(q, b, c), volume(q, c, a)];
    s * t < 0.0 && (sides.iter().all(|&v| v > 0.0) || sides.iter().all(|&v| v < 0.0))
}

/// Returns the squared distance of the lines of two edges; infinity unless both nearest points are on the edges.
fn edge_interior_distance_squared(e: [DVec3; 2], f: [DVec3; 2]) -> f64 {
    let (u, v, w) = (e[1] - e[0], f[1] - f[0], e[0] - f[0]);
    let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
    let det = uu * vv - uv * uv;
    if det > 0.0 {
        let s = (uv * v.dot(w) - vv * u.dot(w)) / det;
        let t = (uu * v.dot(w) - uv * u.dot(w)) / det;
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            return (e[0] + s * u).distance_squared(f[0] + t * v);
        }
    }
    f64::INFINITY
}

/// Returns the point of a segment that is nearest to `p`.
pub fn nearest_on_segment(p: DVec3, [a, b]: [DVec3; 2]) -> DVec3 {
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    // NaN for a segment of no length: either end will do.
    if t > 0.0 {
        a + lesser(1.0, t) * along
    } else {
        a
    }
}

/// Returns the point of a triangle that is nearest to `p`.
pub fn nearest_on_triangle(p: DVec3, corners: [DVec3; 3]) -> DVec3 {
    Face::new(corners).nearest_point(p)
}

/// A triangle in the form from which its nearest points are computed.
pub(crate) struct Face {
    /// The corner points, reordered so that the longest edge is between the first two.
    pub(crate) corners: [DVec3; 3],
    /// The unit vector along the longest edge. For a needle, whose normal is mostly rounding, this vector and `across`
    /// are accurate to the last relevant digits.
    edge_direction: DVec3,
    /// The unit vector in the triangle's plane that is perpendicular to the longest edge.
    edge_normal: DVec3,
    length: f64,
    /// The coordinate of the last corner along the longest edge.
    apex: f64,
    height: f64,
}

impl Face {
    pub(crate) fn new(corners: [DVec3; 3]) -> Self {
        let corners = longest_edge_first(corners);
        let [a, b, c] = corners;
        let length = b.distance(a);
        let along = (b - a) / length;
        let apex = (c - a).dot(along);
        // Orthogonalised twice: the first time leaves a rounding error that a small height magnifies.
        let across = (c - a - apex * along).normalize();
        let across = (across - across.dot(along) * along).normalize();
        Face {
            height: (c - a).dot(across),
            corners,
            edge_direction: along,
            edge_normal: across,
            length,
            apex,
        }
    }

    /// Returns the point of the triangle nearest to `p`: the projection onto its plane if that is inside, else a point
    /// on an edge.
    fn nearest_point(&self, p: DVec3) -> DVec3 {
        let [a, b, c] = self.corners;
        let (x, y) = (
            (p - a).dot(self.edge_direction),
            (p - a).dot(self.edge_normal),
        );
        let fraction = y / self.height;
        let (left, right) = (
            self.apex * fraction,
            self.length + (self.apex - self.length) * fraction,
        );
        // False for NaN, as for a triangle without area.
        let inside = y >= 0.0 && y <= self.height && x >= left && x <= right;
        let foot = if inside {
            a + x * self.edge_direction + y * self.edge_normal
        } else {
            a
        };
        let nearer = |x: DVec3, y: DVec3| {
            if y.distance_squared(p) < x.distance_squared(p) {
                y
            } else {
                x
            }
        };
        let edges = [[a, b], [b, c], [c, a]];
        edges
            .map(|edge| nearest_on_segment(p, edge))
            .into_iter()
            .fold(foot, nearer)
    }
}

fn longest_edge_first([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    let (ab, bc, ca) = (a.distance(b), b.distance(c), c.distance(a));
    if ab >= bc && ab >= ca {
        [a, b, c]
    } else if bc >= ca {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Returns true if a point is inside a closed mesh: the solid angles of the mesh's faces add up to more than half the
/// sphere.
pub fn contains(mesh: &Mesh, points: &[DVec3], p: DVec3) -> bool {
    let angle = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| points[v as usize] - p);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(denominator)
    };
    mesh.faces.iter().map(angle).sum::<f64>() > 2.0 * PI
}

/// An axis-aligned bounding box of a face or of a group of faces.
#[derive(Clone, Copy)]
struct Bounds {
    lo: DVec3,
    hi: DVec3,
}

impl Bounds {
    const EMPTY: Bounds = Bounds {
        lo: DVec3::INFINITY,
        hi: DVec3::NEG_INFINITY,
    };

    fn bounds_with_point(self, p: DVec3) -> Bounds {
        Bounds {
            lo: self.lo.min(p),
            hi: self.hi.max(p),
        }
    }

    fn union(self, other: Bounds) -> Bounds {
        self.bounds_with_point(other.lo).bounds_with_point(other.hi)
    }

    pub(crate) fn distance_squared(&self, other: &Bounds) -> f64 {
        let gap = (self.lo - other.hi)
            .max(other.lo - self.hi)
            .max(DVec3::ZERO);
        gap.length_squared()
    }
}
