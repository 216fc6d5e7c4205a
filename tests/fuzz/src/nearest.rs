//! Computes the distance or the penetration depth of two triangles.
//!
//! For either number type: the property suite's referee, which judges a hundred times as many pairs, has a faster
//! one in f64 that names the points.

use crate::vector::{Number, Vector};

pub type Triangle<N> = [Vector<N>; 3];

/// Returns the distance of two triangles, the least over all candidate pairs of points; it is never too small except
/// for rounding. It is 0 if an edge of one passes through the other.
pub fn distance<N: Number>(s: &Triangle<N>, t: &Triangle<N>) -> N {
    let (edges_s, edges_t) = (Edge::all(s), Edge::all(t));
    let (face_s, face_t) = (normal(s), normal(t));
    if pierces(&edges_s, t, face_t) || pierces(&edges_t, s, face_s) {
        return N::from_f64(0.0);
    }
    let mut way = s[0] - t[0];
    let mut best = way.dot(way);
    let mut offer = |w: Vector<N>| {
        let square = w.dot(w);
        if square < best {
            (best, way) = (square, w);
        }
    };
    for i in 0..3 {
        offset_to_face(s[i], t, face_t)
            .into_iter()
            .for_each(&mut offer);
        offset_to_face(t[i], s, face_s)
            .into_iter()
            .for_each(&mut offer);
        for j in 0..3 {
            offer(s[i] - t[j]);
            offer(edges_t[j].offset_from(s[i]));
            offer(edges_s[i].offset_from(t[j]));
            offset_between_lines(&edges_s[i], &edges_t[j])
                .into_iter()
                .for_each(&mut offer);
        }
    }
    way.length()
}

/// A side of a triangle, prepared for distances.
struct Edge<N> {
    from: Vector<N>,
    edge_vector: Vector<N>,
    /// The edge vector multiplied by `scale`, a power of two that keeps its square from overflow and underflow.
    scaled_edge_vector: Vector<N>,
    scale: N,
    scaled_length_squared: N,
}

impl<N: Number> Edge<N> {
    fn all(t: &Triangle<N>) -> [Self; 3] {
        let edge = |from: Vector<N>, to: Vector<N>| {
            let way = to - from;
            let along = way.scaled_to_about_one();
            let (scale, square) = (ratio(along, way), along.dot(along));
            Edge {
                from,
                edge_vector: way,
                scaled_edge_vector: along,
                scale,
                scaled_length_squared: square,
            }
        };
        [edge(t[0], t[1]), edge(t[1], t[2]), edge(t[2], t[0])]
    }

    /// Returns the vector from a point to the nearest point of the edge. If the edge has no length, NaN makes that
    /// its start.
    fn offset_from(&self, p: Vector<N>) -> Vector<N> {
        let fraction =
            self.scaled_edge_vector.dot(p - self.from) / self.scaled_length_squared * self.scale;
        self.from + self.edge_vector * clamp_to_unit_interval(fraction) - p
    }
}

#[inline]
fn clamp_to_unit_interval<N: Number>(x: N) -> N {
    let (zero, one) = (N::from_f64(0.0), N::from_f64(1.0));
    // NaN becomes 0.
    if x > one {
        one
    } else if x > zero {
        x
    } else {
        zero
    }
}

/// Returns the ratio of `long` to `short`, two parallel vectors.
#[inline]
fn ratio<N: Number>(long: Vector<N>, short: Vector<N>) -> N {
    let ([x, y, z], [u, v, w]) = (long.0, short.0);
    let [a, b, c] = [x, y, z].map(|x| x.to_f64().abs());
    if a >= b && a >= c {
        x / u
    } else if b >= c {
        y / v
    } else {
        z / w
    }
}

/// Returns the vector between the nearest points of two edges' lines, if at least one of the points is on its edge.
fn offset_between_lines<N: Number>(p: &Edge<N>, q: &Edge<N>) -> Option<Vector<N>> {
    let n = p.scaled_edge_vector.cross(q.scaled_edge_vector);
    let square = n.dot(n);
    if !(square.to_f64() > 0.0) {
        return None;
    }
    let w = q.from - p.from;
    let x = w.cross(q.scaled_edge_vector).dot(n) / square * p.scale;
    let y = w.cross(p.scaled_edge_vector).dot(n) / square * q.scale;
    let (zero, one) = (N::from_f64(0.0), N::from_f64(1.0));
    let within = |x: N| x >= zero && x <= one;
    // Clamped anyway, since rounding may put the other point slightly beyond its end.
    (within(x) || within(y)).then(|| {
        w + q.edge_vector * clamp_to_unit_interval(y) - p.edge_vector * clamp_to_unit_interval(x)
    })
}

/// Returns the vector from a point to its projection onto a triangle's plane, if the projection is within the triangle.
fn offset_to_face<N: Number>(
    p: Vector<N>,
    t: &Triangle<N>,
    face: Option<Vector<N>>,
) -> Option<Vector<N>> {
    let n = face?;
    let down = n * n.dot(t[0] - p);
    is_over_triangle(p + down, t, n).then_some(down)
}

fn is_over_triangle<N: Number>(x: Vector<N>, t: &Triangle<N>, n: Vector<N>) -> bool {
    let ways = [
        (t[1] - t[0]).scaled_to_about_one(),
        (t[2] - t[1]).scaled_to_about_one(),
        (t[0] - t[2]).scaled_to_about_one(),
    ];
    (0..3).all(|k| n.dot(ways[k].cross(x - t[k])) >= N::from_f64(0.0))
        // Beyond the ends of a needle, rounding alone decides the side of a point.
        && ways.iter().all(|way| {
            let heights = [way.dot(t[0] - x), way.dot(t[1] - x), way.dot(t[2] - x)];
            heights.iter().any(|&h| h >= N::from_f64(0.0)) && heights.iter().any(|&h| h <= N::from_f64(0.0))
        })
}

/// Returns the unit normal of a triangle, or `None` if its area is within rounding.
pub fn normal<N: Number>(t: &Triangle<N>) -> Option<Vector<N>> {
    let (u, v) = (
        (t[1] - t[0]).scaled_to_about_one(),
        (t[2] - t[0]).scaled_to_about_one(),
    );
    let n = u.cross(v);
    // For an f64, thinner needles consist of their edges alone.
    (n.max_absolute_component() > 1e-30).then_some(n)?.unit()
}

/// Returns true if one of three edges passes through the interior of a triangle.
fn pierces<N: Number>(edges: &[Edge<N>; 3], t: &Triangle<N>, face: Option<Vector<N>>) -> bool {
    let zero = N::from_f64(0.0);
    let Some(n) = face else { return false };
    let height = |k: usize| n.dot(edges[k].from - t[0]);
    let heights = [height(0), height(1), height(2)];
    (0..3).any(|k| {
        let (up, down) = (heights[k], heights[(k + 1) % 3]);
        let crosses = (up > zero && down < zero) || (up < zero && down > zero);
        crosses
            && is_over_triangle(
                edges[k].from + edges[k].edge_vector * (up / (up - down)),
                t,
                n,
            )
    })
}

/// Returns the penetration depth of two triangles: the least displacement that makes their interiors disjoint, over all
/// separating axes. It is negative if a gap separates them, and 0 if one is flat along every axis.
pub fn penetration_depth<N: Number>(s: &Triangle<N>, t: &Triangle<N>) -> N {
    let edges =
        |t: &Triangle<N>| [t[1] - t[0], t[2] - t[1], t[0] - t[2]].map(Vector::scaled_to_about_one);
    let (es, et, ns, nt) = (edges(s), edges(t), normal(s), normal(t));
    let mut axes: Vec<Vector<N>> = ns.into_iter().chain(nt).collect();
    for e in es {
        axes.extend(et.iter().filter_map(|&f| e.cross(f).unit()));
    }
    for (n, edges) in [(ns, es), (nt, et)] {
        axes.extend(edges.iter().filter_map(|&e| n?.cross(e).unit()));
    }
    let overlap = |n: &Vector<N>| {
        let range = |t: &Triangle<N>| {
            let h = t.map(|p| n.dot(p - s[0]));
            let least = h.iter().fold(h[0], |m, &x| if x < m { x } else { m });
            (
                least,
                h.iter().fold(h[0], |m, &x| if x > m { x } else { m }),
            )
        };
        let ((a, b), (c, d)) = (range(s), range(t));
        if d - a < b - c { d - a } else { b - c }
    };
    let least = |m: Option<N>, x: N| Some(m.map_or(x, |m| if x < m { x } else { m }));
    axes.iter()
        .map(overlap)
        .fold(None, least)
        .unwrap_or(N::from_f64(0.0))
}
