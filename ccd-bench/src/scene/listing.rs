//! The list of scenes: their models, and their rows in tables of motions.

use super::{Models, Scene, SceneError};
use crate::scene::model::Model;
use rigid_ccd::table::motions::{MotionTable, Motions};
use serde::Deserialize;

/// The description of a scene.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Listing {
    /// The name in the tables.
    pub name: String,
    /// The figure of the paper that shows it.
    pub figure: Option<u8>,
    a: String,
    b: String,
    motions: String,
    rows: Option<Rows>,
}

/// A range of rows of a table, counted from 0.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Rows {
    from: usize,
    to: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    scene: Vec<Listing>,
}

const SCENES: &str = include_str!("../../scenes/scenes.toml");
const MOTIONS: [(&str, &str); 6] = [
    ("santa.csv", include_str!("../../scenes/santa.csv")),
    ("bunnies.csv", include_str!("../../scenes/bunnies.csv")),
    ("knots.csv", include_str!("../../scenes/knots.csv")),
    (
        "falling-bunnies.csv",
        include_str!("../../scenes/falling-bunnies.csv"),
    ),
    (
        "falling-rings.csv",
        include_str!("../../scenes/falling-rings.csv"),
    ),
    (
        "small-knots.csv",
        include_str!("../../scenes/small-knots.csv"),
    ),
];

/// Returns all scenes, in the order of the report.
///
/// # Errors
/// [`SceneError::Data`] if the data file is invalid.
pub fn listings() -> Result<Vec<Listing>, SceneError> {
    let file: File = toml::from_str(SCENES).map_err(|error| SceneError::Data {
        what: "scenes.toml".to_owned(),
        problem: error.to_string(),
    })?;
    Ok(file.scene)
}

impl Listing {
    /// Makes the scene.
    ///
    /// # Errors
    /// If the data names something unknown, or a model's file is no mesh that a body can be made of.
    pub fn make(&self, models: &mut Models) -> Result<Scene, SceneError> {
        Ok(Scene {
            name: self.name.clone(),
            figure: self.figure,
            a: models.body(self.model(&self.a)?)?,
            b: models.body(self.model(&self.b)?)?,
            queries: self.queries()?,
        })
    }

    fn model(&self, name: &str) -> Result<Model, SceneError> {
        let found = Model::ALL.into_iter().find(|model| model.name() == name);
        found.ok_or_else(|| self.unfit(format!("there is no model {name}")))
    }

    fn queries(&self) -> Result<Vec<Motions>, SceneError> {
        let unfit = |problem: String| self.unfit(format!("{}: {problem}", self.motions));
        let text = MOTIONS
            .iter()
            .find_map(|(name, text)| (*name == self.motions).then_some(*text))
            .ok_or_else(|| unfit("there is no such file".to_owned()))?;
        let table = MotionTable::read(text.as_bytes()).map_err(|error| unfit(error.to_string()))?;
        if let Some(error) = table.errors.first() {
            return Err(unfit(error.to_string()));
        }
        let rows = self.rows.unwrap_or(Rows {
            from: 0,
            to: table.rows.len(),
        });
        let rows = table
            .rows
            .get(rows.from..rows.to)
            .ok_or_else(|| unfit(format!("rows {} to {}", rows.from, rows.to)))?;
        Ok(rows.iter().map(|(_, query)| query.clone()).collect())
    }

    fn unfit(&self, problem: String) -> SceneError {
        SceneError::Data {
            what: format!("scene {}", self.name),
            problem,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_scene_refers_to_existing_data_and_has_distinct_rows() {
        let listings = listings().unwrap();
        let names: HashSet<&str> = listings.iter().map(|l| l.name.as_str()).collect();
        assert_eq!(names.len(), listings.len());
        for listing in &listings {
            assert!(listing.model(&listing.a).is_ok() && listing.model(&listing.b).is_ok());
            let queries = listing.queries().unwrap();
            let ids: HashSet<&str> = queries.iter().map(|q| q.id.as_str()).collect();
            assert_eq!(ids.len(), queries.len(), "{}", listing.name);
            let turns = queries
                .iter()
                .filter(|q| q.a.spin().length() > 1e-3)
                .count();
            let share = if listing.name.ends_with("translating") {
                0..=0
            } else {
                queries.len() / 3..=queries.len()
            };
            assert!(share.contains(&turns), "{}: {turns} turn", listing.name);
        }
        let figures: HashSet<u8> = listings.iter().filter_map(|l| l.figure).collect();
        assert_eq!(figures, HashSet::from([4, 5, 7, 8]));
    }

    #[test]
    fn missing_data_is_named_in_the_error() {
        let mut listing = listings().unwrap().remove(0);
        listing.rows = Some(Rows {
            from: 0,
            to: 10_000,
        });
        let error = listing.queries().unwrap_err().to_string();
        assert!(error.contains("santa.csv: rows 0 to 10000"), "{error}");
        listing.motions = "nowhere.csv".to_owned();
        let error = listing.queries().unwrap_err().to_string();
        assert!(error.contains("nowhere.csv"), "{error}");
        let error = listing.model("unicorn").unwrap_err().to_string();
        assert!(error.contains("unicorn"), "{error}");
    }
}
