//! Proves that two parts stay apart over a stretch of time: the lemmas of the README.

use crate::{body::Part, motion::Stretch, motion::Way, number::*};

impl Stretch<'_> {
    /// Returns whether a part stays farther than `least` above a plane that turns with a link: on the side to which its normal points.
    /// It has the points whose product with (x, y, z) is d, from the centre of that link. `None` if (x, y, z) is longer than 1, or the
    /// part's link turns too far.
    pub(crate) fn keeps_above(&self, part: Part<'_>, ([x, y, z, d], frame): ([i64; 4], usize), least: i64) -> Option<bool> {
        (dot([x, y, z], [x, y, z]) <= 1 << 100).then_some(())?;
        let normal = [x, y, z].map(|x| x << (FRACTION - 50));
        let ([seen_from, link], way) = ([frame, part.link].map(|k| &self.placed[k]), Way::new(self, frame, part.link)?);
        let ((middle, radius), centre) = (part.node.ball, self.links.all[part.link].centre);
        // Corners and centre are off by less than 2 each.
        let reach = length(sub(middle, centre)) + i128::from(radius) + 4;
        let least = i128::from(least + d) + way.bend(reach, 0) / 2 + 1 + 8 * self.links.loss(reach);
        let least = least * i128::from(ONE) - dot(normal, sub(link.place, seen_from.place));
        let (change, tilt) = (dot(normal, way.change), cross(normal, way.turn));
        // If nothing is known to move, both ends ask for the same: what may move yet is in what is lost.
        let ends: &[i64] = if (way.turn, way.change) == (ZERO, ZERO) { &[0] } else { &[-1, 1] };
        Some(ends.iter().all(|&end| {
            let direction = turned_back(link.rotation, add(normal, tilt.map(|x| end * x)));
            part.is_above(direction, least - i128::from(end) * change + dot(direction, centre))
        }))
    }

    /// Returns whether a part stays farther than a margin from a ball around another one, as it is seen from the link of the part.
    pub(crate) fn keeps_beyond_ball(&self, part: Part<'_>, around: Part<'_>, margin: i64) -> Option<bool> {
        let [(link, centre), (carrier, pivot)] = [part.link, around.link].map(|k| (&self.placed[k], self.links.all[k].centre));
        let ((middle, radius), way) = (around.node.ball, Way::new(self, part.link, around.link)?);
        let arm = turned(carrier.rotation, sub(middle, pivot));
        let reach = length(arm);
        let loss = self.links.loss(reach);
        let travel = length(add(way.change, cross(way.turn, arm))) + way.bend(reach + loss, 0) / 2 + 1;
        let point = add(centre, turned_back(link.rotation, add(sub(carrier.place, link.place), arm)));
        let limit = i128::from(radius + margin) + travel + 8 * loss;
        Some(limit < 1 << 60 && part.is_beyond(point, limit as i64))
    }
}
