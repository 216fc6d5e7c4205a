//! The contact of two bodies: a checked pair of nearest points, or the proof of an overlap.

use crate::body::excess::ExcessSum;
use crate::body::feature::Feature;
use crate::math::order::lesser;
use glam::DVec3;

/// The two nearest pieces of the bodies, with bounds of their distance, their nearest points and the features there.
///
/// [`Query::contacts_at`](crate::Query::contacts_at) lists one for every two features in contact, with the bounds of
/// the features' distance and a piece with each feature.
///
/// ```
/// use ccd_core::{glam::DVec3, schedule::BestFirst, *};
/// # struct Balls;
/// # impl DistanceOracle for Balls {
/// #     type Cache = ();
/// #     fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
/// #         let axis = pair.b_to_a.transform_point(pair.b.points[0]) - pair.a.points[0];
/// #         Ok(Claim { axis, a: ConvexCombination::from_single_point(0), b: ConvexCombination::from_single_point(0) })
/// #     }
/// # }
/// let ball = Body::sphere(0.5)?;
/// let flying = Motion::new(Pose::at(-3.0 * DVec3::X)?, DVec3::X, DVec3::ZERO)?;
/// let query = Query::new((&ball, flying), (&ball, Motion::STILL), 4.0, &Settings::DEFAULT)?;
/// let answer = BestFirst::default().first_contact(&query, &mut Balls)?;
/// let Outcome::Contact { contact, .. } = answer.outcome else { panic!("they meet") };
/// // From A to B, with a point of either ball, which is one piece without vertices.
/// assert_eq!(contact.separation.normal, DVec3::X);
/// assert!(contact.separation.witness_b.distance(-0.5 * DVec3::X) < 1e-12);
/// assert_eq!((contact.piece_a, contact.piece_b), (0, 0));
/// # Ok::<(), InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The distance bounds, the normal and the nearest points, in world coordinates at the reported time.
    pub separation: Separation,
    /// The vertex, edge or face of body A that contains its nearest point.
    pub feature_a: Feature,
    /// The vertex, edge or face of body B that contains its nearest point.
    pub feature_b: Feature,
    /// The index of the piece of body A in [`Body::pieces`](crate::Body::pieces).
    pub piece_a: u32,
    /// The index of the piece of body B in [`Body::pieces`](crate::Body::pieces).
    pub piece_b: u32,
}

impl Contact {
    /// Adds the excess of the bodies to the upper bound, so that it holds for the shapes within them.
    pub(crate) fn widened_by_excess(self, excess: ExcessSum) -> Self {
        let Separation { lower, upper, .. } = self.separation;
        self.with_bounds(lower, excess.shape_distance_upper_bound(upper))
    }

    /// Lowers the contact's lower bound to at most `least`.
    pub(crate) fn cap_lower_bound(self, least: f64) -> Self {
        let Separation { lower, upper, .. } = self.separation;
        self.with_bounds(lesser(lower, least), upper)
    }

    /// Returns the same contact with other bounds of the distance.
    pub(crate) fn with_bounds(mut self, lower: f64, upper: f64) -> Self {
        (self.separation.lower, self.separation.upper) = (lower, upper);
        self
    }
}

/// Proven bounds of the distance of two pieces: at least `lower`, at most `upper`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Separation {
    /// A lower bound of the distance: the support gap along `normal`, minus rounding. Negative if
    /// no separating axis was found.
    pub lower: f64,
    /// An upper bound of the distance: the distance of the witnesses, plus rounding. Answers about the
    /// [least distance](crate::schedule::DepthFirst::closest_approach) add the excess of both bodies.
    pub upper: f64,
    /// The unit vector from A to B along which the gap `lower` was computed.
    pub normal: DVec3,
    /// The point of A that is nearest to B.
    pub witness_a: DVec3,
    /// The point of B that is nearest to A.
    pub witness_b: DVec3,
}

/// The proof of an overlap at the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Overlap {
    /// Two pieces intersect: no axis separates them, and the contact's nearest points are in both.
    Pieces(Contact),
    /// A point of body A, in world coordinates, that is inside the solid body B.
    AInsideB(DVec3),
    /// A point of body B, in world coordinates, that is inside the solid body A.
    BInsideA(DVec3),
}

impl Overlap {
    /// Returns the pieces that intersect; `None` if one body is inside the other.
    pub fn contact(&self) -> Option<Contact> {
        match *self {
            Overlap::Pieces(contact) => Some(contact),
            Overlap::AInsideB(_) | Overlap::BInsideA(_) => None,
        }
    }
}
