//! Tests the corpus of cases that once failed, or are known to fail easily.

use ccd_tests::backends::for_each_setup;
use ccd_tests::checks::Judge;
use ccd_tests::corpus;

#[test]
fn every_case_of_the_corpus_keeps_every_law() {
    let cases = corpus::cases();
    assert!(cases.len() >= 5, "the corpus is missing");
    for case in cases {
        let query = case.query();
        let judge = Judge::new(&query, &case.config());
        for_each_setup(&query, &case.config(), |bodies, setup, answer| {
            if let Err(why) = judge.check(&answer, bodies) {
                panic!("{} ({}): {why}\n{setup:?}\n{answer:?}", case.name, case.why);
            }
        });
    }
}

#[test]
fn a_case_survives_being_written_and_read() {
    for case in corpus::cases() {
        let text = case.to_toml();
        let again: ccd_tests::case::Case = toml::from_str(&text).expect(&text);
        assert_eq!(format!("{case:?}"), format!("{again:?}"));
    }
}
