//! Tests that each kind of exact answer becomes the expected row of the table.

use super::super::{Truth, TruthRow};

const EXPECTED_TABLE: &str = "id,status,lo,hi\n\
                     a,hit,0.1,0.30000000000000004\n\
                     b,free,2.0,2.0\n\
                     c,initial,0.0,0.0\n\
                     d,graze,0.5,2.0\n\
                     e,undecided,0.25,2.0\n";

const IDS_AND_TRUTHS: [(&str, Truth); 5] = [
    (
        "a",
        Truth::Hit {
            lo: 0.1,
            hi: 0.1 + 0.2,
        },
    ),
    ("b", Truth::Free),
    ("c", Truth::ContactAtStart),
    ("d", Truth::Graze { lo: 0.5 }),
    ("e", Truth::Undecided { lo: 0.25 }),
];

#[test]
fn rows_are_written_by_status() {
    let mut table = csv::Writer::from_writer(Vec::new());
    for (id, truth) in IDS_AND_TRUTHS {
        table
            .serialize(TruthRow::new(id.to_owned(), 2.0, truth))
            .unwrap();
    }
    let written = table.into_inner().unwrap();
    assert_eq!(String::from_utf8(written).unwrap(), EXPECTED_TABLE);
}
