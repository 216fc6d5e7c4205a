use super::*;
use ccd_core::Pose;
use ccd_core::glam::{DQuat, DVec3};

fn read(text: &str) -> MotionTable {
    MotionTable::read(text.as_bytes()).expect("a header that can be used")
}

fn only_query(text: &str) -> Query {
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
fn rows_without_id_go_by_their_index() {
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
    assert_eq!(velocities.a.spin(), DVec3::new(7.0, 8.0, 9.0));
    assert_eq!(velocities.a.centre(), DVec3::new(10.0, 11.0, 12.0));
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
    assert_eq!(query.a.spin(), DVec3::ZERO);
    assert_eq!(query.a.velocity(), 4.0 * DVec3::X);
}

#[test]
fn an_end_orientation_alone_stays_in_place() {
    let query = only_query("a_px,a_end_qw,a_end_qx,a_end_qy,a_end_qz\n7,0,1,0,0\n");
    assert_eq!(query.a.velocity(), DVec3::ZERO);
    assert!((query.a.spin().length() - std::f64::consts::PI).abs() < 1e-14);
}

#[test]
fn an_end_pose_is_reached_at_the_end_of_the_duration() {
    let query = only_query("a_end_px,a_end_py,a_end_pz,duration\n3,0,0,2\n");
    assert_eq!(query.a.velocity(), 1.5 * DVec3::X);
}

#[test]
fn empty_cells_say_nothing() {
    let table = read("a_vx,a_end_px,a_end_py,a_end_pz\n1,,,\n,1,2,3\n");
    assert_eq!(table.errors, []);
    assert_eq!(table.rows[0].1.a.velocity(), DVec3::X);
    assert_eq!(table.rows[1].1.a.velocity(), DVec3::new(1.0, 2.0, 3.0));
}

#[test]
fn numbers_have_to_be_finite() {
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
fn a_quaternion_needs_all_four() {
    let problem = only_problem("a_qw,a_qx,a_qy\n1,0,0\n");
    let expected = RowProblem::MissingColumn {
        given: "a_qw".into(),
        missing: "a_qz".into(),
    };
    assert_eq!(problem, expected);
}

#[test]
fn an_end_position_needs_all_three() {
    assert!(matches!(
        only_problem("b_end_py\n1\n"),
        RowProblem::MissingColumn { missing, .. } if missing == "b_end_px"
    ));
}

#[test]
fn a_zero_quaternion_is_named() {
    for zero in ["0,0,0,0", "0,-0,0,1e-320"] {
        let problem = only_problem(&format!("b_end_qw,b_end_qx,b_end_qy,b_end_qz\n{zero}\n"));
        assert!(
            matches!(&problem, RowProblem::ZeroQuaternion { columns, .. } if columns[0] == "b_end_qw"),
            "{zero}: {problem:?}"
        );
    }
}

#[test]
fn end_pose_and_velocity_exclude_each_other() {
    for (end, velocity) in [("end_qz", "wz"), ("end_px", "vx"), ("end_pz", "wx")] {
        let problem = only_problem(&format!("b_{end},b_{velocity}\n1,1\n"));
        let expected = RowProblem::EndPoseAndVelocity {
            end: format!("b_{end}"),
            velocity: format!("b_{velocity}"),
        };
        assert_eq!(problem, expected);
    }
    // Each body on its own may do it its own way, and the centre goes with both.
    only_query("a_end_px,a_end_py,a_end_pz,a_cx,b_vx,b_cx\n1,0,0,1,1,1\n");
}

#[test]
fn durations_have_to_be_possible() {
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
fn rows_have_the_length_of_the_header() {
    let table = read("id,a_px\n1\n2,0,3\n3,0\n");
    assert_eq!(table.rows.len(), 1);
    let places: Vec<(usize, u64)> = table
        .errors
        .iter()
        .map(|e| (e.place.row, e.place.line))
        .collect();
    assert_eq!(places, [(0, 2), (1, 3)]);
}

#[test]
fn bytes_that_are_no_text_spoil_their_row_only() {
    let table = MotionTable::read(&b"id,a_px\n\xff,1\ngood,1\n"[..]).unwrap();
    assert_eq!(table.rows.len(), 1);
    let expected = RowProblem::NotText {
        column: "id".into(),
    };
    assert_eq!(table.errors[0].problem, expected);
}

#[test]
fn headers_are_held_to_what_is_known() {
    let twice = MotionTable::read("id,a_px,id\n".as_bytes()).unwrap_err();
    assert!(matches!(twice, TableError::RepeatedColumn { column } if column == "id"));
    let empty = MotionTable::read(&b""[..]).unwrap_err();
    assert!(matches!(empty, TableError::Empty));
    assert_eq!(read("id,a_px\n"), MotionTable::default());
}

#[test]
fn a_byte_order_mark_is_no_column() {
    assert_eq!(only_query("\u{feff}id\nx\n").id, "x");
}

fn refused(bytes: &[u8]) -> String {
    MotionTable::read(bytes).unwrap_err().to_string()
}

#[test]
fn the_column_that_is_meant_is_named() {
    for (column, meant) in [
        ("a_pX", "a_px"),
        ("ID", "id"),
        ("b_endpx", "b_end_px"),
        ("durration", "duration"),
        ("a_xv", "a_vx"),
    ] {
        let told = refused(format!("{column}\n").as_bytes());
        assert!(told.contains(&format!("did you mean `{meant}`?")), "{told}");
    }
    let told = refused(b"id,colour\n");
    assert!(
        told.contains("`colour`") && told.contains("end_qz"),
        "{told}"
    );
    assert!(!told.contains("did you mean"), "{told}");
}

#[test]
fn what_is_no_csv_is_told_for_what_it_is() {
    for (bytes, told) in [
        (&b"PAR1\x15\x04\x15\xff\n"[..], "is Parquet, not CSV"),
        (b"\x1f\x8b\x08\x00\x00", "is gzip"),
        (b"\xff\xfei\x00d\x00", "is text in UTF-16"),
        (b"abc\x00\xff", "is binary"),
        (b"i\xe9d\n1\n", "is not text in UTF-8"),
        (b"id;a_px\n1;2\n", "separated by ';'"),
        (b"id\ta_px\n1\t2\n", "separated by '\\t'"),
    ] {
        assert!(refused(bytes).contains(told), "{}", refused(bytes));
    }
}

/// Neither are the rows before it lost, nor does it take those that follow for one cell.
#[test]
fn a_quote_that_nobody_closes_is_told_where_it_opens() {
    for (text, rows, expected) in [
        ("id,a_px\n0,1\n\n1,\"2\n2,3\n", 1, (Some(1), 4)),
        ("id,a_px\n\"a\nb\",1\n\"c\n\n,2\n", 1, (Some(1), 4)),
        ("id,a_px\n0,1\n1,\"", 1, (Some(1), 3)),
        ("id,a_px\n0,\"1\"\"\n1,2\n", 0, (Some(0), 2)),
        ("\u{feff}\n\"id,a_px\n0,1\n", 0, (None, 2)),
    ] {
        for end in ["\n", "\r\n", "\r"] {
            let text = text.replace('\n', end);
            let mut read = 0;
            let told = MotionRows::new(text.as_bytes()).and_then(|mut table| {
                read = table.by_ref().take(rows).filter(Result::is_ok).count();
                table.next().transpose()
            });
            let Err(TableError::UnclosedQuote { row, line }) = told else {
                panic!("{text:?}: {told:?}");
            };
            assert_eq!((read, (row, line)), (rows, expected), "{text:?}");
        }
    }
    // Rows that are passed over are rows all the same.
    let mut passing = MotionRows::new(&b"id\n0\n\"1\n2\n"[..]).unwrap();
    assert!(matches!(
        passing.pass(9),
        Err(TableError::UnclosedQuote {
            row: Some(1),
            line: 3
        })
    ));
}

/// However many rows wait in memory behind the one that is read.
#[test]
fn quotes_that_are_closed_are_legal() {
    let mut text = "id,a_px\n".to_owned();
    for k in 0..5000 {
        text += &format!("\"{k}\n, \"\"x\"\"\",\"{k}\"\n");
    }
    let table = read(&text);
    assert_eq!((table.rows.len(), table.errors.len()), (5000, 0));
    assert_eq!(table.rows[7].1.id, "7\n, \"x\"");
}

#[test]
fn a_first_line_of_numbers_is_no_header() {
    for text in ["1,2,3\n", "drop,4,-4\n", " 1e-3\n", "-.5,x\n"] {
        let told = refused(text.as_bytes());
        assert!(
            told.contains("the first line has to name the columns"),
            "{told}"
        );
    }
    // With a name among them it is one, and a wrong one.
    let told = refused(b"id,4\n");
    assert!(told.contains("unknown column `4`"), "{told}");
}

#[test]
fn a_pointer_of_git_lfs_is_no_table() {
    let told = refused(b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
    assert!(told.contains("git lfs pull"), "{told}");
}

#[test]
fn numbers_of_many_digits_are_told_in_few() {
    for (text, expected) in [
        ("duration\n-1e308\n", "column duration: -1e308 is not"),
        ("a_qw,a_qx,a_qy,a_qz\n1e-320,0,-0,0\n", "(1e-320 0 -0 0)"),
    ] {
        let told = only_problem(text).to_string();
        assert!(told.contains(expected), "{told}");
    }
}

/// Of two ways as short the sign of the quaternion says which.
#[test]
fn half_a_turn_goes_the_way_that_its_axis_points() {
    let spin = |end: &str| {
        let text = format!("a_end_qw,a_end_qx,a_end_qy,a_end_qz\n{end}\n");
        only_query(&text).a.spin()
    };
    let half = std::f64::consts::PI;
    assert_eq!(spin("0,0,0,1"), half * DVec3::Z);
    assert_eq!(spin("0,0,0,-1"), -half * DVec3::Z);
    // Elsewhere both signs are one orientation, and one way.
    assert_eq!(spin("1,0,0,1"), spin("-1,0,0,-1"));
}

/// Whatever ends the lines: every row is told by the line that an editor shows it on.
#[test]
fn lines_are_counted_as_editors_count_them() {
    let text = "\u{feff}\nid,a_px\n\nx1,x\n\n\n\"a\nb\",x\nx3,x\n  ,x\n\"c\n\n\",\"\n1\n\"\nlast,x";
    let expected = [(0, 4), (1, 7), (2, 9), (3, 10), (5, 16)];
    for end in ["\n", "\r\n", "\r"] {
        for last in ["", end] {
            let text = text.replace('\n', end) + last;
            let table = read(&text);
            let places: Vec<(usize, u64)> = table
                .errors
                .iter()
                .map(|error| (error.place.row, error.place.line))
                .collect();
            assert_eq!(places, expected, "{end:?} {last:?}");
            let ids: Vec<&str> = table.errors.iter().map(|error| error.id.as_str()).collect();
            assert_eq!(ids, ["x1", "a\nb", "x3", "3", "last"]);
            assert_eq!(table.rows[0].1.a.start().translation(), DVec3::X);
        }
    }
}

/// One byte at a time, so that every pair of a return and a line feed is split.
struct Drip<'a>(&'a [u8]);

impl io::Read for Drip<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let some = out.len().min(1);
        self.0.read(&mut out[..some])
    }
}

#[test]
fn lines_split_anywhere_are_the_same_lines() {
    let text = "id,a_px\r\n\r\n1,x\r\n2,2\r\n";
    let mut rows = MotionRows::new(Drip(text.as_bytes())).unwrap();
    let error = rows.next().unwrap().unwrap().unwrap_err();
    assert_eq!((error.place.row, error.place.line), (0, 3));
    assert!(rows.next().unwrap().unwrap().is_ok());
    assert!(rows.next().is_none());
    assert_eq!(rows.bytes(), text.len() as u64);
}

#[test]
fn rows_that_are_passed_over_are_counted() {
    let text = "id,a_px\n1,1\n2,x\n3,x\n";
    let rows = || MotionRows::new(text.as_bytes()).unwrap();
    let (mut passing, mut reading) = (rows(), rows());
    assert_eq!(passing.pass(2).unwrap(), 2);
    reading.by_ref().take(2).for_each(drop);
    assert_eq!(passing.checksum(), reading.checksum());
    let error = passing.next().unwrap().unwrap().unwrap_err();
    assert_eq!((error.place.row, error.place.line), (2, 4));
    assert_ne!(passing.checksum(), reading.checksum());
    assert_eq!(rows().pass(9).unwrap(), 3);
}
