//! Voronoi marching as a distance oracle.

use crate::certify::certify_march_end;
use crate::counters::Counters;
use crate::feature::Certainty;
use crate::march::march;
use crate::placed::PlacedPair;
use crate::polytope::Polytope;
use crate::start::Cache;
use crate::termination::MarchEnd;
use crate::witness::Witness;
use ccd_core::{Body, Claim, DistanceOracle, Effort, GiveUpReason, Piece, PiecePair};

/// An oracle for the distance of convex polytopes with known facets, by Voronoi marching `[LINCANNY91, VCLIP98]`.
///
/// A piece of a list ([`ccd_core::Pieces`]) is prepared at its first query, and stored with the list;
/// [`Vmarch::prepare`](DistanceOracle::prepare) prepares all pieces of a body ahead. A piece outside a list
/// ([`Piece::from_points`]) is prepared at every call. Pieces of up to three points, and those on one line, need no
/// facets.
///
/// # Guarantee
/// The guarantee of the crate. It gives up with [`GiveUpReason::BadFacets`] on pieces whose facets are missing, or are
/// not those of a convex polytope. In rare cases, rounding leads it in circles from several starts
/// ([`GiveUpReason::Cycle`], [`GiveUpReason::StepCap`]), or prevents certification ([`GiveUpReason::Uncertified`]):
/// never in a million pairs of this crate's own tests, but in 4 of 38,334 others. Combine it with
/// [another oracle](DistanceOracle::or_else).
///
/// # Complexity
/// From a warm [`Cache`] a step or two, each linear in the edges that meet in a corner, or around a
/// face, without allocation; from a cold one, about the root of the number of features. The search
/// for a common point inside visits all faces.
///
/// ```
/// use ccd_core::{glam::DVec3, DistanceOracle, Facet, Frame, FacetOrigin, PiecePair, Pieces, Polytope};
/// use ccd_distance_vmarch::{Cache, Vmarch};
/// let corner = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
/// let facet = |corners: [u32; 3]| Facet { origin: FacetOrigin::Virtual, corners: corners.to_vec() };
/// let tetrahedron = Polytope {
///     points: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
///     facets: corner.map(facet).to_vec(),
///     ..Polytope::default()
/// };
/// let pieces = Pieces::from_polytopes(&[tetrahedron])?;
/// let (mut oracle, mut cache) = (Vmarch::default(), Cache::default());
/// for height in [3.0, 2.9] {
///     let b_to_a = Frame { translation: height * DVec3::Z, ..Frame::IDENTITY };
///     let pair = PiecePair { a: pieces.get(0), b: pieces.get(0), b_to_a };
///     let claim = oracle.separation(&pair, &mut cache).unwrap();
///     assert_eq!(claim.a.position(pair.a.points), Some(DVec3::Z));
///     assert!(claim.axis.normalize().distance(DVec3::Z) < 1e-15);
/// }
/// // The second call found the nearest features where the first one left them.
/// let counters = oracle.counters();
/// assert!(counters.calls == 2 && counters.steps < 8);
/// # Ok::<(), ccd_core::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Vmarch {
    counters: Counters,
}

impl Vmarch {
    /// Returns the counters of the work, summed over all calls of this oracle.
    pub fn counters(&self) -> Counters {
        self.counters
    }
}

impl DistanceOracle for Vmarch {
    type Cache = Cache;

    #[inline]
    fn separation(
        &mut self,
        pair: &PiecePair<'_>,
        cache: &mut Cache,
    ) -> Result<Claim, GiveUpReason> {
        self.counters.calls += 1;
        let (mut own_a, mut own_b) = (None, None);
        let a = prepared_polytope(&pair.a, &mut own_a)?;
        let b = prepared_polytope(&pair.b, &mut own_b)?;
        let placed = PlacedPair::new(a, b, &pair.b_to_a);
        let end = march(&placed, cache.start_features(&placed), &mut self.counters);
        if let MarchEnd::Nearest(nearest, Certainty::Sure) = end {
            let claim = Witness::new(&placed, nearest).claim;
            cache.store(&placed, nearest, claim.axis);
            return Ok(claim);
        }
        let (pair, claim) = certify_march_end(&placed, end, &mut self.counters)?;
        cache.store(&placed, pair, claim.axis);
        Ok(claim)
    }

    /// Prepares all pieces of a body in advance, on all cores: those of the body, the hulls of its hull tree and the
    /// triangles of its surface. Otherwise the first query of each piece would prepare it.
    ///
    /// # Guarantee
    /// Answers are the same bits with and without it. A piece that cannot be prepared is given up at each query, as
    /// without preparation.
    ///
    /// # Complexity
    /// n log n of the corners of all facets. Measured on a mesh of 26,000 triangles in 6,459 patches: 0.08 s
    /// and 26 MB for the patches; 0.7 s and 130 MB with the 12,917 hulls of their tree, whose file of
    /// 4.8 MB loads in 0.15 s.
    ///
    /// Files do not store prepared pieces: they would be more than twenty times as long. Reading and decoding that many
    /// bytes alone takes 0.16 s, before anything is checked.
    ///
    /// ```
    /// use ccd_core::{glam::DVec3, Body, DistanceOracle, Frame, PiecePair};
    /// use ccd_distance_vmarch::{Cache, Vmarch};
    /// let cube = Body::cuboid([1.0; 3])?;
    /// Vmarch::prepare(&cube);
    /// let piece = cube.pieces().get(0);
    /// let b_to_a = Frame { translation: 3.0 * DVec3::Z, ..Frame::IDENTITY };
    /// let pair = PiecePair { a: piece, b: piece, b_to_a };
    /// // The first query finds the piece prepared.
    /// let claim = Vmarch::default().separation(&pair, &mut Cache::default()).unwrap();
    /// assert_eq!(claim.axis, DVec3::Z);
    /// # Ok::<(), ccd_core::InputError>(())
    /// ```
    fn prepare(body: &Body) {
        body.precompute_cached_values(prepare_piece);
    }

    fn effort(&self) -> Effort {
        Effort {
            steps: self.counters.steps,
            cycle_count: self.counters.detected_cycles,
            fallbacks: 0,
        }
    }
}

/// A prepared piece, or the reason why its preparation failed.
type PreparationResult = Box<Result<Polytope, GiveUpReason>>;

fn prepare_piece(piece: &Piece<'_>) -> PreparationResult {
    Box::new(Polytope::new(piece))
}

/// Returns a piece as a polytope prepared for marching, or the reason why its preparation failed. A piece that belongs
/// to no list is prepared now, and stored in `own`.
#[inline]
fn prepared_polytope<'p>(
    piece: &Piece<'p>,
    own: &'p mut Option<PreparationResult>,
) -> Result<&'p Polytope, GiveUpReason> {
    let prepared = match piece.cached_value(prepare_piece) {
        Some(kept) => kept,
        None => own.insert(prepare_piece(piece)),
    };
    prepared.as_ref().as_ref().map_err(|why| *why)
}
