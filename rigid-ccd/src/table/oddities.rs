//! What is odd about the rows of a table, read by any number of threads.

use crate::Remark;
use ccd_core::Motion;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// What is odd about the rows read so far.
#[derive(Debug, Default)]
pub(in crate::table) struct Oddities {
    quaternion: OnceLock<Remark>,
    spin: OnceLock<Remark>,
    /// Whether a body turns many times, and by no round number of degrees: then radians are meant.
    has_radians: AtomicBool,
}

impl Oddities {
    /// Looks at a quaternion w, x, y, z as it is given.
    pub(in crate::table) fn note_quaternion(&self, parts: [f64; 4]) {
        if let Some(remark) = Remark::of_quaternion(parts) {
            self.quaternion.get_or_init(|| remark);
        }
    }

    /// Looks at a motion.
    pub(in crate::table) fn note_motion(&self, motion: &Motion, duration: f64) {
        if !Remark::is_fast(motion.spin(), duration) {
            return;
        }
        match Remark::of_spin(motion.spin(), duration) {
            Some(remark) => {
                self.spin.get_or_init(|| remark);
            }
            None => self.has_radians.store(true, Ordering::Relaxed),
        }
    }

    /// Returns what was found, each kind once.
    pub(in crate::table) fn remarks(&self) -> Vec<Remark> {
        let spin = self
            .spin
            .get()
            .filter(|_| !self.has_radians.load(Ordering::Relaxed));
        self.quaternion
            .get()
            .into_iter()
            .chain(spin)
            .copied()
            .collect()
    }
}
