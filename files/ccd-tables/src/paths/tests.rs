use super::*;
use crate::movements::{MovementRow, MovementRows, Movements};
use ccd_core::glam::DVec3;

fn rows(text: &str, grouping: Grouping) -> Vec<MovementRow> {
    let rows = MovementRows::new(text.as_bytes(), grouping).expect("a header that can be used");
    assert!(rows.is_path_table());
    rows.map(|row| row.expect("a table that can be read"))
        .collect()
}

fn paths(text: &str) -> Vec<PathPair> {
    let rows = rows(text, Grouping::ById).into_iter();
    rows.map(|row| match row {
        Ok((_, Movements::Path(path))) => path,
        other => panic!("no path: {other:?}"),
    })
    .collect()
}

/// Returns the row and the message of the only error in a table.
fn only_problem(text: &str) -> (usize, String) {
    let rows = rows(text, Grouping::ById);
    let mut errors = rows.into_iter().filter_map(Result::err);
    let error = errors.next().expect("an error");
    assert_eq!(errors.next(), None);
    (error.position.row, error.problem.to_string())
}

fn positions_of_a(path: &PathPair, times: &[f64]) -> Vec<[f64; 3]> {
    let place = |&time| path.poses_at(time).unwrap()[0].translation().to_array();
    times.iter().map(place).collect()
}

#[test]
fn rows_of_an_id_are_one_path() {
    let read = paths(
        "t,id,a_px,b_py\n\
         0,one,0,7\n\
         2,one,4,7\n\
         4,one,0,7\n\
         0,two,1,0\n",
    );
    let [one, two] = &read[..] else {
        panic!("two paths, not {read:?}")
    };
    assert_eq!((one.id.as_str(), one.duration), ("one", 4.0));
    let expected = [[0.0; 3], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 0.0, 0.0]];
    assert_eq!(positions_of_a(one, &[0.0, 1.0, 2.0, 3.0]), expected);
    assert_eq!(one.poses_at(3.0).unwrap()[1].translation(), 7.0 * DVec3::Y);
    assert_eq!((two.id.as_str(), two.duration), ("two", 0.0));
}

#[test]
fn a_table_without_ids_is_one_path() {
    let read = paths("t,a_px\n0,0\n1,1\n");
    assert_eq!(read.len(), 1);
    assert_eq!((read[0].id.as_str(), read[0].duration), ("0", 1.0));
}

#[test]
fn each_row_may_be_a_pose_at_rest() {
    let rows = rows("id,t,a_px\nx,0,1\nx,5,2\ny,7,3\n", Grouping::QueryPerRow);
    let read: Vec<(usize, String, f64, f64)> = rows
        .into_iter()
        .map(|row| match row {
            Ok((position, Movements::Path(path))) => {
                let x = path.poses_at(0.0).unwrap()[0].translation().x;
                (
                    position.row,
                    path.id.clone(),
                    path.table_time_rounded_down(0.0),
                    x,
                )
            }
            other => panic!("no pose: {other:?}"),
        })
        .collect();
    let expected = [(0, "x", 0.0, 1.0), (1, "x", 5.0, 2.0), (2, "y", 7.0, 3.0)];
    let expected = expected.map(|(row, id, time, x)| (row, id.to_owned(), time, x));
    assert_eq!(read, expected);
}

#[test]
fn times_may_begin_anywhere() {
    let read = paths("t,a_px\n1e9,0\n1000000000.5,1\n");
    let path = &read[0];
    assert_eq!((path.start_time, path.duration), (1e9, 0.5));
    assert_eq!(
        (
            path.table_time_rounded_down(0.0),
            path.table_time_rounded_down(0.5)
        ),
        (1e9, 1e9 + 0.5)
    );
    let (early, late) = (
        path.table_time_rounded_down(0.25),
        path.table_time_rounded_up(0.25),
    );
    assert!(early < 1e9 + 0.25 && late > 1e9 + 0.25 && late - early < 1e-5);
    let from_zero = &paths("t\n0\n1\n")[0];
    assert_eq!(
        (
            from_zero.table_time_rounded_down(0.1),
            from_zero.table_time_rounded_up(0.1)
        ),
        (0.1, 0.1)
    );
}

#[test]
fn a_path_that_cannot_be_followed_is_an_error() {
    for (text, row, problem) in [
        (
            "id,t\na,0\na,2\na,2\na,3\n",
            2,
            "column t: 2 is not later than 2",
        ),
        ("id,t\na,0\na,\n", 1, "column t: no value"),
        ("id,t\na,0\n,1\n", 1, "column id: no value"),
        (
            "t\n-1e17\n0.1\n0.2\n",
            2,
            "column t: 0.2 is so long after -1e17",
        ),
        ("t\n-1e308\n1e308\n", 1, "column t: 1e308 is so long after"),
        (
            "id,t\na,0\nb,0\na,1\n",
            2,
            "path `a` goes on here after rows of other paths",
        ),
        ("id,t,a_px\na,0,1\na,1,x\n", 1, "column a_px: `x`"),
        (
            "id,t,a_px\na,0,1\na,1\n",
            1,
            "has 2 cells, but the header has 3",
        ),
        (
            "t,a_qw,a_qx,a_qy,a_qz\n0,0,0,0,0\n",
            0,
            "columns a_qw a_qx a_qy a_qz",
        ),
    ] {
        let (at, message) = only_problem(text);
        assert_eq!(at, row, "{text}");
        assert!(message.starts_with(problem), "{message}");
    }
}

/// Tests that in a half turn the center of rotation, (1, 0, 0), moves in a straight line, and the body's origin turns
/// about it.
#[test]
fn a_path_has_a_center_of_rotation() {
    let read = paths("t,a_px,a_qw,a_qx,a_qy,a_qz,a_cx,b_cy\n0,0,1,0,0,0,1,7\n2,2,0,0,0,1,1,7\n");
    let expected = [[0.0; 3], [1.0, -1.0, 0.0], [2.0, 0.0, 0.0]];
    for (place, expected) in positions_of_a(&read[0], &[0.0, 1.0, 2.0])
        .into_iter()
        .zip(expected)
    {
        let off = DVec3::from(place).distance(expected.into());
        assert!(off < 1e-14, "{place:?}");
    }
    let (row, message) = only_problem("t,a_cx\n0,1\n1,1\n2,1.5\n");
    assert_eq!(row, 2);
    assert!(
        message.starts_with("columns a_cx a_cy a_cz: differ"),
        "{message}"
    );
}

/// Tests that an angular velocity gives 3.25 turns between two poses that alone give 0.25 turns. The velocity in the
/// last row has no effect.
#[test]
fn angular_velocities_give_whole_turns_to_the_next_row() {
    let spin = 3.25 * std::f64::consts::TAU / 2.0;
    let half = std::f64::consts::FRAC_PI_4;
    let [w, z] = [half.cos(), half.sin()];
    let table = |spin: f64| {
        format!("t,a_qw,a_qx,a_qy,a_qz,a_wz,b_px\n0,1,0,0,0,{spin},5\n2,{w},0,0,{z},9,5\n")
    };
    let x_axis = |path: &PathPair, time: f64| path.poses_at(time).unwrap()[0].rotation() * DVec3::X;
    for (spin, turns) in [
        (spin, 3.25),
        (spin + 0.2, 3.25),
        (spin - 0.2, 3.25),
        (0.0, 0.25),
    ] {
        let read = paths(&table(spin));
        for time in [0.0, 0.31, 1.7, 2.0] {
            let angle = 0.5 * time * turns * std::f64::consts::TAU;
            let expected = DVec3::new(angle.cos(), angle.sin(), 0.0);
            let off = x_axis(&read[0], time).distance(expected);
            assert!(off < 1e-12, "{spin} {time}: {off:e}");
        }
    }
    let (row, message) = only_problem(&table(spin + 0.8));
    assert_eq!(row, 1);
    let expected =
        "columns a_wx a_wy a_wz: the angular velocity of the row before leads 1.600 radians away";
    assert!(message.starts_with(expected), "{message}");
}

#[test]
fn columns_of_motions_are_no_columns_of_paths() {
    let message = |header: &str| {
        let rows = MovementRows::new(header.as_bytes(), Grouping::ById);
        rows.map(|_| ()).unwrap_err().to_string()
    };
    let refused = message("id,t,a_vx\n");
    let expected = "unknown column `a_vx`; a table with a column t";
    assert!(refused.contains(expected), "{refused}");
    assert!(message("id,t,a_pX\n").ends_with("did you mean `a_px`?"));
}

/// Tests that rows with the same characters in different cells have different checksums.
#[test]
fn checksums_tell_cells_apart() {
    let sum = |row: &str| {
        let table = format!("id,t,a_px,a_py\n{row}\n");
        let mut rows = MovementRows::new(table.as_bytes(), Grouping::ById).unwrap();
        rows.skip_rows(1).unwrap();
        rows.checksum()
    };
    let sums = ["p,0,4,", "p,0,,4", "p,04,,", "p0,4,,"].map(sum);
    for (k, one) in sums.iter().enumerate() {
        assert!(!sums[..k].contains(one), "{k}");
    }
}

#[test]
fn checksums_are_of_the_paths_that_are_read() {
    let text = "id,t\na,0\na,1\nb,0\nb,1\n";
    let other = "id,t\na,0\na,1\nb,0\nb,2\n";
    let open = |text: &'static str| MovementRows::new(text.as_bytes(), Grouping::ById).unwrap();
    let sum = |text, skipped: usize| {
        let mut rows = open(text);
        assert_eq!(rows.skip_rows(skipped).unwrap(), skipped);
        rows.checksum()
    };
    for skipped in [0, 1] {
        assert_eq!(sum(text, skipped), sum(other, skipped));
    }
    assert_ne!(sum(text, 2), sum(other, 2));
    let mut rows = open(text);
    rows.next().unwrap().unwrap().unwrap();
    assert_eq!(rows.checksum(), sum(text, 1));
    assert_eq!(rows.skip_rows(5).unwrap(), 1);
}

/// Tests that the byte count ends with the last path returned, although the first row of the next path has been read.
#[test]
fn bytes_are_those_up_to_the_last_path() {
    let text = "id,t\nx,0\nx,1\ny,0\ny,1\n";
    let mut rows = MovementRows::new(text.as_bytes(), Grouping::ById).unwrap();
    for expected in ["id,t\n", "id,t\nx,0\nx,1\n", text] {
        assert_eq!(rows.consumed_bytes(), expected.len() as u64);
        let _ = rows.next();
    }
}
