//! The page of the maps: what opens at each cell.

use super::family::{Case, Expected, Family, Step};
use super::findings::Findings;
use super::summary::{growth_map, reach_map};
use crate::run::contest::Verdict;
use crate::run::measured::Trial;
use crate::show::atlas::{Atlas, Detail, StepLine};
use crate::show::page::PageError;
use crate::show::view::{Shot, View};
use ccd_decomp::TriangleMesh;
use std::path::Path;

/// Bodies of more triangles have no picture, which would make the page too large.
const MOST_TRIANGLES: usize = 5_000;

const PREFACE: &str = "\
Each family is a scene with one parameter that makes it harder, and exact answers. Cells of methods that were \
not asked are empty; a method that was stopped at two values in a row is asked about no harder ones. Click on a \
cell: it opens the answers, the scene at the time of the first wrong one, and the command that asks again.";

/// Writes the page of both maps; `options` are those of the command that asked.
///
/// # Errors
/// [`PageError`].
pub fn write_atlas(findings: &Findings<'_>, options: &str, path: &Path) -> Result<(), PageError> {
    let mut pictures = Vec::new();
    let details: Vec<Vec<Option<Detail>>> = findings
        .families
        .iter()
        .map(|family| details(findings, family, options, &mut pictures))
        .collect();
    let views: Vec<View<'_>> = pictures.iter().map(Picture::view).collect();
    let page = Atlas {
        title: "Where methods fail",
        preface: PREFACE,
        maps: &[reach_map(findings), growth_map(findings)],
        details: &details,
        views: &views,
    };
    page.write(path)
}

/// A step that is shown, and the answers that are.
struct Picture {
    name: String,
    meshes: [TriangleMesh; 2],
    shots: Vec<Shot>,
}

impl Picture {
    fn view(&self) -> View<'_> {
        View {
            scene: &self.name,
            a: &self.meshes[0],
            b: &self.meshes[1],
            shots: self.shots.clone(),
        }
    }
}

/// Returns what opens at the cells of a family; adds the pictures that they need.
fn details(
    findings: &Findings<'_>,
    family: &Family,
    options: &str,
    pictures: &mut Vec<Picture>,
) -> Vec<Option<Detail>> {
    let steps: Vec<(f64, Option<Step>)> = family
        .values
        .iter()
        .map(|&value| (value, (family.make)(value).ok()))
        .collect();
    findings
        .methods
        .iter()
        .map(|method| {
            let method = method.to_string();
            let mut lines = Vec::new();
            let mut view = None;
            for (value, step) in &steps {
                let (Some(trial), Some(step)) = (findings.worst(family, *value, &method), step)
                else {
                    continue;
                };
                let case = step.cases.get(trial.row);
                lines.push(line(*value, trial, case));
                let wrong = trial.verdict != Verdict::Right.to_string();
                if let (true, None, Some(case)) = (wrong, view, case) {
                    let name = format!("{} {value:e}", family.name);
                    view = picture(pictures, &name, step)
                        .and_then(|at| Some([at, pictures[at].add(&method, trial, case)?]));
                }
            }
            (!lines.is_empty()).then(|| Detail {
                // A folder of its own: the answers there are not known yet.
                command: format!(
                    "ccd-bench stability --full{options} --families '{}' --methods '{method}' \
                     --out target/ccd-again",
                    family.name
                ),
                steps: lines,
                view,
            })
        })
        .collect()
}

/// Returns the number of the picture of a step, which is made on first use; none of large bodies.
fn picture(pictures: &mut Vec<Picture>, name: &str, step: &Step) -> Option<usize> {
    let triangles: usize = step.meshes.iter().map(|mesh| mesh.faces().len()).sum();
    if triangles > MOST_TRIANGLES {
        return None;
    }
    let known = pictures.iter().position(|picture| picture.name == name);
    Some(known.unwrap_or_else(|| {
        pictures.push(Picture {
            name: name.to_owned(),
            meshes: step.meshes.clone(),
            shots: Vec::new(),
        });
        pictures.len() - 1
    }))
}

impl Picture {
    /// Adds an answer, and returns its number; none if the motion cannot be shown.
    fn add(&mut self, method: &str, trial: &Trial, case: &Case) -> Option<usize> {
        let duration = case.query.duration;
        let exact = match case.expected {
            Expected::Contact { hi, .. } => Some(hi),
            Expected::Start => Some(0.0),
            Expected::Free => None,
        };
        let claimed = Some(trial.time).filter(|time| (0.0..=duration).contains(time));
        self.shots.push(Shot {
            query: case.query.clone(),
            name: format!("{method}: {}", trial.verdict),
            status: format!(
                "{}: {}. Exact: {}.",
                trial.verdict,
                given(trial),
                exactly(case)
            ),
            time: claimed.or(exact),
            contact: None,
            gap: None,
        });
        Some(self.shots.len() - 1)
    }
}

fn line(value: f64, trial: &Trial, case: Option<&Case>) -> StepLine {
    StepLine {
        value: format!("{value:e}"),
        verdict: trial.verdict.clone(),
        exact: case.map_or_else(String::new, exactly),
        given: given(trial),
        cost: cost(trial),
    }
}

/// Describes the exact answer of a query.
fn exactly(case: &Case) -> String {
    match case.expected {
        Expected::Contact { lo, hi } => format!("contact at {:.15}", 0.5 * (lo + hi)),
        Expected::Free => "free".to_owned(),
        Expected::Start => "contact at the start".to_owned(),
    }
}

/// Describes the answer of a method.
fn given(trial: &Trial) -> String {
    let free = [Verdict::Right, Verdict::Missed].map(|verdict| verdict.to_string());
    let answer = match trial.time.is_nan() {
        false => format!("{:.15}", trial.time),
        true if free.contains(&trial.verdict) => "free".to_owned(),
        true => String::new(),
    };
    let parts = [answer, trial.note.clone()];
    let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
    if parts.is_empty() {
        "none".to_owned()
    } else {
        parts.join("; ")
    }
}

/// Describes the cost of an answer.
fn cost(trial: &Trial) -> String {
    let time = match trial.micros {
        micros if micros.is_nan() => return String::new(),
        micros if micros < 1e3 => format!("{micros:.1} µs"),
        micros if micros < 1e6 => format!("{:.1} ms", micros / 1e3),
        micros => format!("{:.1} s", micros / 1e6),
    };
    match trial.steps {
        0 => time,
        steps => format!("{time}, {steps} steps"),
    }
}
