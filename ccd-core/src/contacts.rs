//! All features that are in contact at a time `[FAST06 §5.2]`.

mod boxes;
mod candidate;
mod closest;
mod feature_pair;
mod manifold;
mod measure;
mod near;
mod skin;
mod surface;

use crate::motion::pose::Frame;
use crate::problem::Problem;
pub use feature_pair::FeaturePair;
use manifold::Manifold;
use near::near_faces;
use skin::Skin;
use std::fmt;

/// The reason why there is no list of contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ContactsError {
    /// The time is NaN, or not within the duration.
    NotInDuration {
        /// The requested time.
        time: f64,
        /// The problem's duration.
        duration: f64,
    },
    /// More pairs are near, of nodes, of boxes of faces, or of features, than the problem's
    /// [budget](crate::Config::budget) allows. Either the bodies are small for the margin and the
    /// tolerance, or one is deep in the other.
    TooMany {
        /// The budget.
        budget: u64,
    },
}

impl Problem<'_> {
    /// Returns all features that are in contact at a time, the contact manifold `[FAST06 §5.2]`.
    ///
    /// There are two kinds of pairs. Each pair is listed once, nearest first:
    /// - a vertex and the nearest part of a face: usually the face's inside, at the vertex's foot,
    ///   otherwise an edge or a vertex of the face. An edge or vertex is left out if a larger part
    ///   with it on its boundary makes a pair with the same vertex at the same distance;
    /// - two edges whose nearest points are inside of both. Edges that are parallel up to rounding
    ///   do not cross: their ends make the pairs.
    ///
    /// The edge between two triangles that share its vertices and are in one plane, up to rounding,
    /// is not part of the shape. It crosses nothing. A point on it belongs to the face of smaller
    /// number, and is in a pair only if neither triangle comes nearer. A cube that lies flat on a
    /// slab therefore has four pairs, however the faces are cut into triangles.
    ///
    /// Features have the same names as in outcomes. A feature without a number has the name of its
    /// face or piece: all features of approximate hulls, and corners where the mesh has no vertex.
    /// Such a pair of names may be listed more than once, for different places. The same mesh has
    /// the same names in triangles, patches and hulls. Virtual facets make no pairs on pieces that
    /// have faces of the mesh. A piece of more than three points without known facets has vertices
    /// only.
    ///
    /// Distances are unsigned: for bodies that overlap at that time, these are the features whose
    /// boundaries are near each other.
    ///
    /// # Guarantee
    /// No pair within margin + tolerance is missed, and
    /// [`Separation::lower`](crate::Separation::lower) of every pair is within that. Lower and
    /// upper bound are those of the two features, rounding included. The same call gives the same
    /// bits.
    ///
    /// # Errors
    /// [`ContactsError`].
    ///
    /// # Complexity
    /// Near-linear in the pairs of pieces and of faces whose boxes are within margin + tolerance,
    /// and in all faces of these pieces. A descent over both bodies' trees finds the pieces.
    /// Another one finds the faces, which are sorted once. The budget limits each of them.
    ///
    /// ```
    /// use ccd_core::{glam::DVec3, Body, Config, Motion, Moving, Pose, Problem};
    /// let (cube, slab) = (Body::cuboid(DVec3::splat(0.5))?, Body::cuboid(DVec3::new(2.0, 2.0, 1.0))?);
    /// let place = Pose::at(DVec3::new(0.3, 0.2, 1.5005))?;
    /// let still = |body, pose| Moving { body, motion: Motion::still(pose) };
    /// let (a, b) = (still(&cube, place), still(&slab, Pose::IDENTITY));
    /// let problem = Problem::new(a, b, 1.0, &Config::default())?;
    /// let contacts = problem.contacts_at(0.0)?;
    /// let names = contacts.iter().map(|pair| format!("{} {}", pair.feature_a, pair.feature_b));
    /// let mut names: Vec<String> = names.collect();
    /// names.sort();
    /// assert_eq!(names, ["v0 f5", "v1 f5", "v2 f5", "v3 f5"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn contacts_at(&self, time: f64) -> Result<Vec<FeaturePair>, ContactsError> {
        let duration = self.time(1.0);
        // Written so that NaN is refused.
        if !(0.0..=duration).contains(&time) {
            return Err(ContactsError::NotInDuration { time, duration });
        }
        let clock = if duration > 0.0 { time / duration } else { 0.0 };
        let frames = [self.a.path.frame(clock), self.b.path.frame(clock)];
        let b_to_a = frames[0].from_frame(&frames[1]);
        let mut skins = [
            Skin::new(self.a.body, Frame::IDENTITY),
            Skin::new(self.b.body, b_to_a),
        ];
        let budget = self.budget;
        let too_many = ContactsError::TooMany { budget };
        // Two measured distances may be off in either direction: that of the boxes and that of the
        // features.
        let reach = self.margin + self.tolerance + 2.0 * self.rounding;
        let near = near_faces(self, &mut skins, &b_to_a, reach).ok_or(too_many)?;
        for skin in &mut skins {
            skin.hide_cuts(self.rounding);
        }
        let [a, b] = &skins;
        let mut manifold = Manifold::new(self, [a, b]);
        for faces in near {
            manifold.meet(faces);
            if manifold.len() as u64 > budget {
                return Err(too_many);
            }
        }
        Ok(manifold.pairs(&frames[0]))
    }
}

impl fmt::Display for ContactsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotInDuration { time, duration } => {
                write!(f, "time is {time}, but must be from 0 to {duration}")
            }
            Self::TooMany { budget } => write!(
                f,
                "more pairs of features are near than a budget of {budget} allows"
            ),
        }
    }
}

impl std::error::Error for ContactsError {}

#[cfg(test)]
mod tests;
