//! Proofs of answers about two bodies.

use crate::body::{Body, triangles_of};
use crate::error::{NoMesh, NotProven};
use crate::scene::{Scene, Witness};
use crate::statement::Statement;
use crate::stop::{Never, Stop};
use crate::write::{Proof, prove_unless_stopped, statement_of};
use ccd_core::{Answer, Motion, Outcome, Settings};
use std::sync::atomic::AtomicBool;

/// Two bodies that are prepared for proofs.
#[derive(Clone, Debug)]
pub struct ProvenPair {
    bodies: [Body; 2],
}

impl ProvenPair {
    /// Prepares two bodies.
    ///
    /// # Errors
    /// [`NoMesh`], with the name `a` or `b` of the body.
    pub fn new(a: &ccd_core::Body, b: &ccd_core::Body) -> Result<Self, NoMesh> {
        let Ok(pair) = ProvenPair::prepare([a, b], Never);
        pair
    }

    /// Prepares two bodies as [`new`](Self::new) does. Returns `None` soon after another thread sets the flag `stop`.
    pub fn unless_stopped(
        a: &ccd_core::Body,
        b: &ccd_core::Body,
        stop: &AtomicBool,
    ) -> Option<Result<Self, NoMesh>> {
        ProvenPair::prepare([a, b], stop).ok()
    }

    fn prepare<S: Stop>(
        bodies: [&ccd_core::Body; 2],
        stop: S,
    ) -> Result<Result<Self, NoMesh>, S::Stopped> {
        let [a, b] = bodies.map(triangles_of);
        let no_mesh = |name: &str| Ok(Err(NoMesh { body: name.into() }));
        let Some(a) = a else { return no_mesh("a") };
        let Some(b) = b else { return no_mesh("b") };
        let [a, b] = [a, b].map(|triangles| Body::of_triangles(&triangles, stop));
        Ok(Ok(ProvenPair { bodies: [a?, b?] }))
    }

    /// Returns the meshes of the bodies.
    pub fn meshes(&self) -> [&Body; 2] {
        self.bodies.each_ref()
    }

    /// Returns the statement that the bodies stay apart during whole motions. Returns `None` if a number is too small for a
    /// certificate.
    pub fn statement(&self, motions: [Motion; 2], duration: f64, margin: f64) -> Option<Statement> {
        let [a, b] = &self.bodies;
        let scene = Scene::of_two((a, motions[0]), (b, motions[1]), margin);
        statement_of(&scene, duration)
    }

    /// Proves an answer about the first contact. The statement is that the bodies stay farther apart than the margin until the contact.
    /// The witness is the contact. If a limit ended the query, the statement ends at the certified time, and has no witness.
    ///
    /// `settings` are the settings of the query. Their stop flag also stops the proof. Returns `None` if there is nothing to prove: the
    /// bodies are in contact at the start, or the query was about a distance.
    ///
    /// # Errors
    /// [`NotProven`].
    ///
    /// ```
    /// use ccd_prove::ProvenPair;
    /// use rigid_ccd::{Body, Motion, Pose, Settings, Solver};
    /// let (ball, wall) = (Body::sphere(0.5)?, Body::cuboid([0.1, 5.0, 5.0])?);
    /// let flies = Motion::new(Pose::at([-3.0, 0.0, 0.0])?, [4.0, 0.0, 0.0], [0.0; 3])?;
    /// let answer = Solver::new().first_contact((&ball, flies), (&wall, Motion::STILL), 1.0)?;
    ///
    /// let pair = ProvenPair::new(&ball, &wall)?;
    /// let proof = pair.prove([flies, Motion::STILL], 1.0, &Settings::DEFAULT, &answer).expect("a contact")?;
    /// let read = |body: &ccd_prove::Body| {
    ///     ccd_check::Body::new(body.mesh(), body.certificate(), &proof.bytes)
    /// };
    /// let [a, b] = pair.meshes();
    /// ccd_check::check(&[read(a)?, read(b)?], &proof.bytes)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn prove(
        &self,
        motions: [Motion; 2],
        duration: f64,
        settings: &Settings,
        answer: &Answer,
    ) -> Option<Result<Proof, NotProven>> {
        let (until, witness) = match &answer.outcome {
            Outcome::Free { .. } => (duration, None),
            Outcome::Unresolved(unresolved) if unresolved.safe_until > 0.0 => {
                (unresolved.safe_until, None)
            }
            Outcome::Contact { time, contact } => {
                let witness = Witness::of_two(*time, answer.tolerance, contact);
                (*time, Some(witness))
            }
            _ => return None,
        };
        let [a, b] = &self.bodies;
        let scene = Scene::of_two((a, motions[0]), (b, motions[1]), settings.margin);
        let stop = settings.stop.as_deref();
        Some(prove_unless_stopped(&scene, until, witness, stop))
    }
}
