//! Checks that a leaf keeps two parts apart over an interval of time. The README states and proves the lemmas.

use crate::{body::Part, motion::Interval, motion::RelativeMotion, number::*};

impl Interval<'_> {
    /// Checks that a part stays farther than `gap` above a plane, over the whole interval. The plane turns with the link
    /// `frame`. Above is the side to which the normal (x, y, z) points. The plane has the points whose dot product with the normal
    /// is d, relative to the center of that link.
    ///
    /// Returns `None` if the normal is longer than 1, or if the part's link turns too far relative to `frame`.
    pub(crate) fn stays_above_plane(&self, part: Part<'_>, ([x, y, z, d], frame): ([i64; 4], usize), gap: i64) -> Option<bool> {
        (dot([x, y, z], [x, y, z]) <= 1 << 100).then_some(())?;
        let normal = [x, y, z].map(|x| x << (FRACTION - 50));
        let [origin, link] = [frame, part.link].map(|k| &self.states[k]);
        let motion = RelativeMotion::new(self, frame, part.link)?;
        let ((middle, radius), center) = (part.node.ball, self.links.all[part.link].center);
        // The corners and the center each have an error of less than 2.
        let reach = length_bound(sub(middle, center)) + i128::from(radius) + 4;
        let error = motion.second_derivative(reach, 0) / 2 + 1 + 8 * self.links.error_bound(reach);
        let limit = (i128::from(gap + d) + error) * i128::from(ONE) - dot(normal, sub(link.position, origin.position));
        let (rise, tilt) = (dot(normal, motion.displacement), cross(normal, motion.turn));
        // Without any computed motion both ends give the same inequality. The error bound covers motion too small to compute.
        let ends: &[i64] = if (motion.turn, motion.displacement) == (ZERO, ZERO) { &[0] } else { &[-1, 1] };
        Some(ends.iter().all(|&end| {
            let direction = rotated_back(link.rotation, add(normal, tilt.map(|x| end * x)));
            part.is_above(direction, limit - i128::from(end) * rise + dot(direction, center))
        }))
    }

    /// Checks that a part stays farther than `margin` from the bounding ball around another part, over the whole interval. The
    /// ball moves relative to the link of the first part.
    ///
    /// Returns `None` if the links turn too far relative to each other.
    pub(crate) fn stays_beyond_ball(&self, part: Part<'_>, around: Part<'_>, margin: i64) -> Option<bool> {
        let [(link, center), (carrier, pivot)] = [part.link, around.link].map(|k| (&self.states[k], self.links.all[k].center));
        let ((middle, radius), motion) = (around.node.ball, RelativeMotion::new(self, part.link, around.link)?);
        let arm = rotated(carrier.rotation, sub(middle, pivot));
        let (reach, velocity) = (length_bound(arm), add(motion.displacement, cross(motion.turn, arm)));
        let error = self.links.error_bound(reach);
        let travel = length_bound(velocity) + motion.second_derivative(reach + error, 0) / 2 + 1;
        let point = add(center, rotated_back(link.rotation, add(sub(carrier.position, link.position), arm)));
        let limit = i128::from(radius + margin) + travel + 8 * error;
        Some(limit < 1 << 60 && part.is_beyond(point, limit as i64))
    }
}
