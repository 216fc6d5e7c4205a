use super::*;

fn throw(place: [f64; 3], velocity: [f64; 3]) -> Throw {
    Throw {
        place,
        velocity,
        spin: [0.0; 3],
    }
}

#[test]
fn a_contact_is_found_that_steps_miss_or_see_late() {
    let (bullet, sheet) = (
        Part::from_name("bullet").unwrap(),
        Part::from_name("sheet").unwrap(),
    );
    let fast = throw([-1.0, 0.0, 0.0], [9.7, 0.0, 0.0]);
    let found = fast.first_contact(&bullet, &sheet).unwrap();
    let exact = (1.0 - 0.025 - 0.001) / 9.7;
    assert_eq!(found.verdict, "contact");
    assert!(
        found.time <= exact && found.time > exact - 1e-6,
        "{} {exact}",
        found.time
    );
    assert!(!fast.steps(&bullet, &sheet, 60).unwrap().contains(&1));
    let seen = fast.steps(&bullet, &sheet, 1000).unwrap();
    let first = seen.iter().position(|touches| *touches == 1).unwrap();
    assert!(first as f64 / 1000.0 >= found.time);
}

#[test]
fn the_verdicts_are_those_of_the_engine() {
    let (bullet, sheet) = (
        Part::from_name("bullet").unwrap(),
        Part::from_name("sheet").unwrap(),
    );
    let verdict = |throw: Throw| throw.first_contact(&bullet, &sheet).unwrap().verdict;
    assert_eq!(verdict(throw([-1.0, 0.0, 0.0], [0.5, 0.0, 0.0])), "free");
    assert_eq!(
        verdict(throw([-0.026, 0.0, 0.0], [1.0, 0.0, 0.0])),
        "touching"
    );
    assert_eq!(verdict(throw([0.0; 3], [1.0, 0.0, 0.0])), "overlapping");
    let nowhere = throw([f64::NAN, 0.0, 0.0], [1.0, 0.0, 0.0]);
    assert!(matches!(
        nowhere.first_contact(&bullet, &sheet),
        Err(WebError::RefusedQuery(_) | WebError::BadInput(_))
    ));
}
