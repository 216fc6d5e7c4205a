//! The plane of a leaf: how its numbers are written, and where it is.

use crate::body::Part;
use crate::stretch::Stretch;
use ccd_core::glam::DVec3;

/// How the numbers of a plane are written, coarse and fine: its normal in multiples of 1 / `normal`, its offset in multiples of
/// `offset` units of length, less than `most` of them.
struct Form {
    normal: f64,
    offset: f64,
    most: f64,
    bytes: [usize; 2],
}

const FORMS: [Form; 2] = [
    Form {
        normal: (1u64 << 14) as f64,
        offset: (1u64 << 20) as f64,
        most: (1u64 << 31) as f64,
        bytes: [2, 4],
    },
    Form {
        normal: (1u64 << 50) as f64,
        offset: 1.0,
        most: (1u64 << 55) as f64,
        bytes: [7, 7],
    },
];

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

/// A plane that keeps parts apart, in the numbers of its form.
pub(crate) struct Plane {
    form: &'static Form,
    step: u8,
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
        let unit_axis = axis.normalize_or_zero();
        for (fine, form) in FORMS.iter().enumerate() {
            // Rounded towards zero it is no longer than 1, although the length of the unit axis is rounded.
            let normal = (unit_axis * (form.normal - 2.0)).trunc();
            for frame in 0..3 {
                if frame > 0 && self.stretch.rests(frame - 1) {
                    continue;
                }
                let seen = (normal / form.normal, frame);
                let unit = self.unit * form.offset;
                let range = self
                    .stretch
                    .room(self.parts, seen, self.least)
                    .map(|x| x / unit);
                let plane = Plane {
                    form,
                    step: (3 + 3 * fine + frame) as u8,
                    frame,
                    normal,
                    range,
                    offset: 0.0,
                };
                let plane = plane.at(SHARES[0]);
                if plane.is_some() {
                    return plane;
                }
            }
        }
        None
    }

    /// Returns the plane that is cheapest to check of those across some axes.
    pub(crate) fn cheapest_plane(&self, axes: [DVec3; 2]) -> Option<Plane> {
        let planes = axes.into_iter().filter_map(|axis| self.plane(axis));
        let planes: Vec<Plane> = planes
            .flat_map(|plane| SHARES.map(|share| plane.at(share)))
            .flatten()
            .collect();
        planes.into_iter().min_by_key(|plane| {
            let seen = (plane.normal / plane.form.normal, plane.frame);
            let offset = plane.offset * self.unit * plane.form.offset;
            self.stretch.looks(self.parts, seen, self.least, offset)
        })
    }
}

impl Plane {
    /// Returns the plane at a share of its range, if a multiple of its unit is there.
    fn at(&self, share: f64) -> Option<Plane> {
        let [least, most] = self.range;
        let offset = (least + share * (most - least)).round();
        let fits = least <= offset && offset <= most && offset.abs() < self.form.most;
        fits.then_some(Plane { offset, ..*self })
    }

    /// Writes the step.
    pub(crate) fn write(&self, steps: &mut Vec<u8>) {
        let [of_normal, of_offset] = self.form.bytes;
        steps.push(self.step);
        for x in self.normal.to_array() {
            steps.extend(&(x as i64).to_le_bytes()[..of_normal]);
        }
        steps.extend(&(self.offset as i64).to_le_bytes()[..of_offset]);
    }
}
