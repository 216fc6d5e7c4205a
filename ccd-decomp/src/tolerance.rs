//! Every number of this crate that is a choice rather than a consequence: its unit, and what it buys.

use ccd_core::glam::DVec3;
use ccd_core::tolerance::U64;

/// Below this many pieces a hierarchy is agglomerated, above it is split at medians.
///
/// Unit: pieces. Larger: better trees by a few percent, but pieces with one common centre take time
/// that grows with it.
pub(crate) const AGGLOMERATED_PIECES: usize = 256;

/// After so many passes of agglomeration a node looks for its neighbour farther than one place away.
///
/// Unit: passes. Fewer: slower, hardly better trees.
pub(crate) const SEARCH_DEPTH: usize = 2;

/// The share of the nodes, the largest first, that are tried at a better place in the tree.
///
/// Unit: one. Larger: better trees by a percent for every doubling, but slower to build.
pub(crate) const REINSERTED_SHARE: f32 = 0.02;

/// Rays that are tried from a shell of a mesh before it is given up to know what is around it.
///
/// Unit: rays. Each one grazes an edge only by accident.
pub(crate) const RAY_TRIES: usize = 16;

/// How far on either side of a face no other shell may be for the face's middle to tell what is around it, in
/// units of the mesh's size. Rounding takes the middle off the face by 8 [`U64`] at most, and the face's normal
/// is right to a hundredth even of needles of an aspect of 1e6.
pub(crate) const FACE_ROUNDING: f64 = 1e-12;

/// A patch grows no further beyond so many polygons.
///
/// Unit: polygons. Growing takes time that grows with their square, and an oracle takes time that
/// grows with a piece's corners: queries on two knots of 11,520 triangles took a median of 127, 168,
/// 163, 158, 255 µs with patches of up to 16, 32, 64, 128, 1024 polygons, which were 910, 492, 324,
/// 292, 258.
pub(crate) const PATCH_POLYGONS: usize = 48;

/// A patch takes no polygon that would give it more corners than this; a polygon of more is a patch by
/// itself.
///
/// Unit: corners. A polygon is held against all facets of a patch, and so is every triangle near it: the
/// time that growing takes increases with their square. Twice as many as 48 polygons of a sphere have.
pub(crate) const PATCH_CORNERS: usize = 256;

/// The least share of its pieces that a node of a hull tree leaves to either child; otherwise it is
/// split at the median.
///
/// Unit: one. At 1/8 a tree of n pieces is at most `log n / log (8/7)` deep: 104 for a million.
pub(crate) const LEAST_SHARE: f64 = 1.0 / 8.0;

/// The cap on the rounds in which the eigenvectors of a 3 × 3 matrix are found.
///
/// Unit: rounds. A handful suffice; without an answer a node is split along x.
pub(crate) const EIGEN_ROUNDS: usize = 256;

/// Bounds how far cutting a polygon to a cube moves any point of it, when no coordinate exceeds
/// `farthest`; in its unit of length. A grid of 128 layers is halved at most 21 times.
///
/// With `u` half a unit in the last place and `m` the farthest coordinate: at each cut, the share of an
/// edge is right to `3u`, which moves a point by `2√3 · 3u m`, the edge's direction and the product by
/// `2√3 · u m` each, the sum by `√3 u m`: less than 20u, 420u for 21 of them. Points that are left out
/// as they are between two others on an edge are off by twice [`on_edge`] more for each of three edges:
/// 804u. 1024u are taken. Cubes are widened by as much, so that what is cut off at one is left at the next.
pub(crate) fn clip_rounding(farthest: f64) -> f64 {
    1024.0 * U64 * farthest
}

/// The distance from an edge's line up to which a point that was cut from it counts as on it, when no
/// coordinate exceeds `farthest`; in its unit of length. One cut moves a point by less than a third of it.
pub(crate) fn on_edge(farthest: f64) -> f64 {
    64.0 * U64 * farthest
}

/// Bounds the error of the length of a difference of points along a direction, and of how far a box of
/// [oriented box](crate::search) goes along it, when no coordinate exceeds `reach`; in its unit of
/// length, for a direction about as long as 1.
///
/// With `u` half a unit in the last place, `d` the sum of the direction's coordinates and `m` the reach: a
/// difference is off by `2u m` in every coordinate and its length along the direction by `8u d m`; twice, as
/// there is one of the box and one of the shape. The box's half lengths are at most `2√3 m`, and each is
/// taken along the direction to `4u d`: `42u d m`. Their sums round by `12u d m`. That is 70u; 128u are
/// taken, and what may underflow.
pub(crate) fn box_rounding(direction: DVec3, reach: f64) -> f64 {
    128.0 * U64 * direction.abs().element_sum() * reach + f64::MIN_POSITIVE
}

/// Bounds the error of the sum of so many products `a · (b × c)` of rounded differences of points, when
/// `size` is the sum of `|a| |b| |c|` and what each addition rounds off is added up beside it; in the
/// unit of the products.
///
/// With `u` half a unit in the last place: of the six products of three coordinates each comes from three
/// differences, and is rounded twice and added up four times: to 9u. Their sizes add up to at most
/// `√3 |a| |b| |c|`: 16u of the size. A compensated sum of `n` terms is off by `u` of itself and `2 n² u²` of
/// their sizes. The size is right to `(n + 16) u` of itself. 32u are taken, and what grows with `n²`.
pub(crate) fn volume_rounding(size: f64, terms: f64) -> f64 {
    (32.0 + 4.0 * terms * (terms * U64)) * U64 * size
}

/// Voxels along a mesh's longest side when it is to be approximated by so many hulls.
///
/// Finer ones place the cuts between the hulls better, at a cost of their cube. Measured on a knot, a
/// ring and a bunny: 128 for 64 gains a tenth of the error and costs four times the time.
pub(crate) fn voxel_resolution(hulls: u32) -> u32 {
    if hulls <= 32 { 64 } else { 96 }
}

/// The coarsest grid that is of any use; unit: voxels.
pub(crate) const LEAST_RESOLUTION: u32 = 8;

/// How many pairs of a triangle and a voxel in its box may be looked at: a third of a second's work.
pub(crate) const VOXELS_TESTED: usize = 1 << 21;

/// The least size of a voxel in units of what cutting at it may be off by.
pub(crate) const COARSE_VOXELS: f64 = 1024.0;

/// The share of the whole hull's volume by which a part's hull may exceed the part before it is split.
/// Smaller: all hulls that are asked for are used on what is nearly convex as well.
pub(crate) const CONCAVITY: f64 = 1e-6;

/// What an uneven cut costs V-HACD, in shares of the concavity. Measured on a bunny with 128 hulls: they
/// stick out by a quarter less than at the library's own 0.05; of a knot and a ring it makes no odds.
pub(crate) const BALANCE: f64 = 0.5;

/// How many parts to ask the library for per hull; the best are merged. Measured: one makes 32 hulls of a
/// knot stick out by two thirds more, four hardly less.
pub(crate) const PARTS_PER_HULL: u32 = 2;

/// The most parts to ask the library for: merging takes time that grows with their cube.
pub(crate) const MOST_PARTS: u32 = 512;

/// Up to so many points of a part tell what merging it with another one costs.
///
/// Unit: points. At most half of [`LIKELY_POINTS`]. More: hardly better choices, and time that grows with
/// their square.
pub(crate) const PRICED_POINTS: u32 = 96;

/// Hulls that may stick out by more than this, in units of half the mesh's diagonal, are refused.
pub(crate) const TOO_COARSE: f64 = 0.5;

/// What a distance to the nearest triangle may be off by, in units of half the mesh's diagonal.
/// Rounding comes to 1e-15 of well-shaped triangles, and to this of needles of an aspect of 1e6.
pub(crate) const NEAREST_SLACK: f64 = 1e-9;

/// A facet's plane is used when its sine at a corner is above this: its normal is then right to
/// `4 U64 / 1e-6`, less than [`NEAREST_SLACK`].
pub(crate) const WELL_SHAPED: f64 = 1e-6;

/// What is spent, at most, on how far hulls stick out.
///
/// Unit: boxes and triangles looked at in searches, of 10 to 50 ns: half a second's work.
pub(crate) const EXCESS_WORK: u64 = 3 << 23;

/// The bound on how far hulls stick out is improved until it is within this ratio of what was found …
pub(crate) const EXCESS_RATIO: f64 = 1.01;

/// … or within this, in units of half the mesh's diagonal.
pub(crate) const EXCESS_FLOOR: f64 = 1e-4;

/// Up to so many triangles near a box are looked at to bound how far a part sticks out in it.
pub(crate) const TRIANGLES_UNDER: usize = 64;

/// What queries take over one kind of pieces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceCost {
    /// The median, against a body of many triangles, whatever the number of pieces. Unit: µs.
    pub(crate) usual: f64,
    /// For every piece of a plane that rests flat on another one. Unit: µs.
    pub(crate) resting: f64,
}

/// Measured on a perforated plate (coarse and fine), an L-prism, a comb and a gear of 460 to 7,452
/// triangles against a ring of 10,000: medians of 22, 23, 24, 20, 38 µs. Laid flat on themselves, to a
/// tolerance of 1e-9, about 1 to 13 µs for every triangle of the plane.
pub(crate) const TRIANGLES: PieceCost = PieceCost {
    usual: 23.0,
    resting: 5.0,
};

/// A query takes 2.4 times as long over patches, the median of random pairs of parts of real robots
/// (`ccd-bench/scripts/pieces.py`; a third to 600 times); and about 4 to 10 µs for every patch of a plane
/// laid flat.
pub(crate) const PATCHES: PieceCost = PieceCost {
    usual: 55.0,
    resting: 6.0,
};

/// In how many of all queries bodies are taken to come to rest flat on each other, to a tolerance so
/// small that all pieces of the plane are looked at. Unit: one. A guess: the larger, the sooner patches
/// are chosen; at this value they are from about three hundred triangles in one plane on.
pub(crate) const FLAT_SHARE: f64 = 1.0 / 50.0;

/// Edges within a plane count as equally long when they are in one of so many classes for each doubling
/// of the length: rounding must not tell the edges of a grid apart.
pub(crate) const LENGTHS: f64 = 16.0;

/// The same of directions: one unit of a direction's coordinates is in so many classes.
pub(crate) const DIRECTIONS: f64 = 64.0;

/// Up to so many points their hull is the library's, if that can be proven.
///
/// Unit: points. The library takes time and memory that grow with their square: a hull of 625 corners
/// on a circle and two on its axis took it 380 MB.
pub(crate) const LIBRARY_POINTS: usize = 64;

/// The hull of up to so many points is grown by holding each of them against all facets.
///
/// Unit: points. More: the time grows with their square; fewer: the library takes three to ten times as
/// long over them, and fails on many that are coplanar.
pub(crate) const FEW_POINTS: usize = 32;

/// From so many pieces on the two sides of a node of a hull tree are built beside each other.
///
/// Unit: pieces. Fewer: handing over takes as long as the work; more: a core waits at the end.
pub(crate) const SIDE_BY_SIDE: usize = 256;

/// Of so many pieces at most the centres tell along which axis a node of a hull tree is split.
///
/// Unit: pieces. Larger: hardly better axes; the hulls of 1,024 centres at all nodes took as long as the
/// tree's own.
pub(crate) const SPREAD_PIECES: usize = 64;

/// From so many triangles about one vertex on they are searched as a fan.
///
/// Unit: triangles. Boxes of fewer meet each other all, but these are few.
pub(crate) const FAN_TRIANGLES: u32 = 32;

/// So many boxes of triangles along the coordinate axes may meet that of a shape before the shape itself is
/// held against them.
///
/// Unit: boxes. Fewer: slower for triangles that are no slivers, which hardly ever come to so many.
pub(crate) const BOXES_MET: usize = 32;

/// So many pairs of faces that intersect are counted before the search for more ends.
///
/// Unit: pairs. The fan of a polygon that is not convex has as many as the square of its corners.
pub(crate) const CROSSINGS: usize = 1000;

/// What `auto` spends on finding out whether patches are exact, and on making them.
///
/// Unit: exact predicates, about, of 10 to 40 ns: half a second at most.
pub(crate) const AUTO_WORK: u64 = 1 << 24;

/// Up to so many points a hull that serves to compare volumes is the library's, right or wrong.
///
/// Unit: points. At this many the library's memory peaks at 60 MB.
pub(crate) const LIKELY_POINTS: usize = 256;
