//! Cells: a robot among obstacles, from URDF or MJCF files.

use crate::arguments::{
    array, check_output, exclusive, free, give, reference, store, text, text_or_none,
};
use crate::body::RccdBody;
use crate::motion::RccdPose;
use crate::status::{Failure, RccdStatus, status_of};
use rigid_ccd::Pose;
use rigid_ccd_robot::{Cell, Item, RobotError, RobotFile};
use std::ffi::c_char;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// A cell (planning scene): a robot among obstacles that are static in the frame of its base. The names of obstacles,
/// attached bodies and links are all different. Changing the cell invalidates its solvers: their questions fail from then
/// on. Making a new solver takes about 30 µs.
pub struct RccdCell {
    pub(crate) cell: Arc<Cell>,
    /// The number of changes of the cell so far. Solvers share the counter, and so detect changes.
    pub(crate) changes: Arc<AtomicU64>,
    /// The names of joints for callers. The names inside `cell` do not live long enough, because a change replaces `cell`,
    /// and the old cell is freed with its last solver.
    joint_names: Vec<String>,
    /// The summary that the last call of `rccd_cell_check_summary` returned.
    check_summary: String,
}

/// A text in UTF-8 without a terminating zero. It is owned by a cell or a solver.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct RccdText {
    /// The first byte; null if there is no text.
    pub data: *const c_char,
    /// The number of bytes.
    pub length: usize,
}

impl RccdText {
    pub(crate) const NONE: RccdText = RccdText {
        data: std::ptr::null(),
        length: 0,
    };
}

impl RccdText {
    /// Copies a text that this library has returned.
    ///
    /// # Safety
    /// The owner of the text has not been freed.
    pub(crate) unsafe fn to_owned(self) -> Result<String, Failure> {
        // SAFETY: the contract of this function.
        let bytes = unsafe { array("a name", self.data.cast::<u8>(), self.length) }?;
        Ok(String::from_utf8_lossy(bytes).into_owned())
    }
}

impl From<&str> for RccdText {
    fn from(text: &str) -> Self {
        RccdText {
            data: text.as_ptr().cast(),
            length: text.len(),
        }
    }
}

/// Loads the robot of a URDF or MJCF file, with its meshes, as a cell without obstacles. All pairs of links are checked
/// except neighbours, links that never move relative to each other, and pairs that the SRDF file disables. `srdf` may be
/// null. `package_folder` is the folder searched first for `package://` names; it may be null. Meshes are exact.
/// MuJoCo uses their convex hulls instead, so it finds contacts in concavities that are free here.
///
/// # Safety
/// Each text is null or ends with a zero; `out` is null or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_load(
    robot: *const c_char,
    srdf: *const c_char,
    package_folder: *const c_char,
    out: *mut *mut RccdCell,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let robot = RobotFile::from_path(unsafe { text("robot", robot) }?);
        // SAFETY: the contract of this function.
        unsafe { give_cell(robot, srdf, package_folder, out) }
    })
}

/// Makes a cell from the text of a URDF or MJCF, such as ROS's parameter `robot_description`. Relative paths of meshes
/// are resolved in `folder`, or in the working directory if it is null. The other arguments are as for `rccd_cell_load`.
///
/// # Safety
/// Each text is null or ends with a zero; `out` is null or points to memory for a handle.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_from_text(
    robot: *const c_char,
    folder: *const c_char,
    srdf: *const c_char,
    package_folder: *const c_char,
    out: *mut *mut RccdCell,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (robot, folder) = unsafe { (text("robot", robot)?, text_or_none("folder", folder)?) };
        let path = Path::new(folder.unwrap_or_default()).join("robot");
        // SAFETY: the contract of this function.
        unsafe { give_cell(RobotFile::from_text(robot, path), srdf, package_folder, out) }
    })
}

/// Frees a cell. Its solvers stay usable. Does nothing for null.
///
/// # Safety
/// The handle is null, or comes from this library, is not in use, and has not been freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_free(cell: *mut RccdCell) {
    // SAFETY: the contract of this function.
    unsafe { free(cell) }
}

/// Stores the number of independent joints. A configuration has one position for each of them.
///
/// # Safety
/// `cell` is null or a handle; `out` is null or points to memory for a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_joint_count(
    cell: *const RccdCell,
    out: *mut usize,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let cell = unsafe { reference("cell", cell) }?;
        // SAFETY: the contract of this function.
        unsafe { store("out", out, joint_count(&cell.cell)) }
    })
}

/// Stores the name and the limits of an independent joint. `number` is its index in configurations. Limits are infinite for
/// joints without limits. The name is valid until the cell is freed.
///
/// # Safety
/// `cell` is null or a handle; `name`, `lower` and `upper` are null or point to memory for their values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_joint(
    cell: *const RccdCell,
    number: usize,
    name: *mut RccdText,
    lower: *mut f64,
    upper: *mut f64,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let RccdCell {
            cell, joint_names, ..
        } = unsafe { reference("cell", cell) }?;
        let joint = joint_names.iter().zip(cell.robot().limits()).nth(number);
        let Some((joint_name, [least, greatest])) = joint else {
            return Err(Failure::argument(format!(
                "there is no independent joint {number}"
            )));
        };
        check_output("name", name)?;
        check_output("lower", lower)?;
        check_output("upper", upper)?;
        // SAFETY: the contract of this function.
        unsafe {
            store("name", name, joint_name.as_str().into())?;
            store("lower", lower, least)?;
            store("upper", upper, greatest)
        }
    })
}

/// Adds an obstacle at a pose in the frame of the robot's base. The cell shares ownership of the body: the caller may
/// free it.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero; `body` is null or a
/// handle; `pose` is null or points to a pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_add_obstacle(
    cell: *mut RccdCell,
    name: *const c_char,
    body: *const RccdBody,
    pose: *const RccdPose,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (name, body, pose) = unsafe {
            (
                text("name", name)?,
                reference("body", body)?,
                read_pose(pose)?,
            )
        };
        // SAFETY: the contract of this function.
        unsafe {
            change(cell, |cell| {
                cell.add_obstacle(name, Arc::clone(&body.0), pose)
            })
        }
    })
}

/// Moves an obstacle to a pose in the frame of the robot's base.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero; `pose` is null or points
/// to a pose.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_move_obstacle(
    cell: *mut RccdCell,
    name: *const c_char,
    pose: *const RccdPose,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (name, pose) = unsafe { (text("name", name)?, read_pose(pose)?) };
        // SAFETY: the contract of this function.
        unsafe { change(cell, |cell| cell.move_obstacle(name, pose)) }
    })
}

/// Removes an obstacle.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_remove_obstacle(
    cell: *mut RccdCell,
    name: *const c_char,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let name = unsafe { text("name", name) }?;
        // SAFETY: the contract of this function.
        unsafe { change(cell, |cell| cell.remove_obstacle(name)) }
    })
}

/// Attaches a body to a link, such as an object that a gripper holds, at a pose in the link's frame. The body may touch
/// that link, links that are rigidly attached to it, and the items named in `may_touch`: links, attached bodies and
/// obstacles.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `name` and `link` are null or texts that end with a zero; `body` is null
/// or a handle; `pose` is null or points to a pose; `may_touch` is null or points to `may_touch_count` such texts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_attach(
    cell: *mut RccdCell,
    name: *const c_char,
    body: *const RccdBody,
    link: *const c_char,
    pose: *const RccdPose,
    may_touch: *const *const c_char,
    may_touch_count: usize,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (name, link, body, pose) = unsafe {
            (
                text("name", name)?,
                text("link", link)?,
                reference("body", body)?,
                read_pose(pose)?,
            )
        };
        // SAFETY: the contract of this function.
        let names = unsafe { array("may_touch", may_touch, may_touch_count) }?.iter();
        // SAFETY: the contract of this function.
        let names = names.map(|&name| unsafe { text("a name of may_touch", name) });
        let may_touch = names.collect::<Result<Vec<_>, _>>()?;
        let attach =
            |cell: &mut Cell| cell.attach(name, Arc::clone(&body.0), (link, pose), &may_touch);
        // SAFETY: the contract of this function.
        unsafe { change(cell, attach) }
    })
}

/// Detaches a body from its link, and removes it.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `name` is null or a text that ends with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_detach(cell: *mut RccdCell, name: *const c_char) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let name = unsafe { text("name", name) }?;
        // SAFETY: the contract of this function.
        unsafe { change(cell, |cell| cell.detach(name)) }
    })
}

/// Allows two items to touch, even if they have a clearance. An item is a link, an attached body or an obstacle. The
/// permission lasts until one of them is removed, or until `rccd_cell_forbid_contact` or `rccd_cell_set_clearance` is
/// called for them.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `a` and `b` are null or texts that end with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_allow_contact(
    cell: *mut RccdCell,
    a: *const c_char,
    b: *const c_char,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { change_pair(cell, a, b, Cell::allow_contact) }
}

/// Revokes the permission of two items to touch. For two links that are not checked, adds them to the checked pairs.
///
/// # Safety
/// As for `rccd_cell_allow_contact`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_forbid_contact(
    cell: *mut RccdCell,
    a: *const c_char,
    b: *const c_char,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { change_pair(cell, a, b, Cell::forbid_contact) }
}

/// Stores a summary of the checked pairs of the cell, as lines of text: counts, then all remarks. A line that begins
/// with `warning: ` reports a probable mistake, such as a size in another unit or the SRDF of another robot, or that
/// most of the robot is not checked. The other lines list pairs and links that are not checked, with reasons. The text
/// is valid until this function is called again for the cell, or until the cell is freed.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `out` is null or points to memory for a text.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_check_summary(
    cell: *mut RccdCell,
    out: *mut RccdText,
) -> RccdStatus {
    status_of(|| {
        check_output("out", out)?;
        // SAFETY: the contract of this function.
        let RccdCell {
            cell,
            check_summary,
            ..
        } = unsafe { exclusive("cell", cell) }?;
        *check_summary = cell.check_summary().to_string();
        for remark in cell.remarks() {
            let kind = if remark.is_warning() { "warning: " } else { "" };
            check_summary.push_str(&format!("\n{kind}{remark}"));
        }
        // SAFETY: the contract of this function.
        unsafe { store("out", out, check_summary.as_str().into()) }
    })
}

/// Sets the padding of a link: the distance, in addition to the margin, that obstacles have to keep from it. 0 removes
/// it.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `link` is null or a text that ends with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_set_padding(
    cell: *mut RccdCell,
    link: *const c_char,
    distance: f64,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let link = unsafe { text("link", link) }?;
        // SAFETY: the contract of this function.
        unsafe { change(cell, |cell| cell.set_padding(link, distance)) }
    })
}

/// Sets the distance at which two items count as touching. For this pair it replaces the margin and paddings. An item is
/// a link, an attached body or an obstacle. The pair is checked from now on, even if it was not checked or was allowed to
/// touch.
///
/// # Safety
/// `cell` is null or a handle that no other call uses; `a` and `b` are null or texts that end with a zero.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn rccd_cell_set_clearance(
    cell: *mut RccdCell,
    a: *const c_char,
    b: *const c_char,
    distance: f64,
) -> RccdStatus {
    // SAFETY: the contract of this function.
    unsafe { change_pair(cell, a, b, |cell, pair| cell.set_clearance(pair, distance)) }
}

/// Changes whether, or at what distance, a pair of items is checked.
///
/// # Safety
/// As for [`rccd_cell_allow_contact`].
unsafe fn change_pair(
    cell: *mut RccdCell,
    a: *const c_char,
    b: *const c_char,
    change_cell: impl FnOnce(&mut Cell, [Item<'_>; 2]) -> Result<(), RobotError>,
) -> RccdStatus {
    status_of(|| {
        // SAFETY: the contract of this function.
        let (a, b) = unsafe { (text("a", a)?, text("b", b)?) };
        let change_named = |cell: &mut Cell| {
            let pair = [cell.item_named(a)?, cell.item_named(b)?];
            change_cell(cell, pair)
        };
        // SAFETY: the contract of this function.
        unsafe { change(cell, change_named) }
    })
}

pub(crate) fn joint_count(cell: &Cell) -> usize {
    cell.robot().independent_joint_names().len()
}

/// Reads a robot and the pairs of links to check, and stores a cell without obstacles.
///
/// # Safety
/// Each text is null or ends with a zero; `out` is null or points to memory for a handle.
unsafe fn give_cell(
    mut file: RobotFile,
    srdf: *const c_char,
    package_folder: *const c_char,
    out: *mut *mut RccdCell,
) -> Result<(), Failure> {
    // SAFETY: the contract of this function.
    let (srdf, folder) = unsafe {
        (
            text_or_none("srdf", srdf)?,
            text_or_none("package_folder", package_folder)?,
        )
    };
    if let Some(folder) = folder {
        file = file.with_package_folder(folder);
    }
    let robot = file.read().map_err(Failure::body)?;
    let pairs = file.link_pairs(&robot, srdf.map(Path::new));
    let pairs = pairs.map_err(Failure::body)?;
    let cell = RccdCell {
        joint_names: robot.independent_joint_names().map(str::to_owned).collect(),
        check_summary: String::new(),
        cell: Arc::new(Cell::new(robot, pairs)),
        changes: Arc::default(),
    };
    // SAFETY: the contract of this function.
    unsafe { give(out, cell) }
}

/// Changes a cell. If a solver shares it, changes a copy. An error leaves the cell unchanged.
///
/// # Safety
/// The pointer is null, or a handle that no other call uses.
unsafe fn change(
    cell: *mut RccdCell,
    change: impl FnOnce(&mut Cell) -> Result<(), RobotError>,
) -> Result<(), Failure> {
    // SAFETY: the contract of this function.
    let RccdCell { cell, changes, .. } = unsafe { exclusive("cell", cell) }?;
    change(Arc::make_mut(cell)).map_err(Failure::input)?;
    changes.fetch_add(1, Ordering::Release);
    Ok(())
}

/// # Safety
/// The pointer is null, or points to a pose.
unsafe fn read_pose(pose: *const RccdPose) -> Result<Pose, Failure> {
    // SAFETY: the contract of this function.
    let pose = unsafe { reference("pose", pose) }?;
    pose.to_pose().map_err(Failure::input)
}
