//! Collects remarks on the rows of a table from any number of threads.

use ccd_core::Motion;
use rigid_ccd::Remark;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// The remarks on the rows read so far, one of each kind.
#[derive(Debug, Default)]
pub(crate) struct RemarkCollector {
    quaternion: OnceLock<Remark>,
    spin: OnceLock<Remark>,
    /// Whether some fast rotation is not a round number of degrees: a sign that the table's angles are in radians.
    has_radians: AtomicBool,
}

impl RemarkCollector {
    /// Adds a remark if a quaternion x, y, z, w is far from unit length.
    pub(crate) fn note_quaternion(&self, parts: [f64; 4]) {
        if let Some(remark) = Remark::remark_on_quaternion(parts) {
            self.quaternion.get_or_init(|| remark);
        }
    }

    /// Adds a remark if a motion's angular velocity seems to be in degrees, or notes that it must be in radians.
    pub(crate) fn note_motion(&self, motion: &Motion, duration: f64) {
        if !Remark::is_fast_rotation(motion.angular_velocity(), duration) {
            return;
        }
        match Remark::remark_on_spin(motion.angular_velocity(), duration) {
            Some(remark) => {
                self.spin.get_or_init(|| remark);
            }
            None => self.has_radians.store(true, Ordering::Relaxed),
        }
    }

    /// Returns the remarks collected so far, one of each kind.
    pub(crate) fn remarks(&self) -> Vec<Remark> {
        let has_radians = self.has_radians.load(Ordering::Relaxed);
        let spin = self.spin.get().filter(|_| !has_radians);
        let remarks = [self.quaternion.get(), spin].into_iter().flatten();
        remarks.copied().collect()
    }
}
