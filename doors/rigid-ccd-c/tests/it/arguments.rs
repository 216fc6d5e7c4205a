//! Tests that wrong arguments are errors with a message, and change nothing.

use crate::support::{Handle, default_settings, empty_answer, last_error, moving, ok, sphere};
use rigid_ccd_c::*;
use std::ptr::{dangling, null, null_mut};

/// Asserts that a call has failed because of an argument, with a message that names the argument.
#[track_caller]
fn refused(status: RccdStatus, named: &str) {
    let message = last_error();
    assert_eq!(status, RccdStatus::InvalidArgument, "{message}");
    assert!(
        message.contains(named),
        "{message:?} does not name {named:?}"
    );
}

#[test]
fn null_and_wrong_sizes_are_refused_with_their_names() {
    let (solver, ball) = (crate::support::solver(None), sphere(0.5));
    let motion = rccd_motion_at_rest();
    let body = moving(&ball, &motion);
    let without_body = RccdMovingBody {
        body: null(),
        ..body
    };
    let mut answer = empty_answer();
    let before = answer;
    let mut of_no_size = RccdAnswer { size: 0, ..answer };
    // SAFETY: pointers are null or to values of their types.
    unsafe {
        let s = solver.pointer();
        refused(
            rccd_first_contact(null_mut(), &body, &body, 1.0, &mut answer),
            "solver",
        );
        refused(
            rccd_first_contact(s, null(), &body, 1.0, &mut answer),
            "a is null",
        );
        refused(
            rccd_any_contact(s, &body, null(), 1.0, &mut answer),
            "b is null",
        );
        refused(
            rccd_contact_interval(s, &body, &without_body, 1.0, &mut answer),
            "body is null",
        );
        refused(
            rccd_closest_approach(s, &body, &body, 1.0, null_mut()),
            "answer is null",
        );
        refused(
            rccd_first_contact(s, &body, &body, 1.0, &mut of_no_size),
            "size of the answer is 0, and at least ",
        );
        refused(rccd_body_sphere(1.0, null_mut()), "out is null");
        refused(rccd_body_load(null(), null_mut()), "path is null");
        let mut out = null_mut();
        refused(
            rccd_body_from_triangles(null(), 3, null(), 1, 0, &mut out),
            "vertices is null",
        );
        refused(
            rccd_body_from_triangles(null(), 0, null(), 0, 9, &mut out),
            "pieces 9",
        );
        let many = usize::MAX / 8;
        let somewhere = dangling();
        refused(
            rccd_body_from_triangles(somewhere, many, null(), 0, 0, &mut out),
            &format!("vertices is too long: {many} elements of 24 bytes"),
        );
        let not_aligned = somewhere.wrapping_byte_add(1);
        refused(
            rccd_body_from_triangles(not_aligned, 1, null(), 0, 0, &mut out),
            "not aligned",
        );
        assert!(out.is_null());
        let settings = RccdSettings {
            start_policy: 7,
            ..default_settings()
        };
        refused(rccd_solver_set_settings(s, &settings), "start_policy 7");
        let settings = RccdSettings {
            contact_normals: 2,
            ..default_settings()
        };
        refused(rccd_solver_set_settings(s, &settings), "contact_normals 2");
        let settings = RccdSettings {
            size: 8,
            ..default_settings()
        };
        let size = size_of::<RccdSettings>();
        refused(
            rccd_solver_set_settings(s, &settings),
            &format!("size of settings is 8, not from {size} to {size}"),
        );
    }
    assert_eq!(answer, before);
}

#[test]
fn numbers_out_of_range_are_refused() {
    let (solver, ball) = (crate::support::solver(None), sphere(0.5));
    let motion = rccd_motion_at_rest();
    let mut no_rotation = motion;
    no_rotation.start.rotation = [0.0; 4];
    let mut answer = empty_answer();
    // SAFETY: pointers are null or to values of their types.
    unsafe {
        let s = solver.pointer();
        let mut out = null_mut();
        let bad = RccdStatus::InvalidInput;
        assert_eq!(rccd_body_sphere(f64::NAN, &mut out), bad);
        assert_eq!(rccd_body_box(1.0, -1.0, 1.0, &mut out), bad);
        let (one, other) = (moving(&ball, &motion), moving(&ball, &no_rotation));
        assert_eq!(rccd_first_contact(s, &one, &one, -1.0, &mut answer), bad);
        assert_eq!(rccd_first_contact(s, &one, &other, 1.0, &mut answer), bad);
        assert!(last_error().contains("quaternion"), "{}", last_error());
        for deadline in [f64::NAN, -1.0, 1e300] {
            let settings = RccdSettings {
                deadline,
                ..default_settings()
            };
            assert_eq!(rccd_solver_set_settings(s, &settings), bad);
        }
        let nothing = [0.0f64; 3];
        let no_triangles = rccd_body_from_triangles(nothing.as_ptr(), 1, null(), 0, 0, &mut out);
        assert_eq!(no_triangles, RccdStatus::InvalidBody);
        assert_eq!(
            rccd_body_load(c"no such file.obj".as_ptr(), &mut out),
            RccdStatus::InvalidBody
        );
        assert!(
            last_error().contains("no such file.obj"),
            "{}",
            last_error()
        );
        assert!(out.is_null());
    }
}

/// Tests that a call fills an answer in which C has set only the size.
#[test]
fn a_place_for_an_answer_holds_none_before() {
    let (solver, ball) = (crate::support::solver(None), sphere(0.5));
    let motion = rccd_motion_at_rest();
    let body = moving(&ball, &motion);
    let mut place = std::mem::MaybeUninit::<RccdAnswer>::uninit();
    let out = place.as_mut_ptr();
    // SAFETY: the place is written as bytes, and then by the call.
    let answer = unsafe {
        out.write_bytes(0xaa, 1);
        (&raw mut (*out).size).write(size_of::<RccdAnswer>());
        ok(rccd_first_contact(solver.pointer(), &body, &body, 1.0, out));
        place.assume_init()
    };
    assert_eq!(answer.outcome, RccdOutcome::Overlapping);
}

#[test]
fn freeing_null_is_nothing_and_bodies_are_counted() {
    let ball = sphere(1.0);
    let mut count = 0;
    // SAFETY: null, or pointers to values that live here.
    unsafe {
        rccd_body_free(null_mut());
        rccd_solver_free(null_mut());
        rccd_trajectory_free(null_mut());
        ok(rccd_body_piece_count(ball.pointer(), &mut count));
    }
    assert_eq!(count, 1);
}

#[test]
fn prepared_bodies_answer_as_those_that_were_stored() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("body.ccd");
    let path = std::ffi::CString::new(path.to_str().unwrap()).unwrap();
    let vertices = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.0, 1.0, 0.5],
    ];
    let triangles = [[0_u32, 1, 2], [1, 3, 2]];
    let pieces = RccdPieces::Triangles as u32;
    // SAFETY: the counts are those of the arrays.
    unsafe {
        let (points, corners) = (vertices.as_ptr().cast(), triangles.as_ptr().cast());
        ok(rccd_body_prepare(
            points,
            4,
            corners,
            2,
            pieces,
            path.as_ptr(),
        ));
        let loaded = Handle::new(rccd_body_free, |out| rccd_body_load(path.as_ptr(), out));
        let made = Handle::new(rccd_body_free, |out| {
            rccd_body_from_triangles(points, 4, corners, 2, pieces, out)
        });
        let (solver, ball) = (crate::support::solver(None), sphere(0.25));
        let mut falls = rccd_motion_at_rest();
        falls.start.position = [0.6, 0.6, 2.0];
        falls.velocity = [0.0, 0.0, -1.0];
        let rests = rccd_motion_at_rest();
        let [a, b] = [&loaded, &made].map(|body| {
            let mut answer = empty_answer();
            let (ball, body) = (moving(&ball, &falls), moving(body, &rests));
            ok(rccd_first_contact(
                solver.pointer(),
                &ball,
                &body,
                2.0,
                &mut answer,
            ));
            answer
        });
        assert_eq!(a.outcome, RccdOutcome::Contact);
        assert_eq!(a.time.to_bits(), b.time.to_bits());
        refused(
            rccd_body_prepare(points, 4, corners, 2, pieces, null()),
            "path is null",
        );
    }
}

#[test]
fn bodies_say_whether_they_are_solid_and_by_how_much_they_exceed_their_shape() {
    let (ball, cylinder) = (sphere(0.5), crate::support::cylinder(0.5, 1.0));
    let vertices = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let triangles = [[0_u32, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let tetrahedron = |count: usize| {
        // SAFETY: the counts are those of the arrays, or less.
        Handle::new(rccd_body_free, |out| unsafe {
            let (points, corners) = (vertices.as_ptr().cast(), triangles.as_ptr().cast());
            rccd_body_from_triangles(points, 4, corners, count, RccdPieces::Auto as u32, out)
        })
    };
    let (closed, open) = (tetrahedron(4), tetrahedron(3));
    for (body, solid, exceeds) in [
        (&ball, 1, false),
        (&cylinder, 1, true),
        (&closed, 1, false),
        (&open, 0, false),
    ] {
        let (mut is_solid, mut excess) = (-1, f64::NAN);
        // SAFETY: the places are local variables.
        unsafe {
            ok(rccd_body_is_solid(body.pointer(), &mut is_solid));
            ok(rccd_body_excess(body.pointer(), &mut excess));
        }
        assert_eq!((is_solid, excess > 0.0), (solid, exceeds), "{excess}");
    }
}
