//! Tests which headers are refused, and that files of other formats are recognised.

use super::*;
use crate::movements::MovementRows;
use crate::paths::Grouping;

#[test]
fn repeated_columns_and_empty_tables_are_refused() {
    let twice = MotionTable::read("id,a_px,id\n".as_bytes()).unwrap_err();
    assert!(matches!(twice, TableError::RepeatedColumn { column } if column == "id"));
    let empty = MotionTable::read(&b""[..]).unwrap_err();
    assert!(matches!(empty, TableError::Empty));
    assert_eq!(read("id,a_px\n"), MotionTable::default());
}

fn refusal_message(bytes: &[u8]) -> String {
    MotionTable::read(bytes).unwrap_err().to_string()
}

#[test]
fn the_most_similar_column_is_named() {
    for (column, meant) in [
        ("a_pX", "a_px"),
        ("ID", "id"),
        ("b_endpx", "b_end_px"),
        ("durration", "duration"),
        ("a_xv", "a_vx"),
    ] {
        let message = refusal_message(format!("{column}\n").as_bytes());
        assert!(
            message.contains(&format!("did you mean `{meant}`?")),
            "{message}"
        );
    }
    let message = refusal_message(b"id,colour\n");
    assert!(
        message.contains("`colour`") && message.contains("end_qz"),
        "{message}"
    );
    assert!(!message.contains("did you mean"), "{message}");
}

#[test]
fn other_formats_are_recognised() {
    for (bytes, message) in [
        (&b"PAR1\x15\x04\x15\xff\n"[..], "is Parquet, not CSV"),
        (b"\x1f\x8b\x08\x00\x00", "is gzip"),
        (b"\xff\xfei\x00d\x00", "is text in UTF-16"),
        (b"abc\x00\xff", "is binary"),
        (b"i\xe9d\n1\n", "is not text in UTF-8"),
        (b"id;a_px\n1;2\n", "separated by ';'"),
        (b"id\ta_px\n1\t2\n", "separated by '\\t'"),
    ] {
        assert!(
            refusal_message(bytes).contains(message),
            "{}",
            refusal_message(bytes)
        );
    }
}

#[test]
fn a_first_line_of_numbers_is_not_a_header() {
    for text in ["1,2,3\n", "drop,4,-4\n", " 1e-3\n", "-.5,x\n"] {
        let message = refusal_message(text.as_bytes());
        assert!(
            message.contains("the first line must name the columns"),
            "{message}"
        );
    }
    // With a known name, it is a header with a wrong column.
    let message = refusal_message(b"id,4\n");
    assert!(message.contains("unknown column `4`"), "{message}");
}

#[test]
fn a_git_lfs_pointer_is_not_a_table() {
    let message = refusal_message(b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
    assert!(message.contains("git lfs pull"), "{message}");
}

#[test]
fn columns_that_need_each_other_come_together() {
    for (header, missing, given) in [
        ("a_qw,a_qx,a_qy", "a_qz", "a_qw"),
        ("b_end_pz", "b_end_px", "b_end_pz"),
        ("a_end_qx", "a_end_qw", "a_end_qx"),
        ("t,b_qz", "b_qw", "b_qz"),
    ] {
        let message = match MovementRows::new(header.as_bytes(), Grouping::ById) {
            Err(error) => error.to_string(),
            Ok(_) => panic!("{header} is accepted"),
        };
        let expected = format!("header: no column `{missing}`, but column `{given}` needs it");
        assert_eq!(message, expected);
    }
    // Positions and velocities have defaults.
    assert!(MotionTable::read(&b"a_px,b_vy,a_wz,b_cx\n"[..]).is_ok());
}

/// Tests that a column of an Euler angle is refused, with a message that names the columns of the quaternion.
#[test]
fn angles_are_pointed_to_quaternions() {
    for (column, columns) in [
        ("a_rx", "a_qw a_qx a_qy a_qz"),
        ("b_ry", "b_qw b_qx b_qy b_qz"),
        ("a_roll", "a_qw a_qx a_qy a_qz"),
        ("yaw", "a_qw a_qx a_qy a_qz"),
        ("B_Pitch", "b_qw b_qx b_qy b_qz"),
        ("a_end_rz", "a_end_qw a_end_qx a_end_qy a_end_qz"),
        ("b_end_yaw", "b_end_qw b_end_qx b_end_qy b_end_qz"),
        ("euler_x", "a_qw a_qx a_qy a_qz"),
    ] {
        for header in [format!("id,{column}"), format!("id,t,{column}")] {
            let header: Vec<String> = header.split(',').map(str::to_owned).collect();
            let message = Columns::of(&header).unwrap_err().to_string();
            assert!(
                message.contains(columns) && message.contains("quaternions"),
                "{message}"
            );
            assert!(message.contains(&format!("`{column}`")) && !message.contains("did you mean"));
        }
    }
    // A different misspelt name gives another error.
    let message = Columns::of(&["a_rw".to_owned()]).unwrap_err().to_string();
    assert!(message.contains("did you mean"), "{message}");
}
