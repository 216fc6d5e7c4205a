//! Turns measurements into tables, charts and a page.

use crate::method::USUAL_TOLERANCE;
use crate::run::evaluation::Evaluated;
use crate::run::measured::Cell;
use crate::show::chart::{Charts, Family, MethodFacts, SceneFacts};
use crate::show::comparable::Reference;
use crate::show::page;
use crate::show::sentences::Measurements;
use crate::show::tables::{self, TextTable};
use crate::show::views::Views;
use crate::show::write;
use anyhow::Result;
use std::path::{Path, PathBuf};

/// The tables, charts and views of one evaluation.
pub struct Presentation<'e> {
    evaluated: &'e Evaluated,
    /// The findings as sentences.
    pub sentences: Vec<String>,
    /// The tables that are printed on the terminal.
    pub summary: Vec<TextTable>,
    /// The tables of a page or a README.
    pub comparisons: Vec<TextTable>,
    scenes: Vec<SceneFacts<'e>>,
    methods: Vec<MethodFacts<'e>>,
    /// The measurements, with comparable medians.
    cells: Vec<Cell>,
}

/// The finer of the two tolerances at which methods are compared.
const FINE_TOLERANCE: f64 = 1e-6;
/// The name of the reference method of comparisons.
const DEFAULT: &str = "best-first direct";
/// The name of the paper's own method.
const AS_PUBLISHED: &str = "fast vmarch";
/// The methods that the paper compares its own with; the factors are in the table's title.
const PAPERS_RIVALS: [&str; 2] = ["CONTACT", "Dynamic Collision Checker"];

impl<'e> Presentation<'e> {
    /// Makes the tables and sentences from the measurements of an evaluation.
    pub fn new(evaluated: &'e Evaluated) -> Self {
        let (cells, trials) = (evaluated.journal.cells(), evaluated.journal.trials());
        let methods = tables::methods(cells).into_iter();
        let methods: Vec<MethodFacts<'_>> = methods.map(MethodFacts::named).collect();
        let scenes = evaluated.scenes.iter().map(|scene| SceneFacts {
            name: &scene.name,
            triangles: scene.a.triangles(),
        });
        let scenes: Vec<SceneFacts<'_>> = scenes.collect();
        let is_other = |method: &&MethodFacts<'_>| {
            matches!(method.family, Family::Rival | Family::Peer) || method.name == AS_PUBLISHED
        };
        let others = methods.iter().filter(is_other).map(|method| method.name);
        let others: Vec<&str> = others.collect();
        let compared = |tolerance| tables::ratios(trials, DEFAULT, &others, tolerance);
        let mut published = tables::ratios(trials, AS_PUBLISHED, &PAPERS_RIVALS, USUAL_TOLERANCE);
        published.title += "; the paper reports 1.4 to 45.5 over CONTACT";
        let safety = tables::safety(cells, trials);
        let reference = Reference::new(DEFAULT, trials);
        let usual = tables::at_tolerance(cells, USUAL_TOLERANCE, &reference);
        // The others measure something else.
        let answers = |method: &&MethodFacts<'_>| {
            let mut listed = safety.rows.iter().filter_map(|row| row.first());
            listed.any(|name| name == method.name)
        };
        let answering: Vec<_> = methods.iter().filter(answers).copied().collect();
        let measurements = Measurements {
            scenes: &scenes,
            methods: &answering,
            cells,
            reference: &reference,
            tolerance: USUAL_TOLERANCE,
        };
        Presentation {
            sentences: measurements.sentences(),
            comparisons: vec![
                compared(USUAL_TOLERANCE).named("usual"),
                compared(FINE_TOLERANCE).named("fine"),
                published.named("published"),
                safety.clone().named("safety"),
                usual.clone().named("all"),
            ],
            cells: reference.comparable(cells),
            summary: vec![usual, safety],
            evaluated,
            scenes,
            methods,
        }
    }

    /// Writes the charts and the page into a folder. Returns the page's path.
    ///
    /// # Errors
    /// If there is nothing to draw, or a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<PathBuf> {
        let charts = Charts {
            cells: &self.cells,
            scenes: &self.scenes,
            methods: &self.methods,
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
