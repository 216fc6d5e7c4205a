//! Convex pieces: what bodies are made of and what oracles measure between.

use super::facets::Facets;
use super::polytope::Origin;
use super::side_table::SideTable;
use super::support::Support;
use crate::math::order::greater;
use crate::math::vector::distance;
use crate::tolerance::{CLIMBED_POINTS, RATE_F64};
use glam::DVec3;
use std::any::Any;

/// A convex piece: the hull of `points`, grown by `radius`, in its body's frame.
///
/// A ball is one point and a radius, a capsule two points and a radius, a triangle three points.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// At least one point, all finite; not necessarily all extreme, or distinct.
    pub points: &'a [DVec3],
    /// Rounding radius ≥ 0.
    pub radius: f64,
    /// The facets of the hull, where known: empty for up to three points.
    pub facets: Facets<'a>,
    /// Finds extremal points, where that is prepared, and proven to find the right ones.
    pub(crate) support: Option<&'a Support>,
    /// Where backends keep what they make of it.
    pub(crate) slot: Option<Slot<'a>>,
}

/// The row of a side table that belongs to a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slot<'a> {
    pub(crate) side_table: &'a SideTable,
    pub(crate) len: usize,
    pub(crate) index: usize,
}

impl<'a> Piece<'a> {
    /// A piece without known facets, e.g. to try an oracle on.
    pub fn from_points(points: &'a [DVec3]) -> Self {
        Piece {
            points,
            radius: 0.0,
            facets: Facets::NONE,
            support: None,
            slot: None,
        }
    }

    /// Returns what a backend makes of the piece and keeps for the next time: made when it is first
    /// asked for, dropped with the list that the piece belongs to. None for a piece that belongs to
    /// no list.
    ///
    /// It belongs to the piece as the list has it, whatever has become of the public fields since.
    /// `make` must not ask for the same type of the same piece: it would wait for itself.
    ///
    /// Types are kept apart, so that every backend has a type of its own, and one entry for each
    /// piece, which costs memory for all pieces of the list from the first one on: box what is large.
    ///
    /// ```
    /// use ccd_core::{glam::DVec3, Piece, Pieces};
    /// struct Middle(DVec3);
    /// let middle = |piece: &Piece| Middle(piece.points.iter().sum::<DVec3>() / 3.0);
    /// let corners = [DVec3::ZERO, 3.0 * DVec3::X, 3.0 * DVec3::Y];
    /// let list = Pieces::triangles(&corners, &[[0, 1, 2]], &[0]).unwrap();
    /// let kept = list.get(0).kept(middle).unwrap();
    /// assert_eq!(kept.0, DVec3::new(1.0, 1.0, 0.0));
    /// assert!(std::ptr::eq(kept, list.get(0).kept(middle).unwrap()));
    /// assert!(Piece::from_points(&corners).kept(middle).is_none());
    /// ```
    #[inline]
    pub fn kept<T: Any + Send + Sync>(&self, make: impl FnOnce(&Self) -> T) -> Option<&'a T> {
        let slot = self.slot?;
        let entry = slot.side_table.entry(slot.len, slot.index);
        Some(entry.get_or_init(|| make(self)))
    }

    /// The same piece with what finds its extremal points where they are many, made once and kept.
    #[inline]
    pub(crate) fn supported(self, make: impl FnOnce(&Self) -> Support) -> Self {
        if self.points.len() <= CLIMBED_POINTS || self.support.is_some() {
            return self;
        }
        let support = self.kept(|piece| Box::new(make(piece)));
        Piece {
            support: support.map(|kept| &**kept),
            ..self
        }
    }

    /// The mesh's triangles that are on the piece, with the numbers of their faces; polygons are fans
    /// about their first corner.
    pub fn mesh_triangles(&self) -> impl Iterator<Item = (u32, [DVec3; 3])> {
        let facets = self.facets.origins.iter().zip(self.facets.iter());
        let fans = facets.flat_map(|(origin, corners)| {
            let id = match origin {
                Origin::Face(id) => Some(*id),
                Origin::Faces | Origin::Virtual => None,
            };
            let points = self.points;
            let at = move |k: usize| points[corners[k] as usize];
            let fan = (1..corners.len() - 1).map(move |k| [at(0), at(k), at(k + 1)]);
            id.into_iter()
                .flat_map(move |id| fan.clone().map(move |t| (id, t)))
        });
        let faces = self.facets.faces.iter();
        fans.chain(faces.map(|face| (face.id, face.corners)))
    }

    /// The index of a point that is farthest along a direction of any length; of a piece of a body,
    /// without looking at all points where they are many.
    ///
    /// # Guarantee
    /// As [`Support::extremal`].
    pub fn extremal(&self, direction: DVec3) -> u32 {
        if let Some(support) = self.support {
            return support.extremal(direction);
        }
        let (mut found, mut highest) = (0, f64::NEG_INFINITY);
        for (k, point) in (0..).zip(self.points) {
            let height = direction.dot(*point);
            if height > highest {
                (found, highest) = (k, height);
            }
        }
        found
    }

    /// A point that is farthest along a direction.
    pub(crate) fn farthest(&self, direction: DVec3) -> DVec3 {
        self.points[self.extremal(direction) as usize]
    }

    /// A ball about the points, where they are many and [`Piece::extremal`] is fast.
    #[inline]
    pub(crate) fn ball(&self) -> Option<(DVec3, f64)> {
        self.support.and_then(Support::ball)
    }

    /// Returns the largest distance of the points from one, or a little more than that.
    pub(crate) fn farthest_from(&self, from: DVec3) -> f64 {
        if let Some((middle, radius)) = self.ball() {
            return (distance(middle, from) + radius) * (1.0 + RATE_F64);
        }
        let squares = self.points.iter().map(|p| p.distance_squared(from));
        squares.fold(0.0, greater).sqrt()
    }

    /// Returns about how many points are looked at to find an extremal one.
    pub(crate) fn looks(&self) -> u64 {
        let few = self.points.len().min(CLIMBED_POINTS);
        match self.support {
            Some(_) => few as u64,
            None => self.points.len() as u64,
        }
    }

    /// Whether it lies in a plane: a polytope of volume has more than two facets.
    pub(crate) fn is_flat(&self) -> bool {
        self.points.len() <= 3 || self.facets.len() == 2
    }
}
