//! Two triangles: how far apart, or how deep in each other.

use crate::vector::{Number, Vector};

pub type Triangle<N> = [Vector<N>; 3];

/// The distance of two triangles: that of the nearest of all pairs of points that could be nearest,
/// so that it is never too small but by rounding; 0 where an edge of one passes through the other.
pub fn distance<N: Number>(s: &Triangle<N>, t: &Triangle<N>) -> N {
    if pierces(s, t) || pierces(t, s) {
        return N::of(0.0);
    }
    let mut best = (s[0] - t[0]).dot(s[0] - t[0]);
    let mut way = s[0] - t[0];
    let mut offer = |w: Vector<N>| {
        let square = w.dot(w);
        if square < best {
            (best, way) = (square, w);
        }
    };
    for i in 0..3 {
        let (p, p2) = (s[i], s[(i + 1) % 3]);
        on_face(p, t).into_iter().for_each(&mut offer);
        on_face(t[i], s).into_iter().for_each(&mut offer);
        for j in 0..3 {
            let (q, q2) = (t[j], t[(j + 1) % 3]);
            offer(p - q);
            offer(to_segment(p, q, q2));
            offer(to_segment(q, p, p2));
            between_lines([p, p2], [q, q2]).into_iter().for_each(&mut offer);
        }
    }
    way.length()
}

fn clamped<N: Number>(x: N) -> N {
    let (zero, one) = (N::of(0.0), N::of(1.0));
    // NaN goes to 0.
    if x > one {
        one
    } else if x > zero {
        x
    } else {
        zero
    }
}

/// From a point to the nearest of a segment.
fn to_segment<N: Number>(p: Vector<N>, q: Vector<N>, q2: Vector<N>) -> Vector<N> {
    let size = (q2 - q).largest();
    let along = (q2 - q).scaled();
    if !(size > 0.0) {
        return q - p;
    }
    let share = clamped(along.dot(p - q) / along.dot(along) * ratio(along, q2 - q));
    q + (q2 - q) * share - p
}

/// By how much `long` is longer than `short`, both along the same line.
fn ratio<N: Number>(long: Vector<N>, short: Vector<N>) -> N {
    let k = (0..3).fold(0, |k, i| match long.0[i].rounded().abs() > long.0[k].rounded().abs() {
        true => i,
        false => k,
    });
    long.0[k] / short.0[k]
}

/// From the nearest point of one line to that of another, where both are within the segments.
fn between_lines<N: Number>([p, p2]: [Vector<N>; 2], [q, q2]: [Vector<N>; 2]) -> Option<Vector<N>> {
    let (u, v) = ((p2 - p).scaled(), (q2 - q).scaled());
    let n = u.cross(v);
    let square = n.dot(n);
    if !(square.rounded() > 0.0) {
        return None;
    }
    let w = q - p;
    let (x, y) = (w.cross(v).dot(n) / square, w.cross(u).dot(n) / square);
    let (zero, one) = (N::of(0.0), N::of(1.0));
    let (x, y) = (x * ratio(u, p2 - p), y * ratio(v, q2 - q));
    let within = |x: N| x >= zero && x <= one;
    // Clamped all the same: rounding may have put the other one a little beyond its end.
    (within(x) || within(y)).then(|| q + (q2 - q) * clamped(y) - (p + (p2 - p) * clamped(x)))
}

/// From a point to a triangle's plane, where it lands within the triangle.
fn on_face<N: Number>(p: Vector<N>, t: &Triangle<N>) -> Option<Vector<N>> {
    let n = normal(t)?;
    let down = n * n.dot(t[0] - p);
    within(p + down, t, n).then_some(down)
}

fn within<N: Number>(x: Vector<N>, t: &Triangle<N>, n: Vector<N>) -> bool {
    (0..3).all(|k| {
        let (from, to) = (t[k], t[(k + 1) % 3]);
        n.dot((to - from).scaled().cross(x - from)) >= N::of(0.0)
    })
}

/// The unit normal; none where the triangle has no area that could be told from rounding.
pub fn normal<N: Number>(t: &Triangle<N>) -> Option<Vector<N>> {
    let (u, v) = ((t[1] - t[0]).scaled(), (t[2] - t[0]).scaled());
    let n = u.cross(v);
    // Of needles that are thinner than this nothing but the edges is left to the eye of an f64.
    (n.largest() > 1e-30).then_some(n)?.unit()
}

/// Whether an edge of one triangle passes through the inside of the other.
fn pierces<N: Number>(s: &Triangle<N>, t: &Triangle<N>) -> bool {
    let zero = N::of(0.0);
    let Some(n) = normal(t) else { return false };
    let heights = s.map(|p| n.dot(p - t[0]));
    (0..3).any(|k| {
        let (p, q) = (s[k], s[(k + 1) % 3]);
        let (up, down) = (heights[k], heights[(k + 1) % 3]);
        let crosses = (up > zero && down < zero) || (up < zero && down > zero);
        crosses && within(p + (q - p) * (up / (up - down)), t, n)
    })
}

/// How far one of two triangles would have to be moved for their insides to be apart, by the
/// separating axes; negative where a gap shows that they are. 0 where one is flat in every axis.
pub fn depth<N: Number>(s: &Triangle<N>, t: &Triangle<N>) -> N {
    let edges = |t: &Triangle<N>| [t[1] - t[0], t[2] - t[1], t[0] - t[2]].map(Vector::scaled);
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
            (least, h.iter().fold(h[0], |m, &x| if x > m { x } else { m }))
        };
        let ((a, b), (c, d)) = (range(s), range(t));
        if d - a < b - c { d - a } else { b - c }
    };
    let least = |m: Option<N>, x: N| Some(m.map_or(x, |m| if x < m { x } else { m }));
    axes.iter().map(overlap).fold(None, least).unwrap_or(N::of(0.0))
}
