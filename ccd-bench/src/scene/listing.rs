//! Lists the scenes: their models, and their rows in tables of motions.

use super::{ModelBodyCache, Scene};
use crate::scene::model::Model;
use anyhow::{Context, Result, anyhow, bail};
use ccd_tables::motions::{MotionTable, Motions};
use clap::ValueEnum;
use serde::Deserialize;
use std::ops::Range;

/// The description of a scene, from which it can be made.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneDescription {
    /// The name of the scene in tables.
    pub name: String,
    a: String,
    b: String,
    motions: String,
    rows: Option<Range<usize>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScenesFile {
    scene: Vec<SceneDescription>,
}

const SCENES_TOML: &str = include_str!("../../scenes/scenes.toml");
pub(super) const EMBEDDED_MOTION_CSVS: [(&str, &str); 6] = [
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

/// Returns the descriptions of all scenes, in the order in which the report shows them.
///
/// # Errors
/// If the data file is invalid.
pub fn scene_descriptions() -> Result<Vec<SceneDescription>> {
    let file: ScenesFile = toml::from_str(SCENES_TOML).context("scenes.toml")?;
    Ok(file.scene)
}

impl SceneDescription {
    /// Makes the scene from its models and its table of motions.
    ///
    /// # Errors
    /// If the data names something unknown, or a model's file is no mesh that a body can be made of.
    pub fn make_scene(&self, models: &mut ModelBodyCache) -> Result<Scene> {
        let motions = || format!("scene {}: {}", self.name, self.motions);
        Ok(Scene {
            name: self.name.clone(),
            a: models.model_body(self.model_from_name(&self.a)?)?,
            b: models.model_body(self.model_from_name(&self.b)?)?,
            queries: self.queries().with_context(motions)?,
        })
    }

    fn model_from_name(&self, name: &str) -> Result<Model> {
        let found = Model::from_str(name, false);
        found.map_err(|_| anyhow!("scene {}: there is no model {name}", self.name))
    }

    fn queries(&self) -> Result<Vec<Motions>> {
        let text = EMBEDDED_MOTION_CSVS
            .iter()
            .find_map(|(name, text)| (*name == self.motions).then_some(*text))
            .context("there is no such file")?;
        let table = MotionTable::read(text.as_bytes())?;
        if let Some(error) = table.errors.first() {
            bail!("{error}");
        }
        let range = self.rows.clone().unwrap_or(0..table.rows.len());
        let rows = table.rows.get(range.clone());
        let rows = rows.with_context(|| format!("rows {} to {}", range.start, range.end))?;
        Ok(rows.iter().map(|(_, query)| query.clone()).collect())
    }
}

#[cfg(test)]
mod tests;
