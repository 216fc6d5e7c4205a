//! Draws a few motions of each scene, to view in three dimensions on a page.

use crate::method::first_contact;
use crate::scene::Scene;
use anyhow::Result;
use ccd_core::{Outcome, Settings};
use ccd_tables::movements::Movements;
use ccd_tables::results::ResultRow;
use ccd_view::{Animation, AnimationGroup, Meshes};
use rigid_ccd::Question;
use rigid_ccd_cli::SolverKind;
use rigid_ccd_cli::picture::{Painter, QueryContext, TimeMeaning, drawn_mesh};

/// The views of all scenes; equal meshes are stored once.
#[derive(Clone, Debug, Default)]
pub struct SceneAnimations {
    /// The meshes of all scenes' bodies.
    pub meshes: Meshes,
    /// The views of motions, one group for each scene.
    pub groups: Vec<AnimationGroup>,
}

/// The maximum number of views of a scene: first of motions with a contact, then of other motions.
const MAX_VIEWS_BY_KIND: [usize; 2] = [6, 2];

impl SceneAnimations {
    /// Creates views of the first motions with a contact in each scene, and of the first other motions.
    ///
    /// # Errors
    /// If a query of a scene is invalid.
    pub fn new(scenes: &[Scene]) -> Result<Self> {
        let mut views = SceneAnimations::default();
        for scene in scenes {
            let group = AnimationGroup {
                name: scene.name.clone(),
                views: views.views_of_scene(scene)?,
            };
            views.groups.push(group);
        }
        Ok(views)
    }

    fn views_of_scene(&mut self, scene: &Scene) -> Result<Vec<Animation>> {
        let bodies = scene.bodies();
        let asked = QueryContext {
            time_meaning: TimeMeaning::FirstContact,
            query_margin: Settings::DEFAULT.margin,
            clearance: None,
        };
        let mut painter = Painter::new(bodies, asked);
        // The painter numbers the meshes of one pair; the page has those of all.
        let meshes = [bodies.a, bodies.b].map(|body| self.meshes.add(&drawn_mesh(body)));
        let mut solver = SolverKind::default().solver();
        let mut found = [const { Vec::new() }; 2];
        for query in &scene.queries {
            let answer = first_contact(bodies, query, &Settings::DEFAULT, solver.as_mut())?;
            let kind = usize::from(!matches!(answer.outcome, Outcome::Contact { .. }));
            if found[kind].len() < MAX_VIEWS_BY_KIND[kind] {
                let course = Movements::Motions(query.clone());
                let answer = (Question::FirstContact, &answer);
                let row = ResultRow::new(&course, answer, 0.0, bodies.clearance_and_excess(None));
                let mut view = painter.animate_row(&course, &row)?;
                for (body, mesh) in view.bodies.iter_mut().zip(meshes) {
                    body.mesh = mesh;
                }
                found[kind].push(view);
            }
            if found.each_ref().map(Vec::len) == MAX_VIEWS_BY_KIND {
                break;
            }
        }
        // A scene opens with a contact, where there is one.
        Ok(found.concat())
    }
}
