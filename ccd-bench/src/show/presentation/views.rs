//! The page: charts, tables, and a few motions of each scene to view.

use crate::method::first_contact;
use crate::scene::Scene;
use crate::show::chart::Charts;
use crate::show::page::PageError;
use crate::show::report::Page;
use crate::show::tables::TextTable;
use crate::show::view::{Shot, View};
use ccd_core::{InputError, Instructions, Outcome, Settings};
use rigid_ccd::Solver;
use rigid_ccd::batch::SolverKind;
use rigid_ccd::picture::{Reached, gap};
use rigid_ccd::table::courses::Course;
use std::path::{Path, PathBuf};

/// The number of contacts of a scene to view.
const CONTACTS: usize = 6;
/// The number of other motions of a scene to view.
const OTHERS: usize = 2;

const PREFACE: &str = "\
When do two moving bodies first touch, and how much does it cost to know? Methods of this project, published rivals and peer libraries were \
given the same queries, timed one query at a time, and compared with brackets of the exact first contact.

A method that was late or missed a contact anywhere is drawn as unsafe everywhere, without a point on the \
plane of time and error.";

/// The page cannot be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub(super) enum ViewsError {
    /// A query of a scene is invalid.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The page cannot be written.
    #[error(transparent)]
    Page(#[from] PageError),
}

/// Writes the page into a folder. Returns its path.
///
/// # Errors
/// [`ViewsError`].
pub(super) fn write_page(
    charts: Charts<'_>,
    scenes: &[Scene],
    tables: &[TextTable],
    folder: &Path,
) -> Result<PathBuf, ViewsError> {
    let views: Result<Vec<View<'_>>, InputError> = scenes.iter().map(view).collect();
    let page = Page {
        title: "ccd: certified continuous collision detection",
        preface: PREFACE,
        charts,
        views: &views?,
        tables,
    };
    let path = folder.join("index.html");
    page.write(&path)?;
    Ok(path)
}

/// Returns the view of a scene with the first motions of each kind.
fn view(scene: &Scene) -> Result<View<'_>, InputError> {
    let mut solver = SolverKind::default().solver(Instructions::Best);
    let mut measure = Solver::new();
    let mut shots = Vec::new();
    let (mut contacts, mut others) = (0, 0);
    for query in &scene.queries {
        let answer = first_contact(scene.bodies(), query, &Settings::DEFAULT, solver.as_mut())?;
        let (seen, most) = match answer.outcome {
            Outcome::Contact { .. } => (&mut contacts, CONTACTS),
            _ => (&mut others, OTHERS),
        };
        if *seen < most {
            *seen += 1;
            let shot = Shot::answered(query.clone(), &answer);
            let reached = match answer.outcome {
                Outcome::Free { proven_gap } => Reached::Throughout(proven_gap),
                _ => Reached::Nothing,
            };
            let course = Course::Motions(query.clone());
            let found = gap(&mut measure, scene.bodies(), &course, reached)?;
            shots.push(Shot {
                gap: Some(found),
                ..shot
            });
        }
        if (contacts, others) == (CONTACTS, OTHERS) {
            break;
        }
    }
    // A view opens with a contact, where there is one.
    shots.sort_by_key(|shot| shot.contact.is_none());
    Ok(View {
        scene: &scene.name,
        a: scene.a.mesh(),
        b: scene.b.mesh(),
        shots,
    })
}
