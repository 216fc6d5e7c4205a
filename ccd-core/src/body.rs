//! A rigid body: convex pieces, a tree over them, and whether they bound a solid.

mod adjacency;
mod cache_table;
pub(crate) mod disjoint_sets;
pub(crate) mod excess;
pub(crate) mod facets;
pub(crate) mod facing;
pub(crate) mod feature;
mod feature_lookup;
pub(crate) mod hierarchy;
#[cfg(feature = "hull-tree")]
pub(crate) mod hull_tree;
pub(crate) mod piece;
pub(crate) mod pieces;
pub(crate) mod polytope;
mod primitive;
pub(crate) mod round;
pub(crate) mod shell;
pub(crate) mod support;
mod surroundings;
mod threads;
pub(crate) mod tree;

use crate::error::InputError;
use crate::math::order::greater;
use crate::tuning::MIN_BOX_FILL;
use feature::Feature;
use feature_lookup::{face_at, prepare_facets_by_corner};
use glam::DVec3;
use hierarchy::Hierarchy;
#[cfg(feature = "hull-tree")]
use hull_tree::convex::build_support_map;
#[cfg(feature = "hull-tree")]
use hull_tree::{HullTree, HullTreeError};
use piece::{ConvexCombination, Piece};
use pieces::Pieces;
use shell::{ExtremePoints, part_extreme_points};
use std::any::Any;
#[cfg(not(feature = "hull-tree"))]
use support::SupportMap;
use threads::{join, parallel_for_each};
use tree::point_query::polytopes_with_box_at;
use tree::{Tree, TreeLayout};

/// A rigid body that is ready for queries: convex pieces in the body's own frame, and a tree over them. It is
/// immutable, and can be shared between queries.
///
/// ```
/// use ccd_core::{glam::DVec3, Body, Pieces, Solidity};
/// let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
/// let pieces = Pieces::from_triangles(&triangle, &[[0, 1, 2]], &[0]).unwrap();
/// let body = Body::new(&pieces, Solidity::Surface).unwrap();
/// assert_eq!(body.pieces().len(), 1);
/// ```
#[derive(Clone, Debug)]
pub struct Body {
    pieces: Pieces,
    tree: Tree,
    solidity: Solidity,
    part_extreme_points: Vec<ExtremePoints>,
    /// The tree of convex hulls, if one was given; its leaves refer to the pieces by their index in `pieces`.
    #[cfg(feature = "hull-tree")]
    hull_tree: Option<HullTree>,
    surface: Option<Box<Surface>>,
    /// The distance by which the body may exceed the shape that it represents.
    excess: f64,
}

/// The triangulated surface of a convex body, which replaces the body in queries against a body of many triangles.
#[derive(Clone, Debug)]
struct Surface {
    triangulated_body: Body,
    /// True if the body fills the box at the root of its tree nearly completely.
    fills_root_box: bool,
}

/// Whether another body that is completely inside this one counts as touching.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Solidity {
    /// The body's triangles bound a solid. They are the pieces, or the [mesh's triangles](crate::Piece::mesh_triangles)
    /// on the pieces, and together they are closed. The solid consists of the points about which they wind, in either
    /// direction. Of nested shells, each has to be wound opposite to the one around it. A body inside the solid
    /// overlaps it. A single piece is solid by itself.
    Solid,
    /// The body is only a surface: another body inside it, without contact with its pieces, does not touch it.
    Surface,
}

impl Body {
    /// Creates a body, and builds its hierarchy by splits at medians.
    ///
    /// # Errors
    /// [`InputError::TooManyPieces`].
    pub fn new(pieces: &Pieces, volume: Solidity) -> Result<Self, InputError> {
        let hierarchy = Hierarchy::median_split(pieces);
        Body::with_hierarchy(pieces, &hierarchy, volume)
    }

    /// Creates a body whose bounding volume tree is built from a given binary hierarchy. The body keeps the pieces in
    /// the hierarchy's order; features have the numbers that the pieces carry.
    ///
    /// # Errors
    /// [`InputError::BadHierarchy`] when the nodes are no hierarchy over these pieces.
    pub fn with_hierarchy(
        pieces: &Pieces,
        hierarchy: &Hierarchy,
        volume: Solidity,
    ) -> Result<Self, InputError> {
        let (layout, pieces) = TreeLayout::from_hierarchy(pieces, hierarchy)?;
        let (shells, tree) = join(
            pieces.len(),
            || part_extreme_points(&pieces),
            || layout.fit_tree(&pieces),
        );
        if !pieces.are_all_triangles() {
            // The searches are prepared now, so that no query waits for them.
            for piece in pieces.iter() {
                piece.with_support_map(build_support_map);
                prepare_facets_by_corner(&piece);
            }
        }
        Ok(Body {
            part_extreme_points: shells,
            pieces,
            tree,
            solidity: volume,
            #[cfg(feature = "hull-tree")]
            hull_tree: None,
            surface: None,
            excess: 0.0,
        })
    }

    /// Adds the triangulated surface to a body of one piece. It is used in queries against bodies of many triangles,
    /// each of which is near only a few triangles of the surface. Against other bodies the body stays one piece.
    ///
    /// # Guarantee
    /// The guarantee of queries holds when the triangles bound the same solid as the piece; this is not checked.
    /// Answers name the same features, and the one piece.
    ///
    /// # Errors
    /// [`InputError::BadSurface`] unless the body is a solid of one piece without rounding, and the
    /// surface is a solid of triangles.
    pub fn with_surface_triangles(mut self, surface: Body) -> Result<Self, InputError> {
        let solid = |body: &Body| body.solidity == Solidity::Solid;
        let whole = self.pieces.len() == 1 && self.pieces.get(0).radius == 0.0;
        if !(whole && solid(&self) && solid(&surface) && surface.pieces.are_all_triangles()) {
            return Err(InputError::BadSurface);
        }
        let [x, y, z] = self.tree.half_extents().map(f64::from);
        let volume = sextuple_signed_volume(&surface.pieces).abs() / 6.0;
        self.excess = greater(self.excess, surface.excess);
        self.surface = Some(Box::new(Surface {
            fills_root_box: volume >= MIN_BOX_FILL * 8.0 * x * y * z,
            triangulated_body: surface,
        }));
        Ok(self)
    }

    /// Adds a hull tree over the body's pieces, for schedules that search hull trees instead of boxes.
    ///
    /// # Errors
    /// [`HullFault::NotAPiece`](crate::HullFault::NotAPiece) unless the tree's leaves are the body's pieces, to the
    /// bit and in any order.
    #[cfg(feature = "hull-tree")]
    pub fn with_hull_tree(mut self, tree: HullTree) -> Result<Self, HullTreeError> {
        self.hull_tree = Some(tree.renumber_leaves(&self.pieces)?);
        Ok(self)
    }

    /// Returns the body's pieces, in the order of the tree.
    pub fn pieces(&self) -> &Pieces {
        &self.pieces
    }

    /// Returns the piece with this index in `pieces`. A piece of many points has a search structure for extremal
    /// points.
    #[inline]
    pub(crate) fn piece(&self, index: u32) -> Piece<'_> {
        self.pieces
            .get(index as usize)
            .with_support_map(build_support_map)
    }

    /// Computes in advance, on all cores, the values that [`Piece::cached_value`] would compute when first requested.
    ///
    /// Searches for extremal points of hulls are prepared in advance as well. Values that exist already stay.
    ///
    /// # Guarantee
    /// The function `make` gets the pieces as oracles get them. Later requests for the type return these values.
    ///
    /// ```
    /// use ccd_core::{Body, Piece};
    /// struct Count(usize);
    /// let cube = Body::cuboid([1.0; 3])?;
    /// cube.precompute_cached_values(|piece| Count(piece.points.len()));
    /// let never = |_: &Piece| -> Count { unreachable!("it is there") };
    /// assert_eq!(cube.pieces().get(0).cached_value(never).map(|count| count.0), Some(8));
    /// # Ok::<(), ccd_core::InputError>(())
    /// ```
    pub fn precompute_cached_values<T: Any + Send + Sync>(
        &self,
        make: impl Fn(&Piece<'_>) -> T + Sync,
    ) {
        let mut pieces: Vec<Piece<'_>> = self.pieces.iter().collect();
        if let Some(surface) = &self.surface {
            pieces.extend(surface.triangulated_body.pieces.iter());
        }
        #[cfg(feature = "hull-tree")]
        if let Some(tree) = &self.hull_tree {
            pieces.extend(tree.hulls().iter());
        }
        parallel_for_each(&mut pieces, &(), |(), _, piece| {
            // Pieces in queries have this search, too.
            let _ = piece
                .with_support_map(build_support_map)
                .cached_value(&make);
        });
    }

    /// Returns an upper bound of the distance of any point of the body from the body's origin.
    ///
    /// ```
    /// let box_of_4 = ccd_core::Body::cuboid([2.0, 2.0, 1.0])?;
    /// assert!((box_of_4.bounding_radius() - 3.0).abs() < 1e-12);
    /// # Ok::<(), ccd_core::InputError>(())
    /// ```
    pub fn bounding_radius(&self) -> f64 {
        self.tree.max_distance_from_origin
    }

    /// Returns whether the body is a solid or a surface, so whether a body inside it counts as touching.
    pub fn solidity(&self) -> Solidity {
        self.solidity
    }

    /// Returns the body to use in a query against `other`: the triangulated surface, if there is one and `other` has
    /// many triangles. A box that is larger than the other body is not replaced: its triangles would hardly be nearer
    /// to anything than the box is.
    pub(crate) fn body_for_query_against(&self, other: &Body) -> &Body {
        let many = other.pieces.are_all_triangles() && other.pieces.len() > 1;
        let larger = self.tree.radius() >= other.tree.radius();
        match &self.surface {
            Some(surface) if many && !(larger && surface.fills_root_box) => {
                &surface.triangulated_body
            }
            _ => self,
        }
    }

    /// Returns whether the body has a [surface](Body::with_surface_triangles) of triangles beside its one piece.
    pub fn has_surface(&self) -> bool {
        self.surface.is_some()
    }

    /// Returns the hull tree over the body's pieces, if it has one. The leaves name [`Body::pieces`].
    #[cfg(feature = "hull-tree")]
    pub fn hull_tree(&self) -> Option<&HullTree> {
        self.hull_tree.as_ref()
    }

    /// Returns the approximate memory use in bytes.
    pub fn memory_usage(&self) -> usize {
        #[cfg(feature = "hull-tree")]
        let hulls = self.hull_tree.as_ref().map_or(0, HullTree::memory_usage);
        #[cfg(not(feature = "hull-tree"))]
        let hulls = 0;
        let surface = self.surface.as_ref();
        let surface = surface.map_or(0, |surface| surface.triangulated_body.memory_usage());
        self.pieces.memory_usage() + self.tree.memory_usage() + hulls + surface
    }

    /// Returns the mesh's vertex, edge or face that contains a point of a piece.
    ///
    /// A virtual facet may be within the surface, over faces of other pieces. If the piece has no
    /// feature for the point, these pieces are searched.
    pub(crate) fn feature(&self, piece: u32, point: &ConvexCombination) -> Feature {
        let feature = self.pieces.feature(piece as usize, point);
        let Feature::Piece(_) = feature else {
            return feature;
        };
        let at = point.position(self.pieces.get(piece as usize).points);
        at.and_then(|at| {
            let mut faces = polytopes_with_box_at(&self.tree, at)
                .map(|k| face_at(&self.pieces.get(k as usize), at));
            faces.find_map(|face| face)
        })
        .map_or(feature, Feature::Face)
    }

    /// Returns whether the body is a solid with a possibly empty space between its pieces, where another body might be.
    pub(crate) fn may_be_hollow(&self) -> bool {
        self.solidity == Solidity::Solid
            && (self.pieces.are_all_triangles() || self.pieces.len() > 1)
    }

    /// Returns the bounding volume tree over the pieces.
    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    /// Returns the extreme points of every connected part of the body, to test whether the part is inside another
    /// solid. If one of a part's points is inside another solid, the whole part is, or its surface crosses that of the
    /// solid.
    pub(crate) fn part_extreme_points(&self) -> &[ExtremePoints] {
        &self.part_extreme_points
    }
}

/// Builds the search structure for extremal points of a piece with many points.
#[cfg(not(feature = "hull-tree"))]
fn build_support_map(piece: &Piece<'_>) -> SupportMap {
    SupportMap::from_points(piece.points)
}

/// Returns six times the volume bounded by a closed surface of triangles; negative if their normals point inward.
fn sextuple_signed_volume(pieces: &Pieces) -> f64 {
    let cone = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).dot(a);
    (0..pieces.len()).map(|k| cone(pieces.triangle(k))).sum()
}

#[cfg(test)]
mod tests;
