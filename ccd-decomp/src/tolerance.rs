//! Tuning constants of this crate, with unit and effect: another value costs time, memory or quality, never
//! correctness. The bounds on rounding are in `rounding.rs`.

mod rounding;

pub(crate) use rounding::*;

/// The search distance along a Morton curve for the nearest neighbour of a cluster, in agglomeration.
///
/// Unit: places. Larger: slower to build. With 16, or with exact nearest neighbours, queries took no fewer visits.
pub(crate) const MORTON_SEARCH_RADIUS: usize = 8;

/// How far the centers are moved along each coordinate for each further Morton curve. What is near in space is near along one of
/// the curves: multiples of a third are not on borders of large cells together.
///
/// Unit: the size of all pieces. With one curve and 32 places, queries took 3 % more visits in the mean (knots 4 to 7 %), and
/// agglomeration took a sixth longer; with two curves and 16 places, 0.5 %.
pub(crate) const MORTON_SHIFTS: [f64; 2] = [1.0 / 3.0, 2.0 / 3.0];

/// The least share of clusters that a pass of agglomeration merges. If fewer are each other's nearest neighbours, those that are
/// next to each other on the curve are merged.
///
/// Unit: one. Larger: fewer passes, and worse trees.
pub(crate) const MIN_MERGED_SHARE: f32 = 0.125;

/// The distance between vertices on open edges up to which a report says that joining them closes the mesh. It changes no body.
///
/// Unit: the size of the mesh. Seams of round surfaces that are computed with sines are open by a rounding of 64-bit or 32-bit
/// floats.
pub(crate) const JOINING_DISTANCE_PER_SIZE: f64 = 1e-6;

/// The number of rays from a shell after which its nesting counts as unknown.
///
/// Unit: rays. A ray meets an edge only by accident.
pub(crate) const MAX_NESTING_RAYS: usize = 16;

/// The number of polygons at which a patch stops growing.
///
/// Unit: polygons. Growing takes time that grows with their square, and an oracle takes time that
/// grows with a piece's corners: queries on two knots of 11,520 triangles took a median of 127, 168,
/// 163, 158, 255 µs with patches of up to 16, 32, 64, 128, 1024 polygons, which were 910, 492, 324,
/// 292, 258.
pub(crate) const MAX_PATCH_POLYGONS: usize = 48;

/// The maximum number of corners of a patch of several polygons. A larger polygon is a separate patch.
///
/// Unit: corners. A polygon is tested with all facets of a patch, and so is every triangle near it: the time of
/// growing increases with their square. Twice as many as 48 polygons of a sphere have.
pub(crate) const MAX_PATCH_CORNERS: usize = 256;

/// The least fraction of a node's pieces in each child of a hull tree. If a split gives less, it is at the median.
///
/// Unit: one. At 1/8 a tree of n pieces is at most `log n / log (8/7)` deep: 104 for a million.
pub(crate) const MIN_CHILD_SHARE: f64 = 1.0 / 8.0;

/// The maximum number of iterations for the eigenvectors of a 3 × 3 matrix.
///
/// Unit: rounds. A handful suffice; without convergence a node is split along x.
pub(crate) const MAX_EIGEN_ITERATIONS: usize = 256;

/// The work budget of the search for a bound on the excess of a hull.
///
/// Unit: boxes and triangles examined in searches, of 10 to 50 ns: half a second's work.
pub(crate) const EXCESS_WORK_BUDGET: u64 = 3 << 23;

/// The number of plane tests that cost as much as one triangle test, which is one step of [`EXCESS_WORK_BUDGET`].
pub(crate) const PLANE_TESTS_PER_STEP: usize = 16;

/// The maximum number of waiting boxes in the search for a bound on the excess of a hull.
///
/// Unit: boxes, of about 130 bytes each. Most meshes spend the work on fewer. On a mesh of two triangles a box takes
/// only a few steps: millions of them took hundreds of megabytes.
pub(crate) const MAX_EXCESS_BOXES: usize = 1 << 19;

/// The search for a bound on the excess ends when the bound is at most this multiple of the largest distance found.
pub(crate) const SUFFICIENT_EXCESS_RATIO: f64 = 1.01;

/// The search for a bound on the excess ends when the bound exceeds the largest distance found by at most this, in
/// units of half the mesh's diagonal. Either this or [`SUFFICIENT_EXCESS_RATIO`] suffices.
pub(crate) const EXCESS_TOLERANCE_PER_HALF_DIAGONAL: f64 = 1e-4;

/// The maximum number of triangles near a box that are used to bound the excess within the box.
pub(crate) const MAX_NEARBY_TRIANGLES: usize = 64;

/// The measured time of queries with one kind of pieces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QueryCost {
    /// The median time of a query against a body of many triangles, in µs. The same time is assumed for any number of
    /// pieces.
    pub(crate) median_query_time: f64,
    /// The time that a query takes for each piece of a plane that rests flat on another body, in µs.
    pub(crate) time_per_resting_piece: f64,
}

/// The measured time of queries with triangles as pieces.
///
/// Measured on a perforated plate (coarse and fine), an L-prism, a comb and a gear of 460 to 7,452
/// triangles against a ring of 10,000: medians of 22, 23, 24, 20, 38 µs. Laid flat on themselves, to a
/// tolerance of 1e-9, about 1 to 13 µs for every triangle of the plane.
pub(crate) const TRIANGLE_QUERY_COST: QueryCost = QueryCost {
    median_query_time: 23.0,
    time_per_resting_piece: 5.0,
};

/// The measured time of queries with patches as pieces.
///
/// A query takes 2.4 times as long with patches, the median of random pairs of parts of real robots
/// (`ccd-bench/scripts/pieces.py`; a third to 600 times); and about 4 to 10 µs for every patch of a plane
/// laid flat.
pub(crate) const PATCH_QUERY_COST: QueryCost = QueryCost {
    median_query_time: 55.0,
    time_per_resting_piece: 6.0,
};

/// The assumed fraction of queries in which bodies rest flat on each other, so that all pieces of a plane are
/// examined. It is a guess: with it, patches are chosen from about three hundred triangles in one plane on.
pub(crate) const RESTING_QUERY_FREQUENCY: f64 = 1.0 / 50.0;

/// The number of bins per doubling of the length, into which edges are sorted by length. Edges in one bin count as
/// equally long, so that rounding does not separate the edges of a grid.
pub(crate) const BINS_PER_LENGTH_DOUBLING: f64 = 16.0;

/// The number of bins per unit of each coordinate of a unit vector, into which edges are sorted by direction.
pub(crate) const DIRECTION_BINS_PER_UNIT: f64 = 64.0;

/// The minimum number of pieces for which the two sides of a hull tree node are built in parallel.
///
/// Unit: pieces. Fewer: tasks cost more than they gain. More: a core idles at the end.
pub(crate) const MIN_PARALLEL_PIECES: usize = 256;

/// The maximum number of piece centers from which the split axis of a hull tree node is computed.
///
/// Unit: pieces. Larger: hardly better axes; the hulls of 1,024 centers at all nodes took as long as the
/// tree's own.
pub(crate) const MAX_SPREAD_SAMPLES: usize = 64;

/// The minimum number of triangles that share a vertex for them to be searched as a fan.
///
/// Unit: triangles. The boxes of fewer triangles also overlap, but are few.
pub(crate) const MIN_FAN_TRIANGLES: u32 = 32;

/// How many boxes of a tree have to meet a shape's axis-aligned box before the oriented boxes are tested too.
///
/// Unit: boxes. A smaller value is slower for triangles that are not slivers.
pub(crate) const BOXES_BEFORE_ORIENTED_TESTS: usize = 32;

/// The maximum number of pairs of intersecting faces in a report.
///
/// Unit: pairs. The fan of a non-convex polygon may have as many as the square of its corners.
pub(crate) const MAX_CROSSINGS: usize = 1000;

/// The work budget of `PieceChoice::Auto` for checking that a mesh bounds a solid, and for making patches.
///
/// Unit: exact predicates, about, of 10 to 40 ns: half a second at most.
pub(crate) const AUTO_WORK_BUDGET: u64 = 1 << 24;

/// The cost of a vertex that a file expands to, in units of the cost of a face corner, which takes about 25 bytes.
pub(crate) const VERTEX_EXPANSION_COST: u64 = 4;

/// The constant part of the limit on what a file may expand to by repeated references, in face corners.
///
/// Unit: the cost of a corner, and of a part. More: a hostile file of a kilobyte takes more memory. Fewer: small
/// files with many instances are refused.
pub(crate) const BASE_FILE_EXPANSION_LIMIT: u64 = 1 << 20;

/// The part of the limit on what a file may expand to that is proportional to its size, per byte. An assembly of
/// 1,000 screws of 1,000 triangles takes about 50.
pub(crate) const EXPANSION_LIMIT_PER_BYTE: u64 = 1 << 8;

/// The largest limit on what a file of any size may expand to: about ten million triangles, which take up to 3 GB to
/// prepare.
pub(crate) const MAX_EXPANDED_ELEMENT_COUNT: u64 = 1 << 25;

#[cfg(test)]
mod tests;
