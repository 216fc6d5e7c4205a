//! Caches bodies by their geometry.

use crate::geometry::ShapeGeometry;
use crate::limits::{MAX_CACHED_BODIES, MAX_CACHED_BYTES};
use crate::{BodyOfShape, ShapeError};
use std::sync::Arc;

/// A cache of the most recently used bodies, for shapes that no `Caster` holds.
///
/// A body is found by its geometry, of which all numbers are compared. So a body is never used for another shape.
#[derive(Debug)]
pub(crate) struct BodyCache {
    /// The cached bodies, the most recently used one last.
    bodies: Vec<CachedBody>,
    /// The maximum memory of all cached bodies, in bytes.
    max_bytes: usize,
}

impl Default for BodyCache {
    fn default() -> Self {
        BodyCache {
            bodies: Vec::new(),
            max_bytes: MAX_CACHED_BYTES,
        }
    }
}

#[derive(Debug)]
struct CachedBody {
    geometry: ShapeGeometry,
    body: Arc<BodyOfShape>,
    bytes: usize,
}

impl BodyCache {
    /// Returns the body of a geometry from the cache, or makes the body and caches it.
    pub(crate) fn body(&mut self, geometry: ShapeGeometry) -> Result<Arc<BodyOfShape>, ShapeError> {
        if let Some(index) = self
            .bodies
            .iter()
            .rposition(|cached| cached.geometry == geometry)
        {
            self.bodies[index..].rotate_left(1);
            let last = self.bodies.last().map(|cached| Arc::clone(&cached.body));
            return last.map_or_else(|| BodyOfShape::new(&geometry).map(Arc::new), Ok);
        }
        let body = Arc::new(BodyOfShape::new(&geometry)?);
        let bytes = body.memory_usage() + geometry.memory_usage();
        self.evict_until_fits(bytes);
        if bytes <= self.max_bytes {
            self.bodies.push(CachedBody {
                geometry,
                body: Arc::clone(&body),
                bytes,
            });
        }
        Ok(body)
    }

    /// Removes the least recently used bodies until a body of `bytes` fits into the cache.
    fn evict_until_fits(&mut self, bytes: usize) {
        let mut used_bytes: usize = self.bodies.iter().map(|cached| cached.bytes).sum();
        let mut evicted_count = 0;
        while evicted_count < self.bodies.len()
            && (used_bytes + bytes > self.max_bytes
                || self.bodies.len() - evicted_count >= MAX_CACHED_BODIES)
        {
            used_bytes -= self.bodies[evicted_count].bytes;
            evicted_count += 1;
        }
        self.bodies.drain(..evicted_count);
    }

    #[cfg(test)]
    pub(crate) fn len(&self) -> usize {
        self.bodies.len()
    }
}

#[cfg(test)]
mod tests;
