use super::*;
use std::collections::HashSet;

#[test]
fn every_scene_refers_to_existing_data_and_has_distinct_rows() {
    let scene_descriptions = scene_descriptions().unwrap();
    let names: HashSet<&str> = scene_descriptions.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names.len(), scene_descriptions.len());
    for listing in &scene_descriptions {
        assert!(
            listing.model_from_name(&listing.a).is_ok()
                && listing.model_from_name(&listing.b).is_ok()
        );
        let queries = listing.queries().unwrap();
        let ids: HashSet<&str> = queries.iter().map(|q| q.id.as_str()).collect();
        assert_eq!(ids.len(), queries.len(), "{}", listing.name);
        let turns = queries
            .iter()
            .filter(|q| q.a.angular_velocity().length() > 1e-3)
            .count();
        let fraction = if listing.name.ends_with("translating") {
            0..=0
        } else {
            queries.len() / 3..=queries.len()
        };
        assert!(fraction.contains(&turns), "{}: {turns} turn", listing.name);
    }
}

#[test]
fn missing_data_is_named_in_the_error() {
    let mut listing = scene_descriptions().unwrap().remove(0);
    listing.rows = Some(0..10_000);
    let make = |listing: &SceneDescription| {
        format!(
            "{:#}",
            listing
                .make_scene(&mut ModelBodyCache::default())
                .unwrap_err()
        )
    };
    listing.a = "knot216".to_owned();
    let error = make(&listing);
    assert!(error.contains("santa.csv: rows 0 to 10000"), "{error}");
    listing.motions = "nowhere.csv".to_owned();
    let error = make(&listing);
    assert!(error.contains("nowhere.csv"), "{error}");
    let error = listing.model_from_name("unicorn").unwrap_err().to_string();
    assert!(error.contains("unicorn"), "{error}");
}
