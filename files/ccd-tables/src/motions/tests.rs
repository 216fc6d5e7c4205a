mod header;
mod lines;

use super::*;
use ccd_core::Pose;
use ccd_core::glam::{DQuat, DVec3};

fn read(text: &str) -> MotionTable {
    MotionTable::read(text.as_bytes()).expect("a header that can be used")
}

fn only_query(text: &str) -> Motions {
    let table = read(text);
    assert_eq!(table.errors, []);
    assert_eq!(table.rows.len(), 1);
    table.rows[0].1.clone()
}

fn only_problem(text: &str) -> RowProblem {
    let table = read(text);
    assert_eq!(table.rows, []);
    assert_eq!(table.errors.len(), 1);
    table.errors[0].problem.clone()
}

#[test]
fn a_row_without_motion_is_at_rest_for_a_unit_of_time() {
    let query = only_query("id\nnone\n");
    assert_eq!(query.id, "none");
    assert_eq!(query.a, Motion::still(Pose::IDENTITY));
    assert_eq!(query.b, Motion::still(Pose::IDENTITY));
    assert_eq!(query.duration, 1.0);
}

#[test]
fn the_default_id_is_the_number_of_the_row() {
    let table = read("a_px\n1\n2\n");
    let ids: Vec<&str> = table.rows.iter().map(|(_, q)| q.id.as_str()).collect();
    assert_eq!(ids, ["0", "1"]);
}

#[test]
fn columns_go_by_name_and_may_be_padded() {
    let query = only_query("b_vz , id,a_py\n -2.5e0 , x , 3\n");
    assert_eq!(query.a.start().translation(), 3.0 * DVec3::Y);
    assert_eq!(query.b.velocity(), -2.5 * DVec3::Z);
}

#[test]
fn every_column_reaches_its_quantity() {
    let velocities = only_query(
        "a_px,a_py,a_pz,a_vx,a_vy,a_vz,a_wx,a_wy,a_wz,a_cx,a_cy,a_cz,duration\n\
         1,2,3,4,5,6,7,8,9,10,11,12,13\n",
    );
    assert_eq!(
        velocities.a.start().translation(),
        DVec3::new(1.0, 2.0, 3.0)
    );
    assert_eq!(velocities.a.velocity(), DVec3::new(4.0, 5.0, 6.0));
    assert_eq!(velocities.a.angular_velocity(), DVec3::new(7.0, 8.0, 9.0));
    assert_eq!(velocities.a.center(), DVec3::new(10.0, 11.0, 12.0));
    assert_eq!(velocities.duration, 13.0);

    let poses = only_query(
        "b_qw,b_qx,b_qy,b_qz,b_end_px,b_end_py,b_end_pz,b_end_qw,b_end_qx,b_end_qy,b_end_qz\n\
         0,1,0,0,1,2,3,0,0,1,0\n",
    );
    let end = poses.b.pose(1.0);
    assert_eq!(
        poses.b.start().rotation(),
        DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0)
    );
    assert!(end.translation().distance(DVec3::new(1.0, 2.0, 3.0)) < 1e-14);
    assert!(
        end.rotation()
            .dot(DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0))
            .abs()
            > 1.0 - 1e-14
    );
}

#[test]
fn quaternions_are_normalised() {
    let query = only_query("a_qw,a_qx,a_qy,a_qz\n0,0,0,-20\n");
    assert_eq!(
        query.a.start().rotation(),
        DQuat::from_xyzw(0.0, 0.0, -1.0, 0.0)
    );
}

#[test]
fn an_end_position_alone_does_not_turn() {
    let query = only_query("a_qw,a_qx,a_qy,a_qz,a_end_px,a_end_py,a_end_pz\n0,1,0,0,4,0,0\n");
    assert_eq!(query.a.angular_velocity(), DVec3::ZERO);
    assert_eq!(query.a.velocity(), 4.0 * DVec3::X);
}

#[test]
fn an_end_orientation_alone_stays_in_place() {
    let query = only_query("a_px,a_end_qw,a_end_qx,a_end_qy,a_end_qz\n7,0,1,0,0\n");
    assert_eq!(query.a.velocity(), DVec3::ZERO);
    assert!((query.a.angular_velocity().length() - std::f64::consts::PI).abs() < 1e-14);
}

#[test]
fn an_end_pose_is_reached_at_the_end_of_the_duration() {
    let query = only_query("a_end_px,a_end_py,a_end_pz,duration\n3,0,0,2\n");
    assert_eq!(query.a.velocity(), 1.5 * DVec3::X);
}

#[test]
fn a_row_leaves_the_velocities_or_the_end_pose_empty() {
    let table = read("a_vx,a_end_px,a_end_py,a_end_pz\n1,,,\n,1,2,3\n");
    assert_eq!(table.errors, []);
    assert_eq!(table.rows[0].1.a.velocity(), DVec3::X);
    assert_eq!(table.rows[1].1.a.velocity(), DVec3::new(1.0, 2.0, 3.0));
}

/// Tests that an empty cell is an error, because some programs write a missing number as one.
#[test]
fn other_empty_cells_are_errors() {
    for (text, column) in [
        ("id,a_px\n0,\n", "a_px"),
        ("a_px,b_py\n1,\n", "b_py"),
        ("a_vx,a_vy\n1,\n", "a_vy"),
        ("a_vx,b_wz\n1,\n", "b_wz"),
        ("id,a_cx\n0,\n", "a_cx"),
        ("id,duration\n0,\n", "duration"),
        ("a_qw,a_qx,a_qy,a_qz\n1,0,0,\n", "a_qz"),
        ("a_qw,a_qx,a_qy,a_qz\n,,,\n", "a_qw"),
        ("b_end_px,b_end_py,b_end_pz\n,1,\n", "b_end_px"),
        ("b_end_px,b_end_py,b_end_pz\n,,\n", "b_end_px"),
        ("a_vx,a_end_px,a_end_py,a_end_pz\n,,,\n", "a_end_px"),
    ] {
        let column = column.to_owned();
        assert_eq!(
            only_problem(text),
            RowProblem::EmptyCell { column },
            "{text}"
        );
    }
}

#[test]
fn the_index_of_pandas_is_named_as_such() {
    for header in [",a_px\n0,1\n", "a_px,__index_level_0__\n1,0\n"] {
        let error = MotionTable::read(header.as_bytes()).unwrap_err();
        assert!(matches!(&error, TableError::PandasIndex { .. }), "{error}");
        assert!(error.to_string().contains("index=False"));
    }
}

#[test]
fn numbers_must_be_finite() {
    for bad in ["abc", "NaN", "inf", "1,5", "1e999", "0x10"] {
        let problem = only_problem(&format!("id,b_wz\n1,\"{bad}\"\n"));
        let expected = RowProblem::NotANumber {
            column: "b_wz".into(),
            value: bad.into(),
        };
        assert_eq!(problem, expected);
    }
}

#[test]
fn a_zero_quaternion_is_refused() {
    for zero in ["0,0,0,0", "0,-0,0,0"] {
        let problem = only_problem(&format!("b_end_qw,b_end_qx,b_end_qy,b_end_qz\n{zero}\n"));
        assert!(
            matches!(&problem, RowProblem::ZeroQuaternion { columns, .. } if columns[0] == "b_end_qw"),
            "{zero}: {problem:?}"
        );
    }
}

#[test]
fn end_pose_and_velocity_exclude_each_other() {
    let ends = [
        ("b_end_px,b_end_py,b_end_pz", "1,,", "b_end_px"),
        ("b_end_px,b_end_py,b_end_pz", ",,1", "b_end_pz"),
        ("b_end_qw,b_end_qx,b_end_qy,b_end_qz", ",,,1", "b_end_qz"),
    ];
    for ((columns, cells, end), velocity) in ends.into_iter().zip(["b_vx", "b_wx", "b_wz"]) {
        let problem = only_problem(&format!("{columns},{velocity}\n{cells},1\n"));
        let expected = RowProblem::EndPoseAndVelocity {
            end_pose_column: end.to_owned(),
            velocity_column: velocity.to_owned(),
        };
        assert_eq!(problem, expected);
    }
    // The two bodies may use different columns, and both kinds accept a center.
    only_query("a_end_px,a_end_py,a_end_pz,a_cx,b_vx,b_cx\n1,0,0,1,1,1\n");
}

#[test]
fn durations_must_be_possible() {
    assert_eq!(
        only_problem("duration\n-1\n"),
        RowProblem::BadDuration {
            value: -1.0,
            allowed: "at least 0"
        }
    );
    assert!(matches!(
        only_problem("duration,a_end_px,a_end_py,a_end_pz\n0,1,1,1\n"),
        RowProblem::BadDuration { .. }
    ));
    assert_eq!(only_query("duration,a_vx\n0,1\n").duration, 0.0);
}

#[test]
fn large_numbers_have_few_digits_in_messages() {
    for (text, expected) in [
        ("duration\n-1e308\n", "column duration: -1e308 is not"),
        ("a_qw,a_qx,a_qy,a_qz\n0,0,-0,0\n", "(0 0 -0 0)"),
    ] {
        let message = only_problem(text).to_string();
        assert!(message.contains(expected), "{message}");
    }
}

/// Tests that the sign of the quaternion decides between the two rotation vectors of a half turn.
#[test]
fn half_a_turn_is_about_the_axis_as_given() {
    let spin = |end: &str| {
        let text = format!("a_end_qw,a_end_qx,a_end_qy,a_end_qz\n{end}\n");
        only_query(&text).a.angular_velocity()
    };
    let half = std::f64::consts::PI;
    assert_eq!(spin("0,0,0,1"), half * DVec3::Z);
    assert_eq!(spin("0,0,0,-1"), -half * DVec3::Z);
    // For other angles, both signs are the same rotation.
    assert_eq!(spin("1,0,0,1"), spin("-1,0,0,-1"));
}
