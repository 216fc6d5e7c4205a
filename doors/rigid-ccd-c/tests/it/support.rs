//! Shared helpers of the tests: handles that free themselves, and random scenes.

use rigid_ccd::mesh::{PieceChoice, TriangleMesh, body_from_mesh};
use rigid_ccd::{Body, Motion, Pose};
use rigid_ccd_c::*;
use std::ffi::CStr;
use std::ptr::{null, null_mut};

/// A handle, freed at the end of its scope.
pub(crate) struct Handle<T> {
    pointer: *mut T,
    free: unsafe extern "C" fn(*mut T),
}

impl<T> Handle<T> {
    pub(crate) fn pointer(&self) -> *mut T {
        self.pointer
    }

    pub(crate) fn new(
        free: unsafe extern "C" fn(*mut T),
        make: impl FnOnce(*mut *mut T) -> RccdStatus,
    ) -> Self {
        let mut pointer = null_mut();
        ok(make(&mut pointer));
        Handle { pointer, free }
    }
}

impl<T> Drop for Handle<T> {
    fn drop(&mut self) {
        // SAFETY: the handle is from the library, and is freed once.
        unsafe { (self.free)(self.pointer) }
    }
}

/// Returns the message of the last failure.
pub(crate) fn last_error() -> String {
    // SAFETY: the text ends with a zero, and is copied before another call.
    let text = unsafe { CStr::from_ptr(rccd_last_error()) };
    text.to_str().unwrap().to_owned()
}

#[track_caller]
pub(crate) fn ok(status: RccdStatus) {
    assert_eq!(status, RccdStatus::Ok, "{}", last_error());
}

pub(crate) fn solver(settings: Option<&RccdSettings>) -> Handle<RccdSolver> {
    let settings = settings.map_or(null(), std::ptr::from_ref);
    // SAFETY: null, or a reference.
    Handle::new(rccd_solver_free, |out| unsafe {
        rccd_solver_new(settings, out)
    })
}

pub(crate) fn sphere(radius: f64) -> Handle<RccdBody> {
    // SAFETY: the place is a local variable.
    Handle::new(rccd_body_free, |out| unsafe {
        rccd_body_sphere(radius, out)
    })
}

pub(crate) fn cylinder(radius: f64, half_height: f64) -> Handle<RccdBody> {
    // SAFETY: the place is a local variable.
    Handle::new(rccd_body_free, |out| unsafe {
        rccd_body_cylinder(radius, half_height, out)
    })
}

pub(crate) fn thrown(motion: &RccdMotion, acceleration: [f64; 3]) -> Handle<RccdTrajectory> {
    // SAFETY: the arguments are references.
    Handle::new(rccd_trajectory_free, |out| unsafe {
        rccd_trajectory_ballistic(motion, acceleration.as_ptr(), out)
    })
}

pub(crate) fn pose_path(times: &[f64], poses: &[RccdPose]) -> Handle<RccdTrajectory> {
    assert_eq!(times.len(), poses.len());
    // SAFETY: both arrays have that length.
    Handle::new(rccd_trajectory_free, |out| unsafe {
        rccd_trajectory_pose_path(times.as_ptr(), poses.as_ptr(), times.len(), out)
    })
}

pub(crate) fn moving(body: &Handle<RccdBody>, motion: &RccdMotion) -> RccdMovingBody {
    RccdMovingBody {
        body: body.pointer(),
        motion,
        trajectory: null(),
    }
}

pub(crate) fn to_rust(motion: &RccdMotion) -> Motion {
    let pose = Pose::new(motion.start.position, motion.start.rotation).unwrap();
    Motion::about(
        pose,
        motion.velocity,
        motion.angular_velocity,
        motion.center,
    )
    .unwrap()
}

/// Returns the default settings.
pub(crate) fn default_settings() -> RccdSettings {
    // SAFETY: zero is a value of each field.
    let mut settings: RccdSettings = unsafe { std::mem::zeroed() };
    settings.size = size_of::<RccdSettings>();
    // SAFETY: a local variable whose size is set.
    ok(unsafe { rccd_settings_default(&mut settings) });
    settings
}

/// Returns an empty answer as C makes it: all zero except for its size.
pub(crate) fn empty_answer() -> RccdAnswer {
    let feature = RccdFeature {
        kind: RccdFeatureKind::None,
        first: 0,
        second: 0,
    };
    RccdAnswer {
        size: size_of::<RccdAnswer>(),
        outcome: RccdOutcome::Free,
        limit: RccdLimit::None,
        time: 0.0,
        last_time: 0.0,
        safe_until: 0.0,
        lower: 0.0,
        upper: 0.0,
        normal: [0.0; 3],
        witness_a: [0.0; 3],
        witness_b: [0.0; 3],
        feature_a: feature,
        feature_b: feature,
        tolerance: 0.0,
        work: 0,
    }
}

/// Draws a mesh of triangles near the origin. Returns it as a body of the interface and as a body of Rust.
pub(crate) fn random_mesh(random: &mut Random, count: usize) -> (Handle<RccdBody>, Body) {
    let mut vertices = Vec::new();
    for _ in 0..count {
        let middle = random.vector(0.5);
        for _ in 0..3 {
            let way = random.vector(0.2);
            vertices.push([0, 1, 2].map(|k| middle[k] + way[k]));
        }
    }
    let triangles: Vec<[u32; 3]> = (0..count as u32)
        .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
        .collect();
    // SAFETY: the counts are those of the arrays.
    let handle = Handle::new(rccd_body_free, |out| unsafe {
        rccd_body_from_triangles(
            vertices.as_ptr().cast(),
            vertices.len(),
            triangles.as_ptr().cast(),
            triangles.len(),
            RccdPieces::Triangles as u32,
            out,
        )
    });
    let mesh = TriangleMesh::new(vertices, &triangles).unwrap();
    (
        handle,
        body_from_mesh(&mesh, PieceChoice::Triangles).unwrap().body,
    )
}

/// A linear congruential generator, which is good enough for the tests.
#[derive(Clone)]
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Random(seed)
    }

    pub(crate) fn bits(&mut self) -> u32 {
        self.0 = (self.0)
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 32) as u32
    }

    /// Draws a number from −1 to 1.
    pub(crate) fn number(&mut self) -> f64 {
        f64::from(self.bits()) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    pub(crate) fn vector(&mut self, size: f64) -> [f64; 3] {
        [(); 3].map(|()| size * self.number())
    }

    pub(crate) fn index(&mut self, count: u32) -> usize {
        (self.bits() % count) as usize
    }

    pub(crate) fn motion(&mut self) -> RccdMotion {
        RccdMotion {
            start: RccdPose {
                position: self.vector(1.5),
                rotation: [(); 4].map(|()| self.number()),
            },
            velocity: self.vector(2.0),
            angular_velocity: self.vector(3.0),
            center: self.vector(0.3),
        }
    }
}
