//! A robot, the cells around it, and configurations, from a folder; through the interface and in Rust.

use anyhow::{Context, Result, ensure};
use ccd_tables::motions::{MotionTable, Motions};
use rigid_ccd::{Body, Motion, Pose, Settings, load};
use rigid_ccd_c::*;
use rigid_ccd_robot::{Cell, RobotFile};
use std::ffi::{CStr, CString};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::ptr::null_mut;

/// A handle that is freed at the end of its scope.
pub(crate) struct Handle<T>(pub(crate) *mut T, unsafe extern "C" fn(*mut T));

impl<T> Handle<T> {
    pub(crate) fn new(
        free: unsafe extern "C" fn(*mut T),
        make: impl FnOnce(*mut *mut T) -> RccdStatus,
    ) -> Result<Self> {
        let mut handle = null_mut();
        check(make(&mut handle))?;
        Ok(Handle(handle, free))
    }
}

impl<T> Drop for Handle<T> {
    fn drop(&mut self) {
        // SAFETY: it is of the library, and freed once.
        unsafe { (self.1)(self.0) }
    }
}

/// Returns the message of a call that has failed.
pub(crate) fn check(status: RccdStatus) -> Result<()> {
    // SAFETY: the text ends with a zero, and is copied before another call.
    let message = || unsafe { CStr::from_ptr(rccd_last_error()) }.to_string_lossy();
    ensure!(status == RccdStatus::Ok, "{}", message());
    Ok(())
}

pub(crate) fn text(path: &Path) -> Result<CString> {
    Ok(CString::new(path.to_str().context("a path in UTF-8")?)?)
}

/// Returns the file of a folder with an extension.
fn file_with(folder: &Path, extension: &str) -> Result<PathBuf> {
    let mut paths = fs::read_dir(folder)?.filter_map(|entry| Some(entry.ok()?.path()));
    let found = paths.find(|path| path.extension().is_some_and(|other| other == extension));
    found.with_context(|| format!("{} has no .{extension}", folder.display()))
}

/// Loads a cell, such as A, through the interface and in Rust.
pub(crate) fn cells(folder: &Path, meshes: &Path, name: &str) -> Result<(Handle<RccdCell>, Cell)> {
    let (urdf, srdf) = (file_with(folder, "urdf")?, file_with(folder, "srdf")?);
    let file = RobotFile::from_path(&urdf);
    let robot = file.read()?;
    let pairs = file.link_pairs(&robot, Some(&srdf))?;
    let mut rust = Cell::new(robot, pairs);
    let (urdf, srdf) = (text(&urdf)?, text(&srdf)?);
    // SAFETY: both texts end with a zero.
    let cell = Handle::new(rccd_cell_free, |out| unsafe {
        rccd_cell_load(urdf.as_ptr(), srdf.as_ptr(), std::ptr::null(), out)
    })?;
    let lines = fs::read_to_string(folder.join(format!("{name}.txt")))?;
    for (number, line) in lines.lines().enumerate() {
        add_obstacle(&cell, &mut rust, meshes, (number, line)).with_context(|| line.to_owned())?;
    }
    Ok((cell, rust))
}

fn add_obstacle(
    cell: &Handle<RccdCell>,
    rust: &mut Cell,
    meshes: &Path,
    (number, line): (usize, &str),
) -> Result<()> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let numbers: Vec<f64> = words.iter().filter_map(|word| word.parse().ok()).collect();
    let [.., x, y, z, qw, qx, qy, qz] = numbers[..] else {
        anyhow::bail!("a pose is seven numbers");
    };
    let file = meshes.join(format!("{}.obj", words.get(1).context("a name of a mesh")?));
    let file_text = text(&file)?;
    let body = Handle::new(rccd_body_free, |out| match (words[0], &numbers[..]) {
        // SAFETY: `out` is a place, and the text ends with a zero.
        ("box", [hx, hy, hz, ..]) => unsafe { rccd_body_box(*hx, *hy, *hz, out) },
        // SAFETY: as above.
        ("sphere", [radius, ..]) => unsafe { rccd_body_sphere(*radius, out) },
        // SAFETY: as above.
        ("capsule", [radius, half, ..]) => unsafe { rccd_body_capsule(*radius, *half, out) },
        // SAFETY: as above.
        _ => unsafe { rccd_body_load(file_text.as_ptr(), out) },
    })?;
    let in_rust = match (words[0], &numbers[..]) {
        ("box", [hx, hy, hz, ..]) => Body::cuboid([*hx, *hy, *hz])?,
        ("sphere", [radius, ..]) => Body::sphere(*radius)?,
        ("capsule", [radius, half, ..]) => Body::capsule(*radius, *half)?,
        _ => load(&file)?,
    };
    let pose = RccdPose {
        position: [x, y, z],
        rotation: [qx, qy, qz, qw],
    };
    let name = format!("{}{number}", words[0]);
    rust.add_obstacle(&name, in_rust, Pose::new(pose.position, pose.rotation)?)?;
    let name = CString::new(name)?;
    // SAFETY: the pointers are to values that live here.
    check(unsafe { rccd_cell_add_obstacle(cell.0, name.as_ptr(), body.0, &pose) })
}

/// Returns a solver of a cell.
pub(crate) fn cell_solver(
    cell: &Handle<RccdCell>,
    settings: &RccdSettings,
) -> Result<Handle<RccdCellSolver>> {
    // SAFETY: the handle and the settings live here.
    Handle::new(rccd_cell_solver_free, |out| unsafe {
        rccd_cell_solver_new(cell.0, settings, out)
    })
}

/// Reads numbers of a file of float64.
pub(crate) fn read_numbers(path: &Path) -> Result<Vec<f64>> {
    let bytes = fs::read(path).with_context(|| path.display().to_string())?;
    let numbers = bytes.chunks_exact(8);
    Ok(numbers
        .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap_or_default()))
        .collect())
}

/// Returns the default settings.
pub(crate) fn default_settings() -> RccdSettings {
    // SAFETY: zero is a value of each field.
    let mut settings: RccdSettings = unsafe { std::mem::zeroed() };
    settings.size = size_of::<RccdSettings>();
    // SAFETY: a local variable whose size is set: this cannot fail.
    unsafe { rccd_settings_default(&mut settings) };
    settings
}

/// Returns an answer with its size set.
pub(crate) fn empty_path_answer() -> RccdPathAnswer {
    // SAFETY: zero is a value of each field: numbers, null, and enums that have it.
    let zero: RccdPathAnswer = unsafe { std::mem::zeroed() };
    RccdPathAnswer {
        size: size_of::<RccdPathAnswer>(),
        ..zero
    }
}

/// Returns the settings of Rust that `rccd_settings_default` stands for.
pub(crate) fn rust_settings(tolerance: f64) -> Settings {
    Settings {
        tolerance,
        ..Settings::DEFAULT
    }
}

/// The pairs of a folder of scenes: body A, body B, motions.
pub(crate) const SCENES: [(&str, &str, &str); 7] = [
    ("knot2880", "knot2880", "knots"),
    ("knot11520", "knot11520", "knots"),
    ("knot34560", "knot34560", "knots"),
    ("ring", "ring", "rings"),
    ("bunny70k", "bunny70k", "bunnies"),
    ("bunny26k", "bunny26k", "bunnies"),
    ("santa", "board", "santa"),
];

/// A pair of a folder of scenes, through the interface and in Rust, with the rows of its motions.
type Scene = ([Handle<RccdBody>; 2], [Body; 2], Vec<Motions>);

/// Loads a pair of a folder of scenes.
pub(crate) fn scene(folder: &Path, bodies: [&str; 2], motions: &str) -> Result<Scene> {
    let rows = MotionTable::read(File::open(folder.join(format!("{motions}.csv")))?)?.rows;
    let files = bodies.map(|name| folder.join(format!("{name}.obj")));
    let rust = [load(&files[0])?, load(&files[1])?];
    let load = |path: &Path| {
        let path = text(path)?;
        // SAFETY: the path ends with a zero.
        Handle::new(rccd_body_free, |out| unsafe {
            rccd_body_load(path.as_ptr(), out)
        })
    };
    let rows = rows.into_iter().map(|(_, row)| row).collect();
    Ok(([load(&files[0])?, load(&files[1])?], rust, rows))
}

/// Returns a motion as the interface takes it.
pub(crate) fn numbers_of(motion: &Motion) -> RccdMotion {
    RccdMotion {
        start: RccdPose {
            position: motion.start().translation().to_array(),
            rotation: motion.start().rotation().to_array(),
        },
        velocity: motion.velocity().to_array(),
        angular_velocity: motion.angular_velocity().to_array(),
        center: motion.center().to_array(),
    }
}

/// Makes a motion of Rust from the numbers of one of the interface.
pub(crate) fn motion_of(numbers: &RccdMotion) -> Result<Motion> {
    let start = Pose::new(numbers.start.position, numbers.start.rotation)?;
    Ok(Motion::about(
        start,
        numbers.velocity,
        numbers.angular_velocity,
        numbers.center,
    )?)
}
