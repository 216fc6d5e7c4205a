//! The bounding box tree over a body's triangles. The certificate of the body describes it.

use crate::bounds::{Bounds, by_coordinate};
use crate::split::split;
use crate::stop::Stop;
use ccd_core::glam::{DVec3, DVec4};
use ccd_core::order::greater;

/// A binary tree over triangles. A part with more than one triangle has two parts.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// The triangles in the order of the tree. A corner has the coordinates x, y, z and its radius.
    pub(crate) triangles: Vec<[DVec4; 3]>,
    /// The nodes in preorder: each before all nodes of its first part, and these before all nodes of its second part.
    nodes: Vec<Node>,
}

/// A part of the triangles, given by the index of its node.
pub(crate) type Part = usize;

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// The radius of the bounding ball around the center of the box.
    ball_radius: f64,
    /// The index of the first triangle.
    triangle: usize,
    /// The second part. `None` for a single triangle.
    second: Option<Part>,
}

impl Tree {
    /// The part with all triangles.
    pub(crate) const WHOLE: Part = 0;

    /// Builds a tree over triangles. Also returns the numbers of the certificate, one for each node in preorder. A single triangle
    /// has its index, and any other part the number of triangles of its first part.
    pub(crate) fn new<S: Stop>(
        triangles: &[[DVec4; 3]],
        stop: S,
    ) -> Result<(Tree, Vec<u32>), S::Stopped> {
        let boxes: Vec<Bounds> = triangles.iter().map(Bounds::of).collect();
        let mut order: Vec<u32> = (0..triangles.len() as u32).collect();
        let mut tree = Tree {
            triangles: Vec::new(),
            nodes: Vec::new(),
        };
        let mut numbers = Vec::new();
        tree.add((triangles, &boxes), (&mut order, 0), &mut numbers, stop)?;
        Ok((tree, numbers))
    }

    /// Adds a part at a depth, and all parts below it.
    fn add<S: Stop>(
        &mut self,
        (triangles, boxes): (&[[DVec4; 3]], &[Bounds]),
        (part, depth): (&mut [u32], usize),
        numbers: &mut Vec<u32>,
        stop: S,
    ) -> Result<(), S::Stopped> {
        let node = self.nodes.len();
        let corners = part.iter().flat_map(|&index| triangles[index as usize]);
        self.nodes.push(Node::of(corners, self.triangles.len()));
        if let [index] = *part {
            numbers.push(index);
            self.triangles.push(triangles[index as usize]);
        } else {
            let count = split(boxes, part, depth, stop)?;
            numbers.push(count as u32);
            let (first, second) = part.split_at_mut(count);
            self.add((triangles, boxes), (first, depth + 1), numbers, stop)?;
            self.nodes[node].second = Some(self.nodes.len());
            self.add((triangles, boxes), (second, depth + 1), numbers, stop)?;
        }
        Ok(())
    }

    /// Returns the first and the second part of a part. Returns `None` for a single triangle.
    pub(crate) fn halves(&self, part: Part) -> Option<[Part; 2]> {
        Some([part + 1, self.nodes[part].second?])
    }

    /// Returns the least height of a part along a direction: the least height of a corner, less the radius around it.
    pub(crate) fn least_height(&self, part: Part, direction: DVec3) -> f64 {
        let above_all = (f64::INFINITY, 0);
        self.lower_corner(part, direction.extend(-1.0), above_all).0
    }

    /// Returns the lowest corner of a part along a direction without radii, and its index.
    pub(crate) fn lowest_corner(&self, part: Part, direction: DVec3) -> (u32, DVec3) {
        let above_all = (f64::INFINITY, 3 * self.nodes[part].triangle);
        let (_, index) = self.lower_corner(part, direction.extend(0.0), above_all);
        let corner = self.triangles[index / 3][index % 3];
        (index as u32, corner.truncate())
    }

    /// Returns the height and the index of the lowest corner of a part along a direction. Returns `lowest` if no corner is lower.
    fn lower_corner(&self, part: Part, direction: DVec4, lowest: (f64, usize)) -> (f64, usize) {
        let Some(halves) = self.halves(part) else {
            let triangle = self.nodes[part].triangle;
            let corners = self.triangles[triangle].iter().enumerate();
            return corners.fold(lowest, |lowest, (k, corner)| {
                let height = direction.dot(*corner);
                if height < lowest.0 {
                    (height, 3 * triangle + k)
                } else {
                    lowest
                }
            });
        };
        let mut halves = halves.map(|half| (self.nodes[half].bounds.least_height(direction), half));
        if halves[1].0 < halves[0].0 {
            halves.swap(0, 1);
        }
        halves.into_iter().fold(lowest, |lowest, (bound, half)| {
            if bound < lowest.0 {
                self.lower_corner(half, direction, lowest)
            } else {
                lowest
            }
        })
    }

    /// Returns the number of boxes and triangles that the checker visits to confirm that the part has a height of at least `limit`
    /// along `direction`.
    pub(crate) fn visits_above(&self, part: Part, direction: DVec3, limit: f64) -> usize {
        let bounds = &self.nodes[part].bounds;
        let is_low = bounds.least_height(direction.extend(-1.0)) < limit;
        let halves = self.halves(part).filter(|_| is_low);
        let visits =
            |halves: [Part; 2]| halves.map(|half| self.visits_above(half, direction, limit));
        1 + halves.map_or(0, |halves| visits(halves).iter().sum())
    }

    /// Returns the center and the radius of the bounding ball of a part.
    pub(crate) fn ball(&self, part: Part) -> (DVec3, f64) {
        let node = &self.nodes[part];
        (node.bounds.center(), node.ball_radius)
    }

    /// Returns the number of boxes that the checker visits to confirm that all points of the part are farther than `limit` from
    /// `point`. Returns `None` if a box of a triangle is nearer.
    pub(crate) fn visits_beyond(&self, part: Part, point: DVec3, limit: f64) -> Option<usize> {
        let Bounds { least, greatest } = &self.nodes[part].bounds;
        let point4 = point.extend(0.0);
        let offset = by_coordinate(*least - point4, point4 - *greatest, greater);
        let offset = by_coordinate(offset, DVec4::ZERO, greater).truncate();
        if offset.length() > limit + greatest.w {
            return Some(1);
        }
        let [first, second] = self.halves(part)?;
        let visits = self.visits_beyond(first, point, limit)?;
        Some(1 + visits + self.visits_beyond(second, point, limit)?)
    }

    /// Returns an upper bound of the distance from `point` to any point of a part.
    pub(crate) fn reach(&self, part: Part, point: DVec3) -> f64 {
        let (center, radius) = self.ball(part);
        center.distance(point) + radius
    }

    /// Returns the largest radius of a corner.
    pub(crate) fn largest_radius(&self) -> f64 {
        self.nodes[Tree::WHOLE].bounds.greatest.w
    }

    /// Returns half of the diagonal of a part's box, and 0 for a single triangle, which cannot be split.
    pub(crate) fn radius(&self, part: Part) -> f64 {
        let Node { bounds, second, .. } = &self.nodes[part];
        let size = (bounds.greatest - bounds.least).truncate();
        second.map_or(0.0, |_| 0.5 * size.length())
    }
}

impl Node {
    fn of(corners: impl Iterator<Item = DVec4> + Clone, triangle: usize) -> Node {
        let bounds = Bounds::around(corners.clone());
        let squares = corners.map(|corner| corner.truncate().distance_squared(bounds.center()));
        Node {
            bounds,
            ball_radius: squares.fold(0.0, greater).sqrt() + bounds.greatest.w,
            triangle,
            second: None,
        }
    }
}
