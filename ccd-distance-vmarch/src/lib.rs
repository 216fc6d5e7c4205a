//! Voronoi marching: the distance backend of the Lin-Canny and V-Clip family, for
//! [`ccd_core`]'s convex pieces with known facets.
//!
//! **Empty so far.** The crate fixes the place where the backend will stand: it will implement
//! [`ccd_core::DistanceOracle`] over [`ccd_core::Facets`], keep the last pair of closest features
//! between calls, detect cycles, and give up with a typed reason so that another backend can take
//! over through [`ccd_core::OrElse`]. Until then use the backends of `ccd-distance-gjk`.
