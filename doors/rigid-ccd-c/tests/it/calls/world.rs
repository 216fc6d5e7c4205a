//! The live handles, and the files that calls read.

use crate::support::Random;
use rigid_ccd_c::*;
use std::collections::HashMap;
use std::ffi::CString;
use std::path::Path;

/// The largest number of handles of a kind.
const POOL_SIZE: usize = 12;

/// All live handles.
pub(super) struct World<'f> {
    bodies: Vec<*mut RccdBody>,
    trajectories: Vec<*mut RccdTrajectory>,
    stops: Vec<*mut RccdStop>,
    solvers: Vec<*mut RccdSolver>,
    cells: Vec<*mut RccdCell>,
    cell_solvers: Vec<*mut RccdCellSolver>,
    curves: Vec<*mut RccdJointCurve>,
    /// The settings of each solver, by its address.
    pub(super) settings: HashMap<usize, RccdSettings>,
    /// The number of independent joints of each cell and each cell solver, by address.
    pub(super) joint_counts: HashMap<usize, usize>,
    pub(super) lent: Vec<LentText>,
    pub(super) files: &'f Files,
}

/// A text owned by a handle, and its content when it was returned.
pub(super) struct LentText {
    pub(super) owner: usize,
    pub(super) lent: RccdText,
    pub(super) content: Vec<u8>,
}

/// A kind of handle.
pub(super) trait Pooled: Sized {
    const FREE: unsafe extern "C" fn(*mut Self);

    fn pool<'w>(world: &'w mut World<'_>) -> &'w mut Vec<*mut Self>;
}

/// Returns the number of independent joints of a cell; `None` for null.
pub(super) fn joint_count(cell: *const RccdCell) -> Option<usize> {
    let mut count = 0;
    // SAFETY: null or a handle.
    let status = unsafe { rccd_cell_joint_count(cell, &mut count) };
    (status == RccdStatus::Ok).then_some(count)
}

macro_rules! pooled {
    ($($handle:ty, $pool:ident, $free:ident;)*) => {$(
        impl Pooled for $handle {
            const FREE: unsafe extern "C" fn(*mut Self) = $free;

            fn pool<'w>(world: &'w mut World<'_>) -> &'w mut Vec<*mut Self> {
                &mut world.$pool
            }
        }
    )*

    impl Drop for World<'_> {
        fn drop(&mut self) {
            $(self.free_all::<$handle>();)*
        }
    }};
}

// Bodies are first, because cells and solvers share them.
pooled! {
    RccdBody, bodies, rccd_body_free;
    RccdTrajectory, trajectories, rccd_trajectory_free;
    RccdStop, stops, rccd_stop_free;
    RccdSolver, solvers, rccd_solver_free;
    RccdCell, cells, rccd_cell_free;
    RccdCellSolver, cell_solvers, rccd_cell_solver_free;
    RccdJointCurve, curves, rccd_joint_curve_free;
}

impl<'f> World<'f> {
    pub(super) fn new(files: &'f Files) -> Self {
        files.remove_stored();
        World {
            bodies: Vec::new(),
            trajectories: Vec::new(),
            stops: Vec::new(),
            solvers: Vec::new(),
            cells: Vec::new(),
            cell_solvers: Vec::new(),
            curves: Vec::new(),
            settings: HashMap::new(),
            joint_counts: HashMap::new(),
            lent: Vec::new(),
            files,
        }
    }

    /// Adds a handle. Frees the oldest handle if there are many.
    pub(super) fn add<T: Pooled>(&mut self, handle: *mut T) {
        T::pool(self).push(handle);
        if T::pool(self).len() > POOL_SIZE {
            let oldest = self.take::<T>(0);
            // SAFETY: the handle is from the library, and no pool has it any more.
            unsafe { T::FREE(oldest) }
        }
    }

    /// Takes a handle from its pool, to be freed.
    pub(super) fn take<T: Pooled>(&mut self, index: usize) -> *mut T {
        let handle = T::pool(self).remove(index);
        self.settings.remove(&handle.addr());
        self.joint_counts.remove(&handle.addr());
        self.lent.retain(|text| text.owner != handle.addr());
        handle
    }

    fn free_all<T: Pooled>(&mut self) {
        while !T::pool(self).is_empty() {
            let handle = self.take::<T>(0);
            // SAFETY: as in `add`.
            unsafe { T::FREE(handle) }
        }
    }

    /// Remembers a text that a call has returned.
    pub(super) fn lend(&mut self, owner: usize, lent: RccdText) -> Result<(), String> {
        if lent.data.is_null() {
            return if lent.length == 0 {
                Ok(())
            } else {
                Err("a text is null and long".to_owned())
            };
        }
        let content = bytes(lent).to_vec();
        std::str::from_utf8(&content).map_err(|error| error.to_string())?;
        if self.lent.len() == 64 {
            self.lent.remove(0);
        }
        self.lent.push(LentText {
            owner,
            lent,
            content,
        });
        Ok(())
    }

    /// Checks that texts are unchanged until their owners are freed.
    pub(super) fn check_texts(&self) -> Result<(), String> {
        let changed = self.lent.iter().find(|own| bytes(own.lent) != own.content);
        changed.map_or(Ok(()), |own| {
            let content = String::from_utf8_lossy(&own.content);
            Err(format!(
                "the text {content:?} of a living handle has changed"
            ))
        })
    }
}

fn bytes<'a>(text: RccdText) -> &'a [u8] {
    // SAFETY: the text belongs to a handle that lives.
    unsafe { std::slice::from_raw_parts(text.data.cast(), text.length) }
}

/// The files that calls read, in a folder of their own.
pub(super) struct Files {
    folder: tempfile::TempDir,
    pub(super) right: Kinds,
    pub(super) broken: Kinds,
}

pub(super) struct Kinds {
    /// The mesh files and the prepared bodies that calls may store.
    pub(super) bodies: Vec<CString>,
    pub(super) robots: Vec<CString>,
    /// The texts of robots.
    pub(super) robot_texts: Vec<CString>,
    pub(super) srdfs: Vec<CString>,
}

impl Files {
    pub(super) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| text(&folder.path().join(name));
        let write = |(name, content): (&str, &[u8])| {
            std::fs::write(folder.path().join(name), content).unwrap();
            at(name)
        };
        let arm = crate::support_cells::ARM.as_bytes();
        let chain = chain(7);
        let right = Kinds {
            robot_texts: [crate::support_cells::ARM, POST, &chain, MJCF]
                .map(content)
                .into(),
            bodies: vec![
                write(("square.obj", SQUARE.as_bytes())),
                at("stored.ccd"),
                at("other.ccd"),
            ],
            robots: [
                ("arm.urdf", arm),
                ("post.urdf", POST.as_bytes()),
                ("chain.urdf", chain.as_bytes()),
                ("arm.xml", MJCF.as_bytes()),
            ]
            .map(write)
            .into(),
            srdfs: vec![write(("arm.srdf", SRDF.as_bytes()))],
        };
        let broken = Kinds {
            robot_texts: ["<robot name='", "no robot"].map(content).into(),
            bodies: [
                ("broken.obj", b"v 0 0\nf 1 2 9\n".as_slice()),
                ("empty.stl", b""),
                ("noise.ply", &[0xff, 0xfe, 0, 1, 2]),
            ]
            .map(write)
            .into(),
            robots: vec![write(("broken.urdf", &arm[..60])), text(folder.path())],
            srdfs: vec![write(("broken.srdf", b"<robot")), text(folder.path())],
        };
        Files {
            folder,
            right,
            broken,
        }
    }

    pub(super) fn folder(&self) -> CString {
        text(self.folder.path())
    }

    /// Removes the files that earlier calls have stored, so that a seed does not depend on them.
    fn remove_stored(&self) {
        for path in &self.right.bodies[1..] {
            let _ = std::fs::remove_file(path.to_str().unwrap());
        }
    }
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0.5\nv 1 1 1\nf 1 2 3\nf 2 3 4\n";

fn content(text: &str) -> CString {
    CString::new(text).unwrap()
}

fn text(path: &Path) -> CString {
    CString::new(path.to_str().unwrap()).unwrap()
}

/// A robot without joints.
const POST: &str = r#"<robot name="post"><link name="base"><collision><geometry><box size="0.2 0.2 2"/></geometry></collision></link></robot>"#;

const MJCF: &str = r#"<mujoco><worldbody><body name="upper" pos="0 0 0.5"><joint name="turn" type="hinge" axis="0 1 0"/>
  <geom type="box" size="0.1 0.1 0.5"/><body name="lower" pos="0 0 1"><joint name="slide" type="slide" axis="0 0 1" range="-1 1" limited="true"/>
  <geom type="sphere" size="0.2"/></body></body></worldbody></mujoco>"#;

const SRDF: &str =
    r#"<robot name="arm"><disable_collisions link1="base" link2="lower" reason="Never"/></robot>"#;

/// Returns a robot that is a chain of `count` joints.
fn chain(count: usize) -> String {
    let name = |k: usize| ["base", "upper", "lower", "l3", "l4", "l5", "l6", "l7"][k];
    let link = |k: usize| {
        format!(
            r#"<link name="{}"><collision><origin xyz="0 0 0.15"/><geometry><box size="0.05 0.05 0.2"/></geometry></collision></link>"#,
            name(k)
        )
    };
    let joint = |k: usize| {
        let (parent, child, y) = (name(k - 1), name(k), k % 2);
        format!(
            r#"<joint name="j{k}" type="revolute"><parent link="{parent}"/><child link="{child}"/><origin xyz="0 0 0.3"/><axis xyz="{} {y} 0"/><limit lower="-2" upper="2" effort="1" velocity="1"/></joint>"#,
            1 - y
        )
    };
    let links: String = (0..=count).map(link).collect();
    let joints: String = (1..=count).map(joint).collect();
    format!(r#"<robot name="chain">{links}{joints}</robot>"#)
}

/// Returns a random handle of a pool and its index, or `None` if the pool is empty.
pub(super) fn pick<T: Pooled>(
    world: &mut World<'_>,
    random: &mut Random,
) -> Option<(usize, *mut T)> {
    let count = T::pool(world).len() as u32;
    // Draws equally often whether there is a handle or not.
    let index = random.index(count.max(1));
    T::pool(world).get(index).map(|&handle| (index, handle))
}
