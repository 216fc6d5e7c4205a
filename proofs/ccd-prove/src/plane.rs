//! The plane of a leaf: how its numbers are written, and where it is.

use crate::stretch::Stretch;
use crate::tree::Part;
use ccd_core::glam::DVec3;

/// The normal of a plane is written in multiples of 2⁻⁵⁰.
const NORMAL_UNIT: f64 = (1u64 << 50) as f64;

/// Each number of a plane has 7 bytes, with its sign.
const MOST_OFFSET: f64 = (1u64 << 55) as f64;

/// Where a plane may be: as shares of what both parts leave to it, from A to B.
const SHARES: [f64; 5] = [0.5, 0.65, 0.35, 0.8, 0.2];

/// What a plane has to keep apart, and how far from it.
pub(crate) struct Gap<'a> {
    pub(crate) parts: [Part; 2],
    pub(crate) stretch: &'a Stretch<'a>,
    pub(crate) least: f64,
    /// The unit of length.
    pub(crate) unit: f64,
}

/// A plane that keeps parts apart, in the numbers in which it is written.
pub(crate) struct Plane {
    /// What it turns with: the world, A, B.
    frame: usize,
    normal: DVec3,
    /// The least and the greatest offset.
    range: [f64; 2],
    offset: f64,
}

impl Gap<'_> {
    /// Returns a plane across an axis, about half way between the parts.
    pub(crate) fn plane(&self, axis: DVec3) -> Option<Plane> {
        // Rounded towards zero it is no longer than 1, although the length of the unit axis is rounded.
        let normal = (axis.normalize_or_zero() * (NORMAL_UNIT - 2.0)).trunc();
        let frames = (0..3).filter(|&frame| frame == 0 || !self.stretch.rests(frame - 1));
        let mut planes = frames.filter_map(|frame| {
            let seen = (normal / NORMAL_UNIT, frame);
            let room = self.stretch.room(self.parts, seen, self.least);
            let plane = Plane {
                frame,
                normal,
                range: room.map(|x| x / self.unit),
                offset: 0.0,
            };
            plane.at(SHARES[0])
        });
        planes.next()
    }

    /// Returns how often the checker looks at a box for a plane across an axis, about half way between the parts; `None` if it does
    /// not keep them apart.
    pub(crate) fn looks(&self, axis: DVec3) -> Option<usize> {
        self.plane(axis).map(|plane| self.looks_for(&plane))
    }

    /// Returns the plane that is cheapest to check of those across some axes.
    pub(crate) fn cheapest_plane(&self, axes: [DVec3; 2]) -> Option<Plane> {
        let planes = axes.into_iter().filter_map(|axis| self.plane(axis));
        let places = planes.flat_map(|plane| SHARES.map(|share| plane.at(share)));
        places.flatten().min_by_key(|plane| self.looks_for(plane))
    }

    pub(crate) fn looks_for(&self, plane: &Plane) -> usize {
        let seen = (plane.normal / NORMAL_UNIT, plane.frame);
        let offset = plane.offset * self.unit;
        self.stretch.looks(self.parts, seen, self.least, offset)
    }
}

impl Plane {
    /// Returns the plane at a share of its range, if a multiple of its unit is there.
    fn at(&self, share: f64) -> Option<Plane> {
        let [least, most] = self.range;
        let offset = (least + share * (most - least)).round();
        let fits = least <= offset && offset <= most && offset.abs() < MOST_OFFSET;
        fits.then_some(Plane { offset, ..*self })
    }

    /// Writes the step.
    pub(crate) fn write(&self, steps: &mut Vec<u8>) {
        steps.push(3 + self.frame as u8);
        for x in [self.normal.x, self.normal.y, self.normal.z, self.offset] {
            steps.extend(&(x as i64).to_le_bytes()[..7]);
        }
    }
}
