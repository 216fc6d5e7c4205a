//! Draws structs: poses, motions, settings, moving bodies.

use super::call::Call;
use crate::support::default_settings;
use rigid_ccd_c::*;
use std::ffi::{CString, c_char};
use std::mem::MaybeUninit;
use std::ptr::null;

impl Call<'_, '_> {
    fn three(&mut self, name: &str, size: f64) -> [f64; 3] {
        // Rarely far away, or tiny.
        let size = if self.once_in(50) {
            size * 10.0_f64.powf(15.0 * self.random.number())
        } else {
            size
        };
        let usual = self.random.vector(size);
        let values = if self.is_odd() {
            usual.map(|own| self.number(name, own))
        } else {
            usual
        };
        self.note(name, values);
        values
    }

    fn rotation(&mut self) -> [f64; 4] {
        let scale = if self.once_in(50) { 1e-200 } else { 1.0 };
        let usual = [(); 4].map(|()| scale * self.random.number());
        let values = match self.random.index(3) {
            0 => [0.0, 0.0, 0.0, 1.0],
            _ if self.is_odd() => {
                [[0.0; 4], usual.map(|own| own * 1e-320), [f64::MAX; 4]][self.random.index(3)]
            }
            _ => usual,
        };
        self.note("rotation", values);
        values
    }

    fn pose_value(&mut self) -> RccdPose {
        RccdPose {
            position: self.three("position", 1.5),
            rotation: self.rotation(),
        }
    }

    fn motion_value(&mut self) -> RccdMotion {
        RccdMotion {
            start: self.pose_value(),
            velocity: self.three("velocity", 2.0),
            angular_velocity: self.three("angular_velocity", 3.0),
            center: self.three("center", 0.3),
        }
    }

    pub(super) fn pose(&mut self) -> *const RccdPose {
        let pose = self.pose_value();
        self.lend(pose)
    }

    pub(super) fn motion(&mut self) -> *const RccdMotion {
        let motion = self.motion_value();
        self.lend(motion)
    }

    /// Draws three numbers.
    pub(super) fn vector(&mut self) -> *const f64 {
        let vector = self.three("vector", 5.0);
        self.lend(vector).cast()
    }

    pub(super) fn points(&mut self) -> *const f64 {
        let count = match self.random.index(100) {
            // The time of a visit of a curve grows with the square of its degree.
            0 => 30,
            k if k < 10 => k % 4,
            k => 4 + k % 4,
        };
        let points: Vec<_> = (0..count).flat_map(|_| self.three("point", 1.5)).collect();
        self.array("points", points, 3)
    }

    pub(super) fn turns(&mut self) -> *const RccdRotations {
        if self.once_in(2) {
            return null();
        }
        let count = if self.once_in(10) {
            0
        } else {
            1 + self.random.index(3)
        };
        let times = self.times(count);
        let rotations = (0..count).flat_map(|_| self.rotation()).collect();
        let (arrays, [count]) = self.arrays(vec![times, rotations], [count]);
        self.lend(RccdRotations {
            times: arrays[0],
            rotations: arrays[1],
            count,
        })
    }

    pub(super) fn pose_numbers(&mut self) -> [f64; 7] {
        let RccdPose {
            position: [x, y, z],
            rotation: [i, j, k, w],
        } = self.pose_value();
        [x, y, z, i, j, k, w]
    }

    /// Draws a body with a motion, with a trajectory, or with neither. Sometimes draws both, which is wrong.
    pub(super) fn moving(&mut self) -> *const RccdMovingBody {
        let mut moving = RccdMovingBody {
            body: self.handle(),
            motion: null(),
            trajectory: null(),
        };
        match self.random.index(8) {
            0 => {}
            1 | 2 => moving.trajectory = self.handle(),
            3 if self.is_odd() => {
                moving.motion = self.motion();
                moving.trajectory = self.handle();
            }
            _ => moving.motion = self.motion(),
        }
        self.lend(moving)
    }

    pub(super) fn settings(&mut self) -> *const RccdSettings {
        let settings = self.settings_value();
        // Rarely, because the default budget lasts for seconds.
        if self.once_in(1000) {
            self.settings = Some(default_settings());
            self.note("settings", ());
            return null();
        }
        self.note("settings", settings);
        self.settings = Some(settings);
        let pointer = self.keep(vec![settings]);
        if self.is_odd() {
            self.note("misaligned", ());
            return pointer.wrapping_byte_add(1);
        }
        pointer
    }

    fn settings_value(&mut self) -> RccdSettings {
        let fine = -3.0 - 3.0 * self.random.number();
        let mut settings = RccdSettings {
            tolerance: self.number("tolerance", 10.0_f64.powf(fine)),
            ..default_settings()
        };
        if self.once_in(3) {
            settings.margin = self.distance();
        }
        settings.budget = match self.random.index(6) {
            0 => self.random.index(300) as u64,
            1 => 20_000,
            _ => 2_000,
        };
        if self.once_in(6) {
            let usual = [0.0, 1e-9, 1e-6, 1e-4, 1e19][self.random.index(5)];
            settings.deadline = self.number("deadline", usual);
        }
        if self.once_in(30) {
            (settings.budget, settings.deadline) = (u64::MAX, 1e-3);
        }
        // Questions about the closest approach in a cell refuse `Leave`.
        settings.start_policy = u32::from(self.once_in(4));
        settings.contact_normals = self.random.index(2) as u32;
        if self.is_odd() {
            settings.start_policy = self.random.bits();
        }
        if self.is_odd() {
            settings.contact_normals = self.random.bits();
        }
        if self.is_odd() {
            let sizes = [0, 8, settings.size + 8, usize::MAX];
            settings.size = sizes[self.random.index(4)];
        }
        if self.once_in(4) {
            settings.stop = self.handle();
        }
        settings
    }

    /// Draws an answer about a path, with changes that a caller may have made.
    pub(super) fn given_answer(&mut self) -> *const RccdPathAnswer {
        let mut answer = MaybeUninit::<RccdPathAnswer>::zeroed();
        let outcome = [1, 1, 2, 0, 0, 6, 77][self.random.index(7)];
        let (segment, fraction) = (self.random.index(3), self.number("fraction", 0.5));
        let sizes = [0, 8, size_of::<RccdPathAnswer>() - 1, usize::MAX];
        let size = if self.is_odd() {
            sizes[self.random.index(4)]
        } else {
            size_of::<RccdPathAnswer>()
        };
        self.note("answer", (outcome, segment, fraction, size));
        let place = answer.as_mut_ptr();
        // SAFETY: the fields are in the place; an outcome need not be one of the enum, and is written as a number.
        unsafe {
            (&raw mut (*place).size).write(size);
            (&raw mut (*place).outcome).cast::<i32>().write(outcome);
            (&raw mut (*place).segment).write(segment);
            (&raw mut (*place).fraction).write(fraction);
        }
        self.lend(answer).cast()
    }

    pub(super) fn record_file(&mut self) -> *const c_char {
        let folder = self.world.files.folder().into_string().unwrap();
        let file = CString::new(folder + "/record.json").unwrap();
        self.text_of("file", &[file])
    }
}
