use super::proof_file_name;
use std::collections::BTreeSet;

/// Ids that are alike once they are cleaned or cut, equal ids, and those of segments of another row.
#[test]
fn no_two_proofs_have_one_name() {
    let long = "é".repeat(400);
    let ids = [
        "a/b", "a_b", "a_b", "", "p", "p-1", "1", "0-p", ".", "..", "a\nb", &long,
    ];
    let mut names = BTreeSet::new();
    for row in 0..30 {
        for id in ids {
            for segment in [None, Some(0), Some(1), Some(11)] {
                let name = proof_file_name((row, segment), id);
                assert!(name.len() < 200 && !name.contains(['/', '\n']), "{name}");
                let row_and_segment = (row, segment);
                let other = names
                    .iter()
                    .find(|(of, known)| *known == name && *of != row_and_segment);
                assert_eq!(other, None);
                names.insert((row_and_segment, name));
            }
        }
    }
    assert_eq!(proof_file_name((3, None), "a/b"), "3-a_b.proof");
    assert_eq!(proof_file_name((3, Some(2)), "p"), "3.2-p.proof");
    assert_eq!(proof_file_name((3, None), "3"), "3.proof");
}
