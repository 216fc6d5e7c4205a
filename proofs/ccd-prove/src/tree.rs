//! The tree of a body's triangles that its certificate describes.

use crate::bounds::{Bounds, of_each};
use crate::split::split;
use crate::stop::Stop;
use ccd_core::glam::{DVec3, DVec4};
use ccd_core::order::greater;

/// Triangles, and parts of them: a part of more than one triangle has two parts.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// In the order of the tree. Each corner has its radius after its coordinates.
    pub(crate) triangles: Vec<[DVec4; 3]>,
    /// Each before the nodes of its first part, and these before those of the second one.
    nodes: Vec<Node>,
}

/// A part of the triangles, by the number of its node.
pub(crate) type Part = usize;

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// The radius of a ball around the middle that has all in it.
    ball: f64,
    /// The first triangle.
    triangle: usize,
    /// The node of the second part, if there is more than one triangle.
    second: Option<Part>,
}

impl Tree {
    /// The part that has all triangles.
    pub(crate) const WHOLE: Part = 0;

    /// Makes a tree of triangles, and returns it as it is written: each node in its order, for a part of more than one triangle how
    /// many of them its first part has, for a triangle its number.
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
        let mut written = Vec::new();
        tree.add((triangles, &boxes), (&mut order, 0), &mut written, stop)?;
        Ok((tree, written))
    }

    /// Adds a part of the triangles that is so many splits deep.
    fn add<S: Stop>(
        &mut self,
        (triangles, boxes): (&[[DVec4; 3]], &[Bounds]),
        (part, depth): (&mut [u32], usize),
        written: &mut Vec<u32>,
        stop: S,
    ) -> Result<(), S::Stopped> {
        let node = self.nodes.len();
        let corners = part.iter().flat_map(|&number| triangles[number as usize]);
        self.nodes.push(Node::of(corners, self.triangles.len()));
        if let [number] = *part {
            written.push(number);
            self.triangles.push(triangles[number as usize]);
        } else {
            let count = split(boxes, part, depth, stop)?;
            written.push(count as u32);
            let (first, second) = part.split_at_mut(count);
            self.add((triangles, boxes), (first, depth + 1), written, stop)?;
            self.nodes[node].second = Some(self.nodes.len());
            self.add((triangles, boxes), (second, depth + 1), written, stop)?;
        }
        Ok(())
    }

    /// Returns both parts of a part; `None` if it is a triangle.
    pub(crate) fn halves(&self, part: Part) -> Option<[Part; 2]> {
        Some([part + 1, self.nodes[part].second?])
    }

    /// Returns the least height of a part along a direction, where a ball sinks below its centre by its radius.
    pub(crate) fn least_height(&self, part: Part, direction: DVec3) -> f64 {
        let none = (f64::INFINITY, 0);
        self.lowest(part, direction.extend(-1.0), none).0
    }

    /// Returns the corner of a part whose centre is lowest along a direction.
    pub(crate) fn lowest_corner(&self, part: Part, direction: DVec3) -> (u32, DVec3) {
        let none = (f64::INFINITY, 3 * self.nodes[part].triangle);
        let (_, number) = self.lowest(part, direction.extend(0.0), none);
        let corner = self.triangles[number / 3][number % 3];
        (number as u32, corner.truncate())
    }

    /// Returns the height of the corner of a part that is lowest along a direction, and its number; what is given if none is lower.
    fn lowest(&self, part: Part, direction: DVec4, found: (f64, usize)) -> (f64, usize) {
        let Some(halves) = self.halves(part) else {
            let triangle = self.nodes[part].triangle;
            let corners = self.triangles[triangle].iter().enumerate();
            return corners.fold(found, |found, (k, corner)| {
                let height = direction.dot(*corner);
                if height < found.0 {
                    (height, 3 * triangle + k)
                } else {
                    found
                }
            });
        };
        let mut halves = halves.map(|half| (self.nodes[half].bounds.least_height(direction), half));
        if halves[1].0 < halves[0].0 {
            halves.swap(0, 1);
        }
        halves.into_iter().fold(found, |found, (bound, half)| {
            if bound < found.0 {
                self.lowest(half, direction, found)
            } else {
                found
            }
        })
    }

    /// Returns how many boxes and triangles of a part have to be looked at to see that none is lower along a direction than a limit.
    pub(crate) fn looks(&self, part: Part, direction: DVec3, limit: f64) -> usize {
        let bounds = &self.nodes[part].bounds;
        let is_low = bounds.least_height(direction.extend(-1.0)) < limit;
        let halves = self.halves(part).filter(|_| is_low);
        let of_halves = |halves: [Part; 2]| halves.map(|half| self.looks(half, direction, limit));
        1 + halves.map_or(0, |halves| of_halves(halves).iter().sum())
    }

    /// Returns the centre and the radius of a ball that has all points of a part in it.
    pub(crate) fn ball(&self, part: Part) -> (DVec3, f64) {
        let node = &self.nodes[part];
        (node.bounds.middle(), node.ball)
    }

    /// Returns how many boxes of a part have to be looked at to see that all of its points are farther than a limit from a point;
    /// `None` if the boxes do not show it.
    pub(crate) fn looks_beyond(&self, part: Part, point: DVec3, limit: f64) -> Option<usize> {
        let Bounds { least, greatest } = &self.nodes[part].bounds;
        let centre = point.extend(0.0);
        let away = of_each(*least - centre, centre - *greatest, greater);
        let away = of_each(away, DVec4::ZERO, greater).truncate();
        if away.length() > limit + greatest.w {
            return Some(1);
        }
        let [first, second] = self.halves(part)?;
        let looks = self.looks_beyond(first, point, limit)?;
        Some(1 + looks + self.looks_beyond(second, point, limit)?)
    }

    /// Returns a distance from a point that no point of a part exceeds.
    pub(crate) fn reach(&self, part: Part, point: DVec3) -> f64 {
        let (middle, radius) = self.ball(part);
        middle.distance(point) + radius
    }

    /// Returns the largest radius of a corner.
    pub(crate) fn largest_radius(&self) -> f64 {
        self.nodes[Tree::WHOLE].bounds.greatest.w
    }

    /// Returns half of the size of a part, and 0 for a triangle.
    pub(crate) fn radius(&self, part: Part) -> f64 {
        let Node { bounds, second, .. } = &self.nodes[part];
        let size = (bounds.greatest - bounds.least).truncate();
        second.map_or(0.0, |_| 0.5 * size.length())
    }
}

impl Node {
    fn of(corners: impl Iterator<Item = DVec4> + Clone, triangle: usize) -> Node {
        let bounds = Bounds::around(corners.clone());
        let squares = corners.map(|corner| corner.truncate().distance_squared(bounds.middle()));
        Node {
            bounds,
            ball: squares.fold(0.0, greater).sqrt() + bounds.greatest.w,
            triangle,
            second: None,
        }
    }
}
