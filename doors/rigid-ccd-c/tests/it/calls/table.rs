//! The table of all functions of the header, with the generators of their arguments.

use super::call::Call;
use rigid_ccd_c::*;
use std::ffi::{CStr, c_char};

pub(super) struct Function {
    pub(super) name: &'static str,
    /// The relative frequency of calls.
    pub(super) weight: u32,
    pub(super) call: fn(&mut Call<'_, '_>) -> Returned,
}

/// The result type of a function.
pub(super) enum Returned {
    Status(RccdStatus),
    /// A function that cannot fail.
    Nothing,
}

/// A function, the frequency of its calls, and the generators of its arguments, in the order of the header.
macro_rules! functions {
    ($($name:ident $weight:literal $returns:ident ($($argument:ident),*);)*) => {
        &[$(Function {
            name: stringify!($name),
            weight: $weight,
            call: |_call| functions!($returns, $name($(_call.$argument()),*)),
        }),*]
    };
    (value, $call:expr) => {{
        $call.check();
        Returned::Nothing
    }};
    (status, $call:expr) => {{
        // SAFETY: what draws arguments keeps to the contract of the interface: pointers are null, misaligned, or to as many
        // values as the counts say.
        Returned::from(unsafe { $call })
    }};
}

impl From<RccdStatus> for Returned {
    fn from(status: RccdStatus) -> Self {
        Returned::Status(status)
    }
}

impl From<()> for Returned {
    fn from((): ()) -> Self {
        Returned::Nothing
    }
}

pub(super) const FUNCTIONS: &[Function] = functions! {
    rccd_body_sphere 12 status (length, new_handle);
    rccd_body_capsule 12 status (length, length, new_handle);
    rccd_body_box 12 status (length, length, length, new_handle);
    rccd_body_cylinder 1 status (length, length, new_handle);
    rccd_body_cone 1 status (length, length, new_handle);
    rccd_body_from_triangles 4 status (vertices, count, triangles, count, pieces, new_handle);
    rccd_body_prepare 1 status (vertices, count, triangles, count, pieces, stored_file);
    rccd_body_load 8 status (body_file, new_handle);
    rccd_body_free 12 status (freed);
    rccd_body_piece_count 8 status (handle, new_piece_count);
    rccd_body_is_solid 4 status (handle, new_is_solid);
    rccd_body_excess 4 status (handle, new_excess);
    rccd_cell_load 2 status (robot_file, srdf_file, package_folder, new_handle);
    rccd_cell_from_text 2 status (robot_text, package_folder, srdf_file, package_folder, new_handle);
    rccd_cell_free 4 status (freed);
    rccd_cell_joint_count 8 status (handle, new_joint_count);
    rccd_cell_joint 12 status (owner, joint_number, new_text, new_limit, new_limit);
    rccd_cell_add_obstacle 12 status (handle, obstacle, handle, pose);
    rccd_cell_move_obstacle 12 status (handle, obstacle, pose);
    rccd_cell_remove_obstacle 10 status (handle, obstacle);
    rccd_cell_attach 16 status (handle, attached, handle, link, pose, links, count);
    rccd_cell_detach 12 status (handle, attached);
    rccd_cell_allow_contact 8 status (handle, item, item);
    rccd_cell_forbid_contact 8 status (handle, moving_link, obstacle);
    rccd_cell_check_summary 4 status (handle, new_summary);
    rccd_cell_set_padding 12 status (handle, link, distance);
    rccd_cell_set_clearance 12 status (handle, item, item, distance);
    rccd_cell_solver_new 48 status (cell_to_ask, settings, new_handle);
    rccd_cell_solver_set_settings 12 status (owner, settings);
    rccd_cell_solver_free 8 status (freed);
    rccd_cell_first_contact 40 status (owner, path, path_answer);
    rccd_cell_any_contact 40 status (owner, path, path_answer);
    rccd_cell_closest_approach 24 status (owner, path, path_answer);
    rccd_evidence_write 2 status (cell_to_ask, settings, path, given_answer, record_file);
    rccd_joint_curve_through 16 status (hermite, next, next, next, count, count, new_handle);
    rccd_joint_curve_from_polynomials 16 status (polynomials, next, count, count, count, new_handle);
    rccd_joint_curve_free 8 status (freed);
    rccd_motion_at_rest 4 value ();
    rccd_motion_between 16 status (pose, pose, vector, duration, new_motion);
    rccd_settings_default 8 status (new_settings);
    rccd_solver_new 12 status (settings, new_handle);
    rccd_solver_set_settings 12 status (owner, settings);
    rccd_solver_free 8 status (freed);
    rccd_first_contact 56 status (solver, moving, moving, duration, answer);
    rccd_any_contact 40 status (solver, moving, moving, duration, answer);
    rccd_contact_interval 32 status (solver, moving, moving, duration, answer);
    rccd_closest_approach 32 status (solver, moving, moving, duration, answer);
    rccd_keeps_clearance 32 status (solver, moving, moving, duration, clearance, answer);
    rccd_last_error 4 value ();
    rccd_version 4 value ();
    rccd_stop_new 8 status (new_handle);
    rccd_stop_set 4 status (handle);
    rccd_stop_clear 16 status (handle);
    rccd_stop_free 4 status (freed);
    rccd_trajectory_pose_path 16 status (times_of_poses, next, count, new_handle);
    rccd_trajectory_ballistic 12 status (motion, vector, new_handle);
    rccd_trajectory_bezier 12 status (points, count, duration, turns, new_handle);
    rccd_trajectory_b_spline 12 status (points, count, duration, turns, new_handle);
    rccd_trajectory_free 8 status (freed);
};

/// The result of a function without arguments.
trait Constant {
    fn check(self);
}

impl Constant for RccdMotion {
    fn check(self) {
        assert_eq!((self.velocity, self.start.rotation[3]), ([0.0; 3], 1.0));
    }
}

impl Constant for *const c_char {
    fn check(self) {
        // SAFETY: the text ends with a zero, and no call follows before the end of this function.
        assert!(unsafe { CStr::from_ptr(self) }.to_str().is_ok());
    }
}
