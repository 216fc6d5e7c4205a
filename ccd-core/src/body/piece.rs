//! The convex pieces of bodies: the shapes between which oracles compute distances.

use super::cache_table::CacheTable;
use super::facets::{Facets, fan_triangles};
use super::polytope::FacetOrigin;
use super::support::SupportMap;
use crate::math::order::greater;
use crate::math::vector::distance;
use crate::rounding::{RATE_ERROR_F64, WEIGHT_RANGE};
use crate::tuning::MAX_SCANNED_POINTS;
use glam::DVec3;
use std::any::Any;

/// A convex piece: the hull of `points`, grown by `radius`, in its body's frame.
///
/// A ball is one point and a radius, a capsule two points and a radius, a triangle three points.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// The points whose hull is the piece: at least one, all finite. They need not be extreme or distinct.
    pub points: &'a [DVec3],
    /// The radius of the ball by which the hull is grown, ≥ 0.
    pub radius: f64,
    /// The facets of the hull, if known; empty if they are unknown, and for up to three points.
    pub facets: Facets<'a>,
    /// A search structure for extremal points, if one was prepared.
    pub(crate) support_map: Option<&'a SupportMap>,
    /// The place where values that backends derive from the piece are cached; `None` for a piece outside of any list.
    pub(crate) cache_table_row: Option<CacheTableRow<'a>>,
}

/// The place of a piece's cached values: the side table of its list, and its index there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CacheTableRow<'a> {
    pub(crate) cache_table: &'a CacheTable,
    pub(crate) row_len: usize,
    pub(crate) index: usize,
}

impl<'a> Piece<'a> {
    /// Creates a piece without radius and facets from points, for example to call an oracle directly.
    pub fn from_points(points: &'a [DVec3]) -> Self {
        Piece {
            points,
            radius: 0.0,
            facets: Facets::EMPTY,
            support_map: None,
            cache_table_row: None,
        }
    }

    /// Returns the cached value of type `T` that `make` computes from the piece. The value is computed when first
    /// requested, and stored as long as the list of the piece exists. Returns `None` for a piece that belongs to no
    /// list.
    ///
    /// The value belongs to the piece as stored in the list, regardless of later changes of the public fields. The
    /// function `make` must not request the same type of the same piece: it would wait for itself.
    ///
    /// Each type has its own values, so every backend should define its own type. The first request takes memory for
    /// one entry for every piece of the list: box large values.
    ///
    /// ```
    /// use ccd_core::{glam::DVec3, Piece, Pieces};
    /// struct Middle(DVec3);
    /// let middle = |piece: &Piece| Middle(piece.points.iter().sum::<DVec3>() / 3.0);
    /// let corners = [DVec3::ZERO, 3.0 * DVec3::X, 3.0 * DVec3::Y];
    /// let list = Pieces::from_triangles(&corners, &[[0, 1, 2]], &[0]).unwrap();
    /// let kept = list.get(0).cached_value(middle).unwrap();
    /// assert_eq!(kept.0, DVec3::new(1.0, 1.0, 0.0));
    /// assert!(std::ptr::eq(kept, list.get(0).cached_value(middle).unwrap()));
    /// assert!(Piece::from_points(&corners).cached_value(middle).is_none());
    /// ```
    #[inline]
    pub fn cached_value<T: Any + Send + Sync>(
        &self,
        make: impl FnOnce(&Self) -> T,
    ) -> Option<&'a T> {
        let slot = self.cache_table_row?;
        let entry = slot.cache_table.entry(slot.row_len, slot.index);
        Some(entry.get_or_init(|| make(self)))
    }

    /// Returns the piece with a search structure for extremal points if it has many points. The structure is created
    /// once and stored.
    #[inline]
    pub(crate) fn with_support_map(self, make: impl FnOnce(&Self) -> SupportMap) -> Self {
        if self.points.len() <= MAX_SCANNED_POINTS || self.support_map.is_some() {
            return self;
        }
        let support = self.cached_value(|piece| Box::new(make(piece)));
        Piece {
            support_map: support.map(|kept| &**kept),
            ..self
        }
    }

    /// Returns the mesh's triangles on the piece, each with the number of its face in the mesh. Polygons become fans
    /// about their first corner.
    pub fn mesh_triangles(&self) -> impl Iterator<Item = (u32, [DVec3; 3])> {
        let facets = self.facets.facet_sources.iter().zip(self.facets.iter());
        let fans = facets.flat_map(|(origin, corners)| {
            let id = match origin {
                FacetOrigin::Face(id) => Some(*id),
                FacetOrigin::Faces | FacetOrigin::Virtual => None,
            };
            let at = |v: u32| self.points[v as usize];
            id.into_iter()
                .flat_map(move |id| fan_triangles(corners).map(move |fan| (id, fan.map(at))))
        });
        let faces = self.facets.mesh_faces.iter();
        fans.chain(faces.map(|face| (face.id, face.corners)))
    }

    /// Returns the index of a point that is farthest along a direction of any length. For a piece of a body with many
    /// points, only some of them are tested.
    ///
    /// # Guarantee
    /// The guarantee of [`SupportMap::extremal_point`].
    pub fn extremal_point(&self, direction: DVec3) -> u32 {
        if let Some(support) = self.support_map {
            return support.extremal_point(direction);
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

    /// Returns the position of a point that is farthest along a direction.
    pub(crate) fn extremal_position(&self, direction: DVec3) -> DVec3 {
        self.points[self.extremal_point(direction) as usize]
    }

    /// Returns the center and radius of a ball around the points; `None` if no search structure stores one.
    #[inline]
    pub(crate) fn bounding_ball(&self) -> Option<(DVec3, f64)> {
        self.support_map.and_then(SupportMap::bounding_ball)
    }

    /// Returns an upper bound of the distances of the piece's points from `from`. It comes from the bounding ball if one is
    /// stored; otherwise it is exact up to rounding.
    pub(crate) fn max_distance_from(&self, from: DVec3) -> f64 {
        if let Some((middle, radius)) = self.bounding_ball() {
            return (distance(middle, from) + radius) * (1.0 + RATE_ERROR_F64);
        }
        let squares = self.points.iter().map(|p| p.distance_squared(from));
        squares.fold(0.0, greater).sqrt()
    }

    /// Returns the approximate number of points that a search for an extremal point evaluates.
    pub(crate) fn evaluations_per_search(&self) -> u64 {
        let few = self.points.len().min(MAX_SCANNED_POINTS);
        match self.support_map {
            Some(_) => few as u64,
            None => self.points.len() as u64,
        }
    }

    /// Returns whether all points of the piece are in one plane: it has up to three points, or exactly two facets.
    pub(crate) fn is_flat(&self) -> bool {
        self.points.len() <= 3 || self.facets.len() == 2
    }
}

/// A convex combination of up to four points of a piece.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ConvexCombination {
    point_indices: [u32; 4],
    weights: [f64; 4],
    len: u8,
}

impl ConvexCombination {
    /// The empty combination, to which terms can be [added](ConvexCombination::add_weighted_point).
    pub const EMPTY: ConvexCombination = ConvexCombination {
        point_indices: [0; 4],
        weights: [0.0; 4],
        len: 0,
    };

    /// Creates the combination of a single point with weight 1.
    pub fn from_single_point(index: u32) -> Self {
        let mut out = Self::EMPTY;
        out.add_weighted_point(index, 1.0);
        out
    }

    /// Creates the combination `(1 − t) p + t q` of two points.
    pub fn of_two_points(indices: [u32; 2], t: f64) -> Self {
        let mut out = Self::EMPTY;
        out.add_weighted_point(indices[0], 1.0 - t);
        out.add_weighted_point(indices[1], t);
        out
    }

    /// Adds a point of the piece, by its index, with a weight. Weights that are not positive, or outside of
    /// `WEIGHT_RANGE`, are dropped. Equal indices are merged. Terms beyond four distinct indices are dropped.
    pub fn add_weighted_point(&mut self, index: u32, weight: f64) {
        // A NaN is in no range.
        if !WEIGHT_RANGE.contains(&weight) {
            return;
        }
        let len = self.len as usize;
        if let Some(k) = self.point_indices[..len].iter().position(|&i| i == index) {
            self.weights[k] += weight;
        } else if len < 4 {
            self.point_indices[len] = index;
            self.weights[len] = weight;
            self.len += 1;
        }
    }

    /// Returns the indices of the points in the combination.
    pub fn point_indices(&self) -> &[u32] {
        &self.point_indices[..self.len as usize]
    }

    /// Returns the position of the combination; `None` if it is empty, or has an index that `points` lacks.
    ///
    /// Weights are divided by their sum, so that the result is in the hull up to rounding.
    pub fn position(&self, points: &[DVec3]) -> Option<DVec3> {
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        let first = *points.get(*self.point_indices().first()? as usize)?;
        for (&index, &weight) in self.point_indices().iter().zip(&self.weights) {
            // The sum is relative to the first point, so that its rounding is that of the piece's size.
            sum += weight * (*points.get(index as usize)? - first);
            total += weight;
        }
        Some(first + sum / total)
    }
}
