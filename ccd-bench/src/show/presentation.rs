//! Turns measurements into tables, charts and a page.

use crate::method::Method;
use crate::run::evaluation::{Evaluated, USUAL_TOLERANCE};
use crate::run::measured::Cell;
use crate::scene::Scene;
use crate::show::chart::{Charts, Family, MethodFacts, SceneFacts};
use crate::show::comparable::Reference;
use crate::show::page;
use crate::show::sentences::Measurements;
use crate::show::tables::{self, TextTable};
use crate::show::views::Views;
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// Tables, charts and views of one evaluation.
pub struct Presentation<'e> {
    evaluated: &'e Evaluated,
    /// The findings.
    pub sentences: Vec<String>,
    /// The tables for the terminal.
    pub summary: Vec<TextTable>,
    /// The tables for a page or a README.
    pub comparisons: Vec<TextTable>,
    methods: Vec<(String, Family)>,
    /// The cells, with comparable medians.
    cells: Vec<Cell>,
}

/// The finer of the two tolerances of comparisons.
const FINE_TOLERANCE: f64 = 1e-6;
/// The reference method of comparisons.
const DEFAULT: &str = "best-first direct";
/// The paper's own method.
const AS_PUBLISHED: &str = "fast vmarch";
/// The methods that the paper compares its own with; the factors are in the table's title.
const PAPERS_RIVALS: [&str; 2] = ["CONTACT", "Dynamic Collision Checker"];

impl<'e> Presentation<'e> {
    /// Summarises the measurements.
    pub fn new(evaluated: &'e Evaluated) -> Self {
        let journal = &evaluated.journal;
        let methods = families(&tables::methods(journal.cells()));
        let others: Vec<&str> = methods
            .iter()
            .filter(|(name, family)| {
                matches!(family, Family::Rival | Family::Peer) || name == AS_PUBLISHED
            })
            .map(|(name, _)| name.as_str())
            .collect();
        let compared = |tolerance| tables::ratios(journal.trials(), DEFAULT, &others, tolerance);
        let mut published = tables::ratios(
            journal.trials(),
            AS_PUBLISHED,
            &PAPERS_RIVALS,
            USUAL_TOLERANCE,
        );
        published.title += "; the paper reports 1.4 to 45.5 over CONTACT";
        let safety = tables::safety(journal.cells(), journal.trials());
        let reference = Reference::new(DEFAULT, journal.trials());
        let sentences = sentences(evaluated, &answering(&methods, &safety), &reference);
        let usual = tables::at_tolerance(journal.cells(), USUAL_TOLERANCE, &reference);
        Presentation {
            evaluated,
            comparisons: vec![
                compared(USUAL_TOLERANCE).named("usual"),
                compared(FINE_TOLERANCE).named("fine"),
                published.named("published"),
                safety.clone().named("safety"),
                usual.clone().named("all"),
            ],
            sentences,
            summary: vec![usual, safety],
            methods,
            cells: reference.comparable(journal.cells()),
        }
    }

    /// Writes charts and the page into a folder. Returns the page's path.
    ///
    /// # Errors
    /// If there is nothing to draw, or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        let shapes: Vec<String> = self.evaluated.scenes.iter().map(shape).collect();
        let scenes: Vec<SceneFacts<'_>> = self
            .evaluated
            .scenes
            .iter()
            .zip(&shapes)
            .map(|(scene, shape)| SceneFacts {
                name: &scene.name,
                shape,
                triangles: scene.a.triangles(),
            })
            .collect();
        let methods = self.methods.iter();
        let methods: Vec<MethodFacts<'_>> = methods
            .map(|(name, family)| MethodFacts {
                name,
                family: *family,
            })
            .collect();
        let charts = Charts {
            cells: &self.cells,
            scenes: &scenes,
            methods: &methods,
        };
        let drawings = charts.drawings()?;
        for drawing in &drawings {
            write(&folder.join(format!("{}.svg", drawing.name)), &drawing.svg)?;
        }
        let views = Views::new(&self.evaluated.scenes)?;
        let page = folder.join("index.html");
        write(&page, &page::html(&drawings, &views, &self.comparisons)?)?;
        Ok(page)
    }
}

/// Writes a text into a file.
fn write(path: &Path, text: &str) -> Result<()> {
    ccd_file::write(path, |out| out.write_all(text.as_bytes()))
        .with_context(|| format!("cannot write {}", path.display()))
}

/// Returns the methods in a table of answers, without those that measure something else.
fn answering(methods: &[(String, Family)], safety: &TextTable) -> Vec<(String, Family)> {
    let listed = |name: &String| safety.rows.iter().any(|row| row.first() == Some(name));
    let answering = methods.iter().filter(|(name, _)| listed(name));
    answering.cloned().collect()
}

fn sentences(
    evaluated: &Evaluated,
    methods: &[(String, Family)],
    reference: &Reference<'_>,
) -> Vec<String> {
    let triangles: Vec<usize> = (evaluated.scenes.iter())
        .map(|scene| scene.a.triangles())
        .collect();
    let measurements = Measurements {
        triangles: &triangles,
        methods,
        cells: evaluated.journal.cells(),
        reference,
        tolerance: USUAL_TOLERANCE,
    };
    measurements.sentences()
}

/// Returns the family of each method; an unknown method was measured elsewhere.
fn families(names: &[&str]) -> Vec<(String, Family)> {
    let known: Vec<(String, Family)> = Method::all()
        .into_iter()
        .map(|method| (method.to_string(), family(method)))
        .collect();
    names
        .iter()
        .map(|&name| {
            let found = known.iter().find(|(known, _)| known == name);
            (
                name.to_owned(),
                found.map_or(Family::Peer, |(_, family)| *family),
            )
        })
        .collect()
}

fn family(method: Method) -> Family {
    match method {
        Method::Ours(..) if method.is_model() => Family::Model,
        Method::Ours(..) => Family::Ours,
        Method::Rival(_) => Family::Rival,
        Method::Peer(_) | Method::Script(_) => Family::Peer,
    }
}

/// Returns the moving shape of a scene and its kind of motion, without size and rotation.
fn shape(scene: &Scene) -> String {
    let plain: String = scene.name.chars().filter(|c| !c.is_ascii_digit()).collect();
    let plain = plain.trim_end_matches(" translating");
    plain.trim_end_matches(" turning").to_owned()
}
