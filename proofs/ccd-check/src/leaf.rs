//! Checks that a leaf proves two nodes apart over an interval of time. The README has the lemmas and their proofs.

use crate::{body::Node, motion::Interval, motion::RelativeMotion, number::*};

impl Interval<'_> {
    /// Checks that a node stays farther than `gap` above a plane, over the whole interval. The side above the plane is the side to which
    /// the normal n = (x, y, z) points. The plane rotates with the link `frame`, and has the equation n · p = d for points p relative to
    /// the center of that link.
    ///
    /// Returns `None` if the normal is longer than 1, or if the node's link rotates too far relative to `frame`.
    pub(crate) fn stays_above_plane(&self, node: Node<'_>, ([x, y, z, d], frame): ([i64; 4], usize), gap: i64) -> Option<bool> {
        (dot([x, y, z], [x, y, z]) <= 1 << 100).then_some(())?;
        let normal = [x, y, z].map(|x| x << (FRACTION_BITS - 50));
        let [origin, link] = [frame, node.link].map(|k| &self.states[k]);
        let motion = RelativeMotion::new(self, frame, node.link)?;
        let ((middle, radius), center) = (node.data.ball, self.links.all[node.link].center);
        // The corners and the center each have an error of less than 2.
        let max_distance = length_bound(sub(middle, center)) + i128::from(radius) + 4;
        let error = motion.second_derivative(max_distance, 0) / 2 + 1 + 8 * self.links.error_bound(max_distance);
        let limit = (i128::from(gap + d) + error) * i128::from(ONE) - dot(normal, sub(link.position, origin.position));
        let (center_change, normal_change) = (dot(normal, motion.displacement), cross(normal, motion.rotation_vector));
        // If the computed motion is 0, both ends have the same inequality. The error bound covers a motion that is rounded to 0.
        let ends: &[i64] = if (motion.rotation_vector, motion.displacement) == (ZERO, ZERO) { &[0] } else { &[-1, 1] };
        Some(ends.iter().all(|&end| {
            let direction = rotated_back(link.rotation, add(normal, normal_change.map(|x| end * x)));
            node.projects_above(direction, limit - i128::from(end) * center_change + dot(direction, center))
        }))
    }

    /// Checks that a node stays farther than `margin` from the bounding ball of the node `around`, over the whole interval. Computes the
    /// motion of the ball relative to the link of the first node.
    ///
    /// Returns `None` if the links rotate too far relative to each other.
    pub(crate) fn stays_beyond_ball(&self, node: Node<'_>, around: Node<'_>, margin: i64) -> Option<bool> {
        let [(link, center), (other, pivot)] = [node.link, around.link].map(|k| (&self.states[k], self.links.all[k].center));
        let ((middle, radius), motion) = (around.data.ball, RelativeMotion::new(self, node.link, around.link)?);
        let from_center = rotated(other.rotation, sub(middle, pivot));
        let distance = length_bound(from_center);
        let velocity = add(motion.displacement, cross(motion.rotation_vector, from_center));
        let error = self.links.error_bound(distance);
        let travel = length_bound(velocity) + motion.second_derivative(distance + error, 0) / 2 + 1;
        let point = add(center, rotated_back(link.rotation, add(sub(other.position, link.position), from_center)));
        let limit = i128::from(radius + margin) + travel + 8 * error;
        Some(limit < 1 << 60 && node.is_beyond(point, limit as i64))
    }
}
