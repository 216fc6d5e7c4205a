//! Tests that tables of exact answers are read back as they were written.

use super::super::{Truth, TruthRow};

const TABLE: &str = "id,status,lo,hi\n\
                     a,hit,0.1,0.30000000000000004\n\
                     b,free,2.0,2.0\n\
                     c,initial,0.0,0.0\n\
                     d,graze,0.5,2.0\n\
                     e,undecided,0.25,2.0\n";

const TRUTHS: [(&str, Truth); 5] = [
    (
        "a",
        Truth::Hit {
            lo: 0.1,
            hi: 0.1 + 0.2,
        },
    ),
    ("b", Truth::Free),
    ("c", Truth::Start),
    ("d", Truth::Graze { lo: 0.5 }),
    ("e", Truth::Undecided { lo: 0.25 }),
];

fn read(table: &str) -> Result<Vec<TruthRow>, csv::Error> {
    csv::Reader::from_reader(table.as_bytes())
        .deserialize()
        .collect()
}

#[test]
fn a_written_table_is_read_back() {
    let row = |&(id, truth): &(&str, Truth)| TruthRow::new(id.to_owned(), 2.0, truth);
    let mut table = csv::Writer::from_writer(Vec::new());
    TRUTHS
        .iter()
        .for_each(|truth| table.serialize(row(truth)).unwrap());
    assert_eq!(
        String::from_utf8(table.into_inner().unwrap()).unwrap(),
        TABLE
    );
    let read = read(TABLE).unwrap();
    let read: Vec<_> = read
        .iter()
        .map(|row| (row.id.as_str(), row.truth()))
        .collect();
    assert_eq!(read, TRUTHS);
}

#[test]
fn invalid_rows_are_refused() {
    for row in ["a,sure,0,1", "a,hit,x,1", "a,hit,0"] {
        let table = format!("id,status,lo,hi\n{row}\n");
        assert!(read(&table).is_err(), "{row}");
    }
}
