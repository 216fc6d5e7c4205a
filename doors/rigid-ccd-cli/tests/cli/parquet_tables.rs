//! Tests that tables in Parquet are answered as the same tables in CSV.

use crate::command::{CommandCall, Scene, assert_contains, stderr};
use crate::{CUBE_AND_SLAB_OPTIONS, FALLING_CUBE_MOTION};
use parquet::column::writer::ColumnWriter;
use parquet::file::metadata::{ParquetMetaData, ParquetMetaDataReader};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;
use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

/// Writes a table in CSV as Parquet, with at most `group_row_count` rows in a row group. Columns of numbers become
/// floats, others text; empty cells become absent values.
fn write_parquet(path: &Path, csv: &str, group_row_count: usize) {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let header = reader.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let is_number = |cell: &str| cell.is_empty() || cell.parse::<f64>().is_ok();
    let fields = header.iter().enumerate().map(|(column, name)| {
        let numbers = name != "id" && rows.iter().all(|row| is_number(&row[column]));
        let (kind, mark) = if numbers {
            ("double", "")
        } else {
            ("binary", " (UTF8)")
        };
        format!("optional {kind} {name}{mark};")
    });
    let schema = format!("message table {{ {} }}", fields.collect::<String>());
    let schema = Arc::new(parse_message_type(&schema).unwrap());
    let file = File::create(path).unwrap();
    let mut writer = SerializedFileWriter::new(file, schema, Arc::default()).unwrap();
    for group in rows.chunks(group_row_count) {
        let mut columns = writer.next_row_group().unwrap();
        for column in 0..header.len() {
            let mut out = columns.next_column().unwrap().unwrap();
            let cells = group.iter().map(|row| &row[column]);
            let levels: Vec<i16> = cells
                .clone()
                .map(|cell| i16::from(!cell.is_empty()))
                .collect();
            let cells = cells.filter(|cell| !cell.is_empty());
            match out.untyped() {
                ColumnWriter::DoubleColumnWriter(out) => {
                    let numbers: Vec<f64> = cells.map(|cell| cell.parse().unwrap()).collect();
                    out.write_batch(&numbers, Some(&levels), None).unwrap();
                }
                ColumnWriter::ByteArrayColumnWriter(out) => {
                    let texts: Vec<_> = cells.map(Into::into).collect();
                    out.write_batch(&texts, Some(&levels), None).unwrap();
                }
                _ => panic!("columns are numbers or text"),
            }
            out.close().unwrap();
        }
        columns.close().unwrap();
    }
    writer.close().unwrap();
}

/// Runs a command on a table as CSV and as Parquet, checks that the results are the same bytes, and returns the messages of
/// both.
#[track_caller]
fn messages_of_both(scene: &Scene, args: &[&str], csv: &str, code: i32) -> [String; 2] {
    fs::write(scene.directory.join("table.csv"), csv).unwrap();
    write_parquet(&scene.directory.join("table.parquet"), csv, 7);
    let [text, binary] = ["table.csv", "table.parquet"].map(|table| {
        let call = CommandCall::with_args(args).args(&[table, "--no-micros"]);
        call.folder(&scene.directory).run_expecting_code(code)
    });
    assert!(!text.stdout.is_empty());
    assert_eq!(
        String::from_utf8(text.stdout.clone()).unwrap(),
        String::from_utf8(binary.stdout.clone()).unwrap()
    );
    [stderr(&text), stderr(&binary)]
}

fn query<'a>(more: &[&'a str]) -> Vec<&'a str> {
    let mut args = vec!["query", "--a", "box:.5,.5,.5", "--b", "box:9,9,1"];
    args.extend(more);
    args.push("--motions");
    args
}

fn motions(row_count: usize) -> String {
    let mut table = "id,a_px,a_pz,a_vz,a_wx\n".to_owned();
    for k in 0..row_count {
        let (x, spin) = (0.1 * (k % 17) as f64, k % 5);
        let id = if k % 4 == 0 {
            String::new()
        } else {
            format!("\"r{k}, é\"")
        };
        let velocity = if k % 11 == 3 {
            String::new()
        } else {
            format!("-{}", k % 7)
        };
        table += &format!("{id},{x},4,{velocity},{spin}\n");
    }
    table
}

#[test]
fn query_gives_the_results_of_the_same_csv() {
    let scene = Scene::new("parquet-query");
    let table = motions(40);
    for more in [
        &[][..],
        &["--rows", "5..23"],
        &["--question", "closest-approach"],
    ] {
        let [text, binary] = messages_of_both(&scene, &query(more), &table, 2);
        assert_contains(&text, "row 14 (line 16): column a_vz: no value");
        assert_contains(&binary, "table.parquet, row 14: column a_vz: no value");
        assert!(!binary.contains("line"), "{binary}");
    }
    let paths = "id,t,a_pz,a_qw,a_qx,a_qy,a_qz\nx,0.5,4,1,0,0,0\nx,1,3,1,1,0,0\ny,0,4,1,0,0,0\ny,2,0,1,0,1,0\n\
                 x,3,0,1,0,0,0\n,0,3,1,0,0,0\n,1,4,1,0,0,0\n";
    messages_of_both(&scene, &query(&[]), paths, 2);
    messages_of_both(&scene, &query(&["--rows", "1..2"]), paths, 0);
}

#[test]
fn edges_gives_the_results_of_the_same_csv() {
    let scene = Scene::new("parquet-edges");
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for name in ["arm.urdf", "cell.toml"] {
        fs::copy(examples.join(name), scene.directory.join(name)).unwrap();
    }
    let command = ["edges", "arm.urdf", "--cell", "cell.toml"];
    let call = |more: &[&'static str]| [&command[..], more, &["--edges"]].concat();
    let edges = fs::read_to_string(examples.join("moves.csv")).unwrap();
    messages_of_both(&scene, &call(&["--question", "first-contact"]), &edges, 0);
    messages_of_both(&scene, &call(&["--rows", "1..3"]), &edges, 0);
    let with_bad = edges + "bad,0,,0,2.8\n";
    let [text, binary] = messages_of_both(&scene, &call(&[]), &with_bad, 2);
    assert_contains(&text, "row 4 (line 6): column from_elbow: no value");
    assert_contains(&binary, "table.parquet, row 4: column from_elbow: no value");
    let path = fs::read_to_string(examples.join("path.csv")).unwrap();
    messages_of_both(&scene, &call(&["--question", "closest-approach"]), &path, 0);
}

#[test]
fn scene_gives_the_results_of_the_same_csv() {
    let scene = Scene::new("parquet-scene");
    let bodies =
        "id,body,px,pz,vz\nfloor,\"box:2,2,0.1\",0,0,0\na,sphere:0.3,0,3,-4\nb,sphere:0.2,1,2,-3\n";
    let [csv, parquet] = ["table.csv", "table.parquet"].map(|name| scene.directory.join(name));
    fs::write(&csv, bodies).unwrap();
    write_parquet(&parquet, bodies, 2);
    let [text, binary] = [csv, parquet].map(|table| {
        let call = CommandCall::with_args(&["scene", table.to_str().unwrap()]);
        call.run_expecting_code(0).stdout
    });
    assert_eq!(text, binary);
}

/// Tests that the first bytes of a file decide, not its name.
#[test]
fn names_of_files_do_not_matter() {
    let scene = Scene::new("parquet-names");
    let (binary, text) = (
        scene.directory.join("a.csv"),
        scene.directory.join("b.parquet"),
    );
    write_parquet(&binary, FALLING_CUBE_MOTION, 7);
    fs::write(&text, FALLING_CUBE_MOTION).unwrap();
    for table in [binary, text] {
        let call = CommandCall::with_args(&query(&[])).args(&[table.to_str().unwrap()]);
        assert_eq!(call.run_for_rows()[0].text("id"), "drop");
    }
}

#[test]
fn streams_and_files_that_cannot_be_read_are_refused() {
    let call = CommandCall::query(&CUBE_AND_SLAB_OPTIONS).stdin("PAR1 and more");
    let message = call.run_for_messages(2);
    assert_contains(
        &message,
        "standard input: is Parquet, which is read from a file",
    );
    let scene = Scene::new("parquet-refused");
    let table = scene.directory.join("table.parquet");
    write_parquet(&table, &motions(40), 7);
    let bytes = fs::read(&table).unwrap();
    fs::write(&table, &bytes[..bytes.len() / 2]).unwrap();
    let call = CommandCall::with_args(&query(&[])).args(&[table.to_str().unwrap()]);
    let message = call.run_for_messages(2);
    assert_contains(&message, "table.parquet: cannot be read as Parquet: ");
}

/// Tests that a run which a damaged row group ends goes on when the file is whole again.
#[test]
fn an_interrupted_run_is_resumed() {
    let scene = Scene::new("parquet-resume");
    let table = scene.directory.join("table.parquet");
    write_parquet(&table, &motions(3000), 1100);
    let run = |out: &str, more: &[&str], code: i32| {
        let args = query(&["--no-micros", "--out", out]);
        let call = CommandCall::with_args(&args)
            .args(&["table.parquet"])
            .args(more);
        call.folder(&scene.directory).run_for_messages(code)
    };
    run("whole.csv", &[], 2);
    let whole = fs::read(&table).unwrap();
    let mut damaged = whole.clone();
    let metadata: ParquetMetaData = ParquetMetaDataReader::new()
        .parse_and_finish(&File::open(&table).unwrap())
        .unwrap();
    let (start, length) = metadata.row_group(2).column(0).byte_range();
    damaged[start as usize..(start + length) as usize].fill(0xff);
    fs::write(&table, damaged).unwrap();
    let message = run("out.csv", &[], 2);
    assert_contains(&message, "row group 2: column `id`: ");
    fs::write(&table, whole).unwrap();
    let message = run("out.csv", &["--resume"], 2);
    assert_contains(&message, "--resume: continues at row 2200 of table.parquet");
    let [resumed, undisturbed] = ["out.csv", "whole.csv"]
        .map(|name| fs::read_to_string(scene.directory.join(name)).unwrap());
    assert!(resumed == undisturbed && resumed.lines().count() == 3001);
    // A finished run finds nothing left to do, and refuses another table.
    let message = run("out.csv", &["--resume"], 2);
    assert_contains(&message, "already has all rows");
    write_parquet(&table, &motions(3000).replacen(",4,", ",5,", 1), 1100);
    let message = run("out.csv", &["--resume"], 2);
    assert_contains(&message, "not the rows of the finished run");
}
