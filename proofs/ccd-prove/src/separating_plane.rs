//! The search for the separating plane of a leaf.

use crate::interval::{PairInterval, PlaneDirection};
use crate::step::Step;
use crate::tree::NodeIndex;
use ccd_core::glam::DVec3;

/// The inverse of the unit of a normal's coordinates, which is 2⁻⁵⁰.
const NORMAL_SCALE: f64 = (1u64 << 50) as f64;

/// The limit of the absolute value of a plane's offset, in units of length. A certificate stores an offset as a signed
/// integer of 7 bytes.
const MAX_OFFSET: f64 = (1u64 << 55) as f64;

/// The positions at which a plane is tried, from 0 at the node of A to 1 at the node of B. The first position is halfway.
const POSITIONS: [f64; 5] = [0.5, 0.65, 0.35, 0.8, 0.2];

/// The two nodes to separate, and the required distance of each from the plane.
pub(crate) struct PlaneSearch<'a> {
    pub(crate) nodes: [NodeIndex; 2],
    pub(crate) interval: &'a PairInterval<'a>,
    pub(crate) required_gap: f64,
    /// The unit of length of the certificate.
    pub(crate) length_unit: f64,
}

/// A separating plane, in the numbers of the certificate.
pub(crate) struct SeparatingPlane {
    /// The frame with which the plane rotates: 0 is the world, 1 is A, 2 is B.
    frame: usize,
    normal: DVec3,
    /// The least and the greatest possible offset.
    offset_range: [f64; 2],
    offset: f64,
}

impl PlaneSearch<'_> {
    /// Returns a plane perpendicular to an axis, about halfway between the nodes. Returns `None` if no such plane separates them.
    fn halfway_plane(&self, axis: DVec3) -> Option<SeparatingPlane> {
        // The length of a normal has to be at most 1. Subtracting 2 and truncating compensates for the rounding of the unit axis.
        let normal = (axis.normalize_or_zero() * (NORMAL_SCALE - 2.0)).trunc();
        let frames = (0..3).filter(|&frame| frame == 0 || !self.interval.is_static(frame - 1));
        let mut planes = frames.filter_map(|frame| {
            let mut plane = SeparatingPlane {
                frame,
                normal,
                offset_range: [0.0; 2],
                offset: 0.0,
            };
            let range =
                self.interval
                    .offset_range(self.nodes, plane.direction(), self.required_gap);
            plane.offset_range = range.map(|x| x / self.length_unit);
            plane.at(POSITIONS[0])
        });
        planes.next()
    }

    /// Returns the number of boxes that the checker visits for a plane perpendicular to an axis, about halfway between the nodes.
    /// Returns `None` if no such plane separates them.
    pub(crate) fn visits_along(&self, axis: DVec3) -> Option<usize> {
        self.halfway_plane(axis).map(|plane| self.visits(&plane))
    }

    /// Returns the separating plane for which the checker visits the fewest boxes. Each candidate is perpendicular to one of the axes.
    pub(crate) fn cheapest_plane(&self, axes: [DVec3; 2]) -> Option<SeparatingPlane> {
        let planes = axes.into_iter().filter_map(|axis| self.halfway_plane(axis));
        let candidates = planes.flat_map(|plane| POSITIONS.map(|position| plane.at(position)));
        candidates.flatten().min_by_key(|plane| self.visits(plane))
    }

    fn visits(&self, plane: &SeparatingPlane) -> usize {
        let offset = plane.offset * self.length_unit;
        self.interval
            .plane_visits(self.nodes, plane.direction(), self.required_gap, offset)
    }
}

impl SeparatingPlane {
    fn direction(&self) -> PlaneDirection {
        PlaneDirection {
            normal: self.normal / NORMAL_SCALE,
            frame: self.frame,
        }
    }

    /// Returns the plane at a position in its offset range, from 0 to 1. Returns `None` if the rounded offset is not in the range.
    fn at(&self, position: f64) -> Option<SeparatingPlane> {
        let [least, greatest] = self.offset_range;
        let offset = (least + position * (greatest - least)).round();
        let fits = least <= offset && offset <= greatest && offset.abs() < MAX_OFFSET;
        fits.then_some(SeparatingPlane { offset, ..*self })
    }

    /// Appends the leaf with this plane.
    pub(crate) fn write(&self, steps: &mut Vec<u8>) {
        steps.push(Step::Plane(self.frame).opcode());
        for x in [self.normal.x, self.normal.y, self.normal.z, self.offset] {
            steps.extend(&(x as i64).to_le_bytes()[..7]);
        }
    }
}
