//! The elementary tests of two triangles in motion: a corner against a face, an edge against an edge.

use super::relative::MotionEnclosure;
use crate::method::rival::Placement;
use crate::method::rival::interval::{Interval, IntervalVec};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};

/// A triangle with its edge vectors, its normal, and the inward normals of its edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct TriangleWithNormals {
    corners: [DVec3; 3],
    /// The edge vectors: edge k leads from corner k to the next.
    edges: [DVec3; 3],
    triangle_normal: DVec3,
    /// For each edge, a vector in the triangle's plane that is perpendicular to the edge and points into the triangle.
    inward_edge_normals: [DVec3; 3],
}

/// A test of one feature of the first triangle against one feature of the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ElementaryTest {
    /// A corner of the first triangle against the second's face.
    VertexFace(usize),
    /// The face of the first triangle against a corner of the second.
    FaceVertex(usize),
    /// An edge of the first triangle against an edge of the second.
    EdgeEdge(usize, usize),
}

/// The set of elementary tests that may still have a root, as bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ElementaryTestSet(u16);

/// Two triangles, each in its body's frame. A [`Placement`] or a [`MotionEnclosure`] maps the first into the frame of
/// the second.
#[derive(Clone, Copy, Debug)]
pub(super) struct TrianglePair {
    pub(super) a: TriangleWithNormals,
    pub(super) b: TriangleWithNormals,
}

impl TriangleWithNormals {
    pub(super) fn new(corners: &[DVec3; 3]) -> Self {
        let [a, b, c] = *corners;
        let edges = [b - a, c - b, a - c];
        let normal = edges[0].cross(edges[1]);
        TriangleWithNormals {
            corners: *corners,
            edges,
            triangle_normal: normal,
            inward_edge_normals: edges.map(|edge| normal.cross(edge)),
        }
    }

    /// Returns true for a triangle without area: nothing can hit its face, but its edges and
    /// corners are tested.
    fn is_degenerate(&self) -> bool {
        self.triangle_normal == DVec3::ZERO
    }
}

impl ElementaryTest {
    /// The number of elementary tests of two triangles.
    const ELEMENTARY_TEST_COUNT: usize = 15;

    /// Returns the test with the given number: corners first, then faces, then pairs of edges.
    fn nth_test(number: usize) -> ElementaryTest {
        match number {
            0..3 => ElementaryTest::VertexFace(number),
            3..6 => ElementaryTest::FaceVertex(number - 3),
            _ => ElementaryTest::EdgeEdge((number - 6) / 3, number % 3),
        }
    }
}

impl ElementaryTestSet {
    /// The set without any test.
    const NONE: ElementaryTestSet = ElementaryTestSet(0);

    /// The set of all elementary tests.
    pub(super) const ALL: ElementaryTestSet =
        ElementaryTestSet((1 << ElementaryTest::ELEMENTARY_TEST_COUNT) - 1);

    /// Returns true if no test is in the set.
    pub(super) fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Returns the tests of the set for which `holds` is true.
    pub(super) fn filter_tests(
        self,
        mut holds: impl FnMut(ElementaryTest) -> bool,
    ) -> ElementaryTestSet {
        let (mut kept, mut left) = (0, self.0);
        while left != 0 {
            let k = left.trailing_zeros();
            if holds(ElementaryTest::nth_test(k as usize)) {
                kept |= 1 << k;
            }
            left &= left - 1;
        }
        ElementaryTestSet(kept)
    }
}

impl TrianglePair {
    /// Returns the value of a test's contact function at a placement of the first triangle. It is zero where the corner
    /// meets the plane, or where both lines meet.
    pub(super) fn contact_function(&self, test: ElementaryTest, at: &Placement) -> f64 {
        let (a, b) = (&self.a, &self.b);
        match test {
            ElementaryTest::VertexFace(i) => {
                (at.apply(a.corners[i]) - b.corners[0]).dot(b.triangle_normal)
            }
            ElementaryTest::FaceVertex(j) => {
                (b.corners[j] - at.apply(a.corners[0])).dot(at.rotation * a.triangle_normal)
            }
            ElementaryTest::EdgeEdge(i, j) => {
                let axis = (at.rotation * a.edges[i]).cross(b.edges[j]);
                (b.corners[j] - at.apply(a.corners[i])).dot(axis)
            }
        }
    }

    /// Encloses the rate of change of a test's contact function over the interval of the given enclosures.
    pub(super) fn contact_function_rate_enclosure(
        &self,
        test: ElementaryTest,
        now: &MotionEnclosure,
        rates: &MotionEnclosure,
    ) -> Interval {
        let (a, b) = (&self.a, &self.b);
        match test {
            ElementaryTest::VertexFace(i) => rates
                .enclose_transformed_point(a.corners[i])
                .dot_vector(b.triangle_normal),
            ElementaryTest::FaceVertex(j) => {
                let between =
                    point_minus(b.corners[j], now.enclose_transformed_point(a.corners[0]));
                between.dot(rates.rotation * a.triangle_normal)
                    - rates
                        .enclose_transformed_point(a.corners[0])
                        .dot(now.rotation * a.triangle_normal)
            }
            ElementaryTest::EdgeEdge(i, j) => {
                let between =
                    point_minus(b.corners[j], now.enclose_transformed_point(a.corners[i]));
                let axis = (now.rotation * a.edges[i]).cross_vector(b.edges[j]);
                let axis_rate = (rates.rotation * a.edges[i]).cross_vector(b.edges[j]);
                between.dot(axis_rate) - rates.enclose_transformed_point(a.corners[i]).dot(axis)
            }
        }
    }

    /// Returns the given tests that may have a root over the interval of the enclosure.
    ///
    /// The result is empty if all corners of one triangle stay on one side of the other's plane.
    pub(super) fn tests_with_possible_roots(
        &self,
        tests: ElementaryTestSet,
        now: &MotionEnclosure,
    ) -> ElementaryTestSet {
        let (a, b) = (&self.a, &self.b);
        let corners = a
            .corners
            .map(|corner| now.enclose_transformed_point(corner));
        let over_b = corners.map(|x| x.minus_point(b.corners[0]).dot_vector(b.triangle_normal));
        if have_same_sign(over_b) {
            return ElementaryTestSet::NONE;
        }
        let normal = now.rotation * a.triangle_normal;
        let over_a = b.corners.map(|x| point_minus(x, corners[0]).dot(normal));
        if have_same_sign(over_a) {
            return ElementaryTestSet::NONE;
        }
        tests.filter_tests(|test| match test {
            ElementaryTest::VertexFace(i) => {
                !(b.is_degenerate() || over_b[i].excludes_zero())
                    && self.may_project_into_b(corners[i])
            }
            ElementaryTest::FaceVertex(j) => {
                !(a.is_degenerate() || over_a[j].excludes_zero())
                    && self.may_project_into_a(b.corners[j], &corners, now)
            }
            ElementaryTest::EdgeEdge(i, j) => self.edges_may_meet((i, j), corners[i], now),
        })
    }

    /// Returns true if the projection of a corner of the first triangle may fall into the second triangle.
    fn may_project_into_b(&self, corner: IntervalVec) -> bool {
        let b = &self.b;
        (0..3).all(|k| {
            let inside = corner
                .minus_point(b.corners[k])
                .dot_vector(b.inward_edge_normals[k]);
            !(inside.high() < 0.0)
        })
    }

    /// Returns true if the projection of a corner of the second triangle may fall into the first triangle.
    fn may_project_into_a(
        &self,
        corner: DVec3,
        corners: &[IntervalVec; 3],
        now: &MotionEnclosure,
    ) -> bool {
        (0..3).all(|k| {
            let inward = now.rotation * self.a.inward_edge_normals[k];
            !(point_minus(corner, corners[k]).dot(inward).high() < 0.0)
        })
    }

    /// Returns true if two edges may have a point in common.
    ///
    /// With the points `p + s e` and `q + u g`, `w = q − p` and `c = e × g`, a common point needs `w · c
    /// = 0`, `w × g = s c`, `w × e = u c` and `w · g = s e·g − u g·g`, where s and u are between 0 and
    /// 1. The last three conditions also separate parallel edges, for which `c` and `w · c` vanish.
    fn edges_may_meet(&self, edges: (usize, usize), p: IntervalVec, now: &MotionEnclosure) -> bool {
        let g = self.b.edges[edges.1];
        let w = point_minus(self.b.corners[edges.1], p);
        let e = now.rotation * self.a.edges[edges.0];
        let c = e.cross_vector(g);
        if w.dot(c).excludes_zero() {
            return false;
        }
        let at_s = w.cross_vector(g);
        if is_outside_scalings_of(at_s, c) {
            return false;
        }
        let at_u = w.cross(e);
        if is_outside_scalings_of(at_u, c) {
            return false;
        }
        let (along, of_e, of_g) = (w.dot_vector(g), e.dot_vector(g), g.length_squared());
        if along.low() > greater(0.0, of_e.high()) || along.high() < lesser(0.0, of_e.low()) - of_g
        {
            return false;
        }
        let square = c.dot(c);
        let fraction = |x: IntervalVec| {
            let s = x.dot(c);
            !(s.high() < 0.0 || (square - s).high() < 0.0)
        };
        fraction(at_s) && fraction(at_u)
    }
}

impl MotionEnclosure {
    /// Returns all positions of a point of the first body, or all its velocities if `self` encloses
    /// rates.
    #[inline]
    pub(super) fn enclose_transformed_point(&self, point: DVec3) -> IntervalVec {
        self.rotation * point + self.offset
    }
}

/// Returns the difference of a point and an interval vector.
#[inline]
fn point_minus(point: DVec3, from: IntervalVec) -> IntervalVec {
    IntervalVec {
        middle: point - from.middle,
        radius: from.radius,
    }
}

/// Returns true if three intervals are all positive or all negative.
fn have_same_sign(values: [Interval; 3]) -> bool {
    values.iter().all(|value| value.low() > 0.0) || values.iter().all(|value| value.high() < 0.0)
}

/// Returns true if no vector in `part` can be a vector in `whole` times a factor from 0 to 1.
fn is_outside_scalings_of(part: IntervalVec, whole: IntervalVec) -> bool {
    (part.mignitude() - whole.magnitude()).max_element() > 0.0
}
