//! Caches bodies by their geometry.

use crate::form::ShapeGeometry;
use crate::limits::{MAX_CACHED_BODIES, MAX_CACHED_BYTES};
use crate::{BodyOfShape, ShapeError};
use std::sync::Arc;

/// A cache of the most recently used bodies, for shapes that no `Caster` holds.
///
/// A body is found by its geometry, number by number: no other shape is ever taken for it.
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
    pub(crate) fn body(&mut self, form: ShapeGeometry) -> Result<Arc<BodyOfShape>, ShapeError> {
        if let Some(at) = self.bodies.iter().rposition(|kept| kept.geometry == form) {
            self.bodies[at..].rotate_left(1);
            let last = self.bodies.last().map(|kept| Arc::clone(&kept.body));
            return last.map_or_else(|| BodyOfShape::new(&form).map(Arc::new), Ok);
        }
        let body = Arc::new(BodyOfShape::new(&form)?);
        let bytes = body.memory_usage() + form.memory_usage();
        self.evict_until_fits(bytes);
        if bytes <= self.max_bytes {
            self.bodies.push(CachedBody {
                geometry: form,
                body: Arc::clone(&body),
                bytes,
            });
        }
        Ok(body)
    }

    /// Removes the least recently used bodies until a body of `bytes` fits into the cache.
    fn evict_until_fits(&mut self, bytes: usize) {
        let mut held: usize = self.bodies.iter().map(|kept| kept.bytes).sum();
        let mut gone = 0;
        while gone < self.bodies.len()
            && (held + bytes > self.max_bytes || self.bodies.len() - gone >= MAX_CACHED_BODIES)
        {
            held -= self.bodies[gone].bytes;
            gone += 1;
        }
        self.bodies.drain(..gone);
    }

    #[cfg(test)]
    pub(crate) fn len(&self) -> usize {
        self.bodies.len()
    }
}

#[cfg(test)]
mod tests;
