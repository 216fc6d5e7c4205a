//! What the checked proofs must be about: two bodies, or all pairs of a cell.

use crate::bodies::meshes::MeshArgs;
use anyhow::{Context, Result};
use ccd_core::order::lesser;
use ccd_decomp::BodySource;
use ccd_prove::{Body, ProvenCell, ProvenPair, Statement};

/// What the checked proofs must be about.
pub(super) enum Subject<'c> {
    /// A pair of bodies, with the margin that it keeps. If no body is given, proofs may be about anything.
    Pair(Box<ExpectedPair>, f64),
    /// All pairs of a cell, with a distance that they keep.
    Cell(ProvenCell<'c>, f64),
}

/// The bodies that proofs must be about; `None` for a body that is not given.
pub(super) struct ExpectedPair {
    bodies: [Option<ccd_core::Body>; 2],
    digests: [Option<[u8; 32]>; 2],
}

impl ExpectedPair {
    /// Loads the bodies that are named.
    pub(super) fn load(names: [&Option<String>; 2], meshes: &MeshArgs) -> Result<Self> {
        let [a, b] = names;
        let bodies = [load(("--a", a), meshes)?, load(("--b", b), meshes)?];
        let digest = |option: &str, body: &Option<ccd_core::Body>| {
            let read_body =
                |body| Body::of(body).with_context(|| format!("{option}: has no triangles"));
            let body = body.as_ref().map(read_body).transpose()?;
            Ok::<_, anyhow::Error>(body.map(|body| body.digest()))
        };
        let digests = [digest("--a", &bodies[0])?, digest("--b", &bodies[1])?];
        Ok(ExpectedPair { bodies, digests })
    }

    /// Returns both bodies in the form for proofs; `None` if one is not given.
    pub(super) fn proven(&self) -> Result<Option<ProvenPair>> {
        let [Some(a), Some(b)] = &self.bodies else {
            return Ok(None);
        };
        Ok(Some(ProvenPair::new(a, b)?))
    }

    /// Returns whether a statement is about one pair of these bodies.
    fn is_subject_of(&self, statement: &Statement) -> bool {
        if self.digests.iter().all(Option::is_none) {
            return true;
        }
        let [([a, b], _)] = statement.pairs[..] else {
            return false;
        };
        let digest = |number: u32| statement.bodies.get(number as usize).map(|body| body.0);
        let matches_digest =
            |expected: Option<[u8; 32]>, number| expected.is_none() || expected == digest(number);
        matches_digest(self.digests[0], a) && matches_digest(self.digests[1], b)
    }
}

impl Subject<'_> {
    /// Returns the verdict of a proof that holds: its statement in short.
    ///
    /// # Errors
    /// The verdict of a proof that is about another subject.
    pub(super) fn verdict(&self, statement: &Statement) -> Result<String, String> {
        let mut text = String::from("holds: ");
        match self {
            Subject::Pair(expected, _) if !expected.is_subject_of(statement) => {
                return Err("other bodies".into());
            }
            Subject::Pair(_, margin) => {
                let margins = statement.pairs.iter().map(|pair| pair.1);
                let least = margins.fold(f64::INFINITY, lesser);
                // Written so that NaN is refused.
                if !(least >= *margin) {
                    return Err(format!("smaller margin: {least}"));
                }
            }
            Subject::Cell(cell, clearance) => {
                let joints = cell.joints_of(statement, *clearance);
                let joints = joints.ok_or("other cell")?;
                cell.check_positions(&joints)
                    .map_err(|problem| format!("impossible: {problem}"))?;
                for (name, [from, to]) in joints {
                    text += &format!("{name} {from} to {to}; ");
                }
            }
        }
        Ok(text + &statement.summary())
    }
}

/// Loads the body that an option names; `None` without the option.
fn load(
    (option, body): (&'static str, &Option<String>),
    meshes: &MeshArgs,
) -> Result<Option<ccd_core::Body>> {
    let Some(text) = body else {
        return Ok(None);
    };
    let source: BodySource = text.parse().context(option)?;
    let prepared = source
        .load_adjusted(&meshes.adjustments(), meshes.choice())
        .with_context(|| format!("{option} {text}"))?;
    Ok(Some(prepared.body))
}
