use super::*;
use crate::console::causes::message_with_causes;
use ccd_tables::joint_columns::AngleUnit;
use rigid_ccd::{Body, Pose, trajectory};
use rigid_ccd_robot::{Joint, Link, PositionRule};
use std::fs;

/// Returns a robot with a joint that turns and one that slides.
fn robot() -> Robot {
    let joint = |name: &str, parent: &str, child: &str, moves| Joint {
        name: name.into(),
        parent: parent.into(),
        child: child.into(),
        geometry: moves,
        position_rule: PositionRule::Independent,
    };
    let turns = trajectory::Joint::revolute(Pose::IDENTITY, [0.0, 0.0, 1.0]).unwrap();
    let slides = trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap();
    let joints = vec![
        joint("hip", "base", "arm", turns),
        joint("rail", "arm", "hand", slides),
    ];
    let ball = Link::named("hand").with_body(Body::sphere(0.1).unwrap(), Pose::IDENTITY);
    Robot::new(vec![Link::named("base"), Link::named("arm"), ball], joints).unwrap()
}

fn open(text: &str, at_rest: &[&str]) -> Result<PathTable> {
    open_for(&robot(), text, (at_rest, AngleUnit::Radian))
}

fn open_for(robot: &Robot, text: &str, (at_rest, unit): (&[&str], AngleUnit)) -> Result<PathTable> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("edges.csv");
    fs::write(&path, text)?;
    let joints = JointsArgs {
        joint: at_rest.iter().map(|text| text.parse().unwrap()).collect(),
        rest: false,
        degrees: unit == AngleUnit::Degree,
    };
    Ok(PathTable::open("--edges", &path, robot, &joints)?.0)
}

fn read(text: &str, at_rest: &[&str]) -> Vec<Result<TablePath, RowError>> {
    let table = open(text, at_rest).unwrap();
    table.collect::<Result<_, _>>().unwrap()
}

#[test]
fn edges_are_rows() {
    let text = "to_hip,id,from_hip,from_rail,to_rail\n1,first,0,2,3\n0.5,first,0,0,0\n";
    let paths = read(text, &[]);
    let [one, two] = &paths[..] else {
        panic!("{paths:?}");
    };
    let one = one.as_ref().unwrap();
    assert_eq!((one.id.as_str(), one.position.line), ("first", Some(2)));
    assert_eq!(one.configurations, [[0.0, 2.0], [1.0, 3.0]]);
    // Edges may share an id.
    assert_eq!(
        two.as_ref().unwrap().configurations,
        [[0.0, 0.0], [0.5, 0.0]]
    );
}

#[test]
fn paths_are_rows_of_one_id() {
    let text = "id,t,hip\na,2,0\na,4,1\nb,0,5\n";
    let paths = read(text, &["rail=0.5"]);
    let paths: Vec<TablePath> = paths.into_iter().map(Result::unwrap).collect();
    assert_eq!(paths.len(), 2);
    assert_eq!(paths[0].configurations, [[0.0, 0.5], [1.0, 0.5]]);
    assert_eq!(paths[1].configurations, [[5.0, 0.5]]);
    let times = [0.0, 0.5, 1.0].map(|time| paths[0].table_time_rounded_down(time));
    assert_eq!((times[0], times[2]), (2.0, 4.0));
    assert!(times[1] <= 3.0 && times[1] > 3.0 - 1e-13, "{}", times[1]);
    // Without ids, all rows are one path.
    assert_eq!(read("hip,rail\n0,1\n2,3\n", &[]).len(), 1);
}

#[test]
fn bad_rows_are_errors_of_their_paths() {
    let text =
        "id,t,hip,rail\na,0,0,0\na,0,1,1\nb,0,x,0\nc,0,,0\nd,0,0\na,5,0,0\n,6,1,2\ne,0,1,2\n";
    let paths = read(text, &[]);
    let words = [
        "not later",
        "`x` is not a finite number",
        "no value",
        "3 cells",
        "a",
        "each row of a path needs its name",
    ];
    for (path, expected) in paths.iter().zip(words) {
        let error = path.as_ref().unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
    assert!(paths[6].is_ok() && paths.len() == 7);
}

#[test]
fn tables_that_do_not_fit_the_robot_are_refused() {
    for (text, at_rest, expected) in [
        ("hip\n0\n", vec![], "no column rail"),
        ("", vec![], "is empty"),
        (
            "hip,rail,rail_mm\n0,0,0\n",
            vec![],
            "unknown column `rail_mm`; known are id, t and the joints: of edges from_JOINT and to_JOINT; angles are in \
             radians, with the end _deg in degrees, and lengths in metres",
        ),
        ("hip,rail,knee\n0,0,0\n", vec![], "unknown column `knee`"),
        ("hip,hip,rail\n0,0,0\n", vec![], "appears twice"),
        (
            "hip,rail\n0,0\n",
            vec!["rail=1"],
            "--joint rail: the table has columns",
        ),
        (
            "hip\n0\n",
            vec!["rail=1:2"],
            "--joint rail: give one position",
        ),
        (
            "hip,rail\n0,0\n",
            vec!["leg=1"],
            "--joint leg: no independent joint has this name",
        ),
        (
            "from_hip,rail\n0,0\n",
            vec![],
            "no column from_rail, to_hip, to_rail",
        ),
    ] {
        let error = open(text, &at_rest).map(|_| ()).unwrap_err();
        let message = message_with_causes(&error);
        assert!(message.contains(expected), "{text}: {message}");
    }
}

#[test]
fn skipped_paths_count_in_the_checksum() {
    let text = "id,hip,rail\na,0,0\na,1,1\nb,2,2\n";
    let mut all = open(text, &[]).unwrap();
    all.by_ref().for_each(drop);
    let mut skipping = open(text, &[]).unwrap();
    assert_eq!(skipping.skip_rows(1).unwrap(), 1);
    assert_ne!(skipping.checksum(), all.checksum());
    assert_eq!(skipping.skip_rows(9).unwrap(), 1);
    assert_eq!(skipping.checksum(), all.checksum());
    assert_eq!(all.consumed_bytes(), text.len() as u64);
}

/// Tests that columns of angles may be in degrees, by their names or by the option, and that no column has two meanings.
#[test]
fn angles_are_in_degrees_where_the_table_or_the_option_says_so() {
    let open_for = |robot: &Robot, text: &str, unit: AngleUnit| {
        let table = open_for(robot, text, (&[], unit))?;
        let path = table.map(|path| path.unwrap().unwrap()).next().unwrap();
        Ok::<_, anyhow::Error>(path.configurations)
    };
    let read = |text: &str, unit: AngleUnit| open_for(&robot(), text, unit);
    let quarter = std::f64::consts::FRAC_PI_2;
    let path = "hip_deg,rail\n90,90\n";
    for unit in [AngleUnit::Radian, AngleUnit::Degree] {
        assert_eq!(read(path, unit).unwrap(), [[quarter, 90.0]]);
    }
    let edges = "from_hip_deg,to_hip_deg,from_rail,to_rail\n0,-180,1,2\n";
    let ends = read(edges, AngleUnit::Radian).unwrap();
    assert_eq!(ends, [[0.0, 1.0], [-2.0 * quarter, 2.0]]);
    let plain = "hip,rail\n90,90\n";
    assert_eq!(read(plain, AngleUnit::Degree).unwrap(), [[quarter, 90.0]]);
    assert_eq!(read(plain, AngleUnit::Radian).unwrap(), [[90.0, 90.0]]);
    for (text, expected) in [
        ("hip,hip_deg,rail\n0,0,0\n", "two columns for the joint hip"),
        ("hip,rail_deg\n0,0\n", "the joint rail slides"),
        ("hip_degree,rail\n0,0\n", "no column hip"),
        (
            "from_hip_deg,to_hip,to_rail,from_rail,hip\n0,0,0,0,0\n",
            "unknown column `hip`",
        ),
    ] {
        let error = read(text, AngleUnit::Radian).unwrap_err().to_string();
        assert!(error.contains(expected), "{text}: {error}");
    }
    let mut joints = robot().joints().to_vec();
    joints[1].name = "hip_deg".into();
    let twin = Robot::new(robot().links().to_vec(), joints).unwrap();
    assert_eq!(
        open_for(&twin, "hip,hip_deg\n1,2\n", AngleUnit::Radian).unwrap(),
        [[1.0, 2.0]]
    );
    let error = open_for(&twin, "hip_deg\n1\n", AngleUnit::Radian).unwrap_err();
    assert!(
        error.to_string().contains("may be the joint hip_deg"),
        "{error}"
    );
}

/// Tests that angles as small as radians are remarked upon where they are read as degrees.
#[test]
fn radians_read_as_degrees_are_remarked_upon() {
    let remark = |text: &str, unit: AngleUnit| {
        let mut table = open_for(&robot(), text, (&[], unit)).unwrap();
        table.by_ref().for_each(drop);
        table.remark_on_degrees()
    };
    let radians = "hip,rail\n-1.5,90\n2.7,90\n";
    let found = remark(radians, AngleUnit::Degree).unwrap();
    assert!(
        found.starts_with("no angle in degrees is beyond 2.7"),
        "{found}"
    );
    assert!(remark("hip_deg,rail\n1,0\n", AngleUnit::Radian).is_some());
    for (text, unit) in [
        (radians, AngleUnit::Radian),
        ("hip,rail\n-1.5,0\n90,0\n", AngleUnit::Degree),
        ("hip_deg,rail\n0,0\n", AngleUnit::Radian),
    ] {
        assert_eq!(remark(text, unit), None);
    }
}

/// Tests that a column of a path is not also that of a joint.
#[test]
fn a_joint_named_as_a_column_of_paths_is_refused_there() {
    let mut joints = robot().joints().to_vec();
    for name in ["t", "id"] {
        joints[1].name = name.into();
        let robot = Robot::new(robot().links().to_vec(), joints.clone()).unwrap();
        let read = |text: &str| open_for(&robot, text, (&[], AngleUnit::Radian));
        let error = read(&format!("hip,{name}\n1,2\n")).map(|_| ());
        let message = error.unwrap_err().to_string();
        let expected = format!("`{name}` may be the column {name} of a path, or the joint");
        assert!(message.contains(&expected), "{message}");
        let edges = format!("from_hip,to_hip,from_{name},to_{name}\n1,2,3,4\n");
        let path = read(&edges).unwrap().next().unwrap().unwrap().unwrap();
        assert_eq!(path.configurations, [[1.0, 3.0], [2.0, 4.0]]);
    }
}
