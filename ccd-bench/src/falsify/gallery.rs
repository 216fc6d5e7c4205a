//! The smallest failures: their files, the command that repeats each, a table, a page.

use super::aim::Aim;
use super::climb::{Failure, Report};
use super::examiner::Examined;
use crate::method::Method;
use crate::method::guarded::Asked;
use crate::method::solver::Claim;
use crate::run::contest::Verdict;
use crate::run::joined::write_inputs;
use crate::show::atlas::{Atlas, Detail, StepLine};
use crate::show::chart::{HeatCell, HeatKind, HeatMap, HeatRow};
use crate::show::tables::TextTable;
use crate::show::view::{Shot, View};
use crate::truth::Truth;
use anyhow::{Context, Result};
use ccd_decomp::TriangleMesh;
use rigid_ccd::table::motions::Query;
use std::fs;
use std::path::Path;

const PREFACE: &str = "\
A search changes two meshes and their motions, step by step, until a method fails, and then leaves out whatever \
the failure does not need. Click on a cell: it opens the failure, the scene at the time of the answer, and the \
command that asks again.";

/// Writes the failures into a folder: their meshes and motions, `gallery.md`, `index.html`; `script` is the
/// one that runs the methods of other languages.
///
/// # Errors
/// If a file cannot be written.
pub fn write_gallery(reports: &[Report], folder: &Path, script: Option<&Path>) -> Result<()> {
    let of = |report| Exhibit::of(report, folder, script);
    let scenes: Vec<Option<Exhibit>> = reports.iter().map(of).collect();
    for exhibit in scenes.iter().flatten() {
        exhibit.write(folder)?;
    }
    let table = table(reports);
    let mut text = format!("# {}\n\n{}\n", table.title, table.as_markdown());
    for exhibit in scenes.iter().flatten() {
        text += &format!(
            "\n## {}\n\n{}\n\n```sh\n{}\n```\n",
            exhibit.title, exhibit.said, exhibit.command
        );
    }
    let file = folder.join("gallery.md");
    ccd_file::write(&file, |out| out.write_all(text.as_bytes()))
        .with_context(|| file.display().to_string())?;
    write_page(reports, &scenes, &folder.join("index.html"))
}

/// A failure with its files.
struct Exhibit {
    name: String,
    title: String,
    said: String,
    command: String,
    meshes: [TriangleMesh; 2],
    query: Query,
    shot: Shot,
    step: StepLine,
}

impl Exhibit {
    fn of(report: &Report, folder: &Path, script: Option<&Path>) -> Option<Exhibit> {
        let failure = report.smallest.as_ref()?;
        let Failure {
            attempt,
            examined,
            query,
            meshes,
        } = failure;
        let method = report.hunt.method;
        let name = format!("{method} {}", report.hunt.aim).replace(' ', "-");
        let verdict = examined.judged.verdict;
        let (answer, exact) = (answer_of(examined), exact_of(examined.truth));
        let triangles = attempt.triangles();
        let tolerance = attempt.tolerance;
        let patience = report.hunt.patience.as_secs();
        let peers = match (method, script) {
            (Method::Script(_), Some(script)) => format!(" --peers '{}'", script.display()),
            _ => String::new(),
        };
        let place = folder.join(&name);
        let place = place.display();
        Some(Exhibit {
            title: format!("{method}: {verdict}, {triangles} triangles"),
            said: format!("Answer: {answer}. Exact: {exact}. Tolerance: {tolerance:e}."),
            command: format!(
                "ccd-bench judge --method '{method}'{peers} --tolerance {tolerance} --patience {patience} \\\n  \
                 --a '{place}/a.obj' --b '{place}/b.obj' --motions '{place}/motions.csv'"
            ),
            meshes: meshes.clone(),
            shot: Shot {
                query: query.clone(),
                name: format!("{method}: {verdict}"),
                status: format!("{verdict}: {answer}. Exact: {exact}."),
                time: shown(examined),
                contact: None,
                gap: None,
            },
            query: query.clone(),
            step: StepLine {
                value: format!("{triangles} triangles"),
                verdict: verdict.to_string(),
                exact,
                given: answer,
                cost: String::new(),
            },
            name,
        })
    }

    fn write(&self, folder: &Path) -> Result<()> {
        let directory = folder.join(&self.name);
        let failed = || directory.display().to_string();
        fs::create_dir_all(&directory).with_context(failed)?;
        let queries = std::slice::from_ref(&self.query);
        write_inputs(&directory, self.meshes.each_ref(), queries).with_context(failed)
    }

    fn view(&self) -> View<'_> {
        View {
            scene: &self.title,
            a: &self.meshes[0],
            b: &self.meshes[1],
            shots: vec![self.shot.clone()],
        }
    }
}

/// Returns the time at which a failure is looked at: of the wrong answer, or of the contact that it passes.
fn shown(examined: &Examined) -> Option<f64> {
    let claimed = examined.asked.claim().and_then(Claim::time);
    let hit = match examined.truth {
        Truth::Hit { hi, .. } => Some(hi),
        _ => None,
    };
    claimed
        .filter(|time| (0.0..=examined.duration).contains(time))
        .or(hit)
}

/// Returns the table of all searches.
pub fn table(reports: &[Report]) -> TextTable {
    let header = [
        "method",
        "aim",
        "judged",
        "left out",
        "smallest failure",
        "triangles",
        "answer",
        "exact",
        "nearest to one",
    ];
    let rows = reports.iter().map(|report| {
        let searched = [
            report.hunt.method.to_string(),
            report.hunt.aim.to_string(),
            report.judged().to_string(),
            report.skipped.to_string(),
        ];
        let found = match &report.smallest {
            Some(Failure {
                attempt, examined, ..
            }) => [
                examined.judged.verdict.to_string(),
                attempt.triangles().to_string(),
                answer_of(examined),
                exact_of(examined.truth),
                String::new(),
            ],
            None => {
                let nearest = report.hunt.aim.nearest(report.nearest);
                [
                    "none".to_owned(),
                    String::new(),
                    String::new(),
                    String::new(),
                    nearest,
                ]
            }
        };
        searched.into_iter().chain(found).collect()
    });
    TextTable {
        name: "failures".to_owned(),
        title: "The smallest failures that a search found".to_owned(),
        header: header.map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

fn answer_of(examined: &Examined) -> String {
    match &examined.asked {
        Asked::Answered { reply, .. } => match reply.claim {
            Claim::Contact { time } => format!("contact at {time}"),
            Claim::Free => "free".to_owned(),
            Claim::Unresolved { safe_until } => format!("free until {safe_until}"),
            Claim::Refused => "refused".to_owned(),
        },
        Asked::CutOff => "none in time".to_owned(),
        Asked::Died => "its process ended".to_owned(),
    }
}

fn exact_of(truth: Truth) -> String {
    match truth {
        Truth::Hit { lo, hi } => format!("contact at {:.12}", lo.midpoint(hi)),
        Truth::Free => "free".to_owned(),
        Truth::Start | Truth::Graze { .. } | Truth::Undecided { .. } => "not known".to_owned(),
    }
}

/// Writes the page: aims down, methods across.
fn write_page(reports: &[Report], exhibits: &[Option<Exhibit>], path: &Path) -> Result<()> {
    let mut methods: Vec<String> = Vec::new();
    for report in reports {
        let method = report.hunt.method.to_string();
        if !methods.contains(&method) {
            methods.push(method);
        }
    }
    let shown: Vec<&Exhibit> = exhibits.iter().flatten().collect();
    let detail = |report: &Report, exhibit: Option<&Exhibit>| match exhibit {
        Some(exhibit) => Detail {
            command: exhibit.command.replace("\\\n", ""),
            steps: vec![exhibit.step.clone()],
            view: shown
                .iter()
                .position(|other| other.name == exhibit.name)
                .map(|at| [at, 0]),
        },
        None => nothing_found(report),
    };
    let of = |aim: Aim, method: &String| {
        let same =
            |report: &Report| report.hunt.aim == aim && report.hunt.method.to_string() == *method;
        let at = reports.iter().position(same)?;
        Some((&reports[at], exhibits[at].as_ref()))
    };
    let cell = |(report, _): (&Report, Option<&Exhibit>)| HeatCell::Failure {
        verdict: report
            .smallest
            .as_ref()
            .map_or(Verdict::Right, |f| f.examined.judged.verdict),
        triangles: report.smallest.as_ref().map(|f| f.attempt.triangles()),
    };
    let row = |aim: Aim| HeatRow {
        name: aim.to_string(),
        parameter: aim.meaning().to_owned(),
        cells: methods
            .iter()
            .map(|method| of(aim, method).map(cell))
            .collect(),
    };
    let details = Aim::ALL.map(|aim| {
        let of_method = |method| of(aim, method).map(|(report, exhibit)| detail(report, exhibit));
        methods.iter().map(of_method).collect::<Vec<_>>()
    });
    let map = HeatMap {
        kind: HeatKind::Failures,
        rows: Aim::ALL.map(row).to_vec(),
        methods: methods.clone(),
    };
    let views: Vec<View<'_>> = shown.iter().map(|exhibit| exhibit.view()).collect();
    let page = Atlas {
        title: "The smallest failures",
        preface: PREFACE,
        maps: &[map],
        details: &details,
        views: &views,
    };
    Ok(page.write(path)?)
}

/// Returns what opens where nothing was found.
fn nothing_found(report: &Report) -> Detail {
    let hunt = &report.hunt;
    Detail {
        command: format!(
            "ccd-bench falsify --methods '{}' --aims {} --tries {} --seed {}",
            hunt.method, hunt.aim, hunt.tries, hunt.seed
        ),
        steps: vec![StepLine {
            value: format!("{} queries", report.judged()),
            verdict: "none found".to_owned(),
            exact: String::new(),
            given: String::new(),
            cost: String::new(),
        }],
        view: None,
    }
}
