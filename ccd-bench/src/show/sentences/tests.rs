use super::*;
use crate::run::contest::{Verdict, summarise};
use crate::show::tables::tests::trial;

const OURS: &str = "best-first direct";

#[test]
fn sentences_are_by_family_and_fit_a_screen() {
    let right = Verdict::Right;
    let trials = [
        trial("santa", OURS, "0", 10.0, right),
        trial("santa", OURS, "1", 20.0, right),
        trial("santa", "C2A", "0", 30.0, right),
        trial("santa", "C2A", "1", 50.0, Verdict::Late),
        trial("santa", "parry-f64", "0", 500.0, Verdict::CutOff),
    ];
    let cells = [&trials[..2], &trials[2..4], &trials[4..]].map(summarise);
    let methods = [OURS, "C2A", "parry-f64"].map(MethodFacts::named);
    let scenes = [("santa", 216), ("bunny", 70_000)];
    let scenes = scenes.map(|(name, triangles)| SceneFacts { name, triangles });
    let measurements = Measurements {
        scenes: &scenes,
        methods: &methods,
        cells: &cells,
        reference: &Reference::new(OURS, &trials),
        tolerance: 1e-3,
    };
    assert_eq!(
        measurements.sentences(),
        [
            "2 scenes, with moving bodies of 216 to 70000 triangles; 3 methods answered 5 queries, each compared with \
             a certified bracket of the exact first contact.",
            "This project (1 of the methods, 2 queries): no contact late, missed, false or early; 0 unresolved.",
            "Published rivals, built here (1 of the methods, 2 queries): C2A 1 late; 0 unresolved.",
            "Libraries (1 of the methods, 1 queries): no contact late, missed, false or early; 1 unresolved.",
            "A query of `best-first direct`, the default, takes 15 to 15 µs by scene: medians, at tolerance 1e-3.",
            "Times that, on the same queries: C2A 2.8 to 2.8; parry-f64 at least 50 to 50.",
        ]
    );
}
