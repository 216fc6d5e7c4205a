//! Lists of polygons, stored contiguously.

/// A list of polygons, for example the facets of a [hull](super::Hull). Each is a loop of indices into a list of
/// points.
///
/// ```
/// use ccd_core::PolygonList;
/// let tetrahedron = PolygonList::from_iter([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
/// assert_eq!(tetrahedron.len(), 4);
/// assert_eq!(tetrahedron.get(2), Some(&[1, 2, 3][..]));
/// assert!(tetrahedron.iter().all(|corners| corners.len() == 3));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Vec<Vec<u32>>"))]
pub struct PolygonList {
    corners: Vec<u32>,
    /// The end of each polygon's corners in `corners`.
    ends: Vec<usize>,
}

impl PolygonList {
    /// Creates an empty list with capacity for this many polygons, and this many corners in total.
    pub fn with_capacity(loops: usize, corners: usize) -> Self {
        PolygonList {
            corners: Vec::with_capacity(corners),
            ends: Vec::with_capacity(loops),
        }
    }

    /// Adds a polygon, given by its corners, at the end of the list.
    pub fn push(&mut self, corners: &[u32]) {
        self.corners.extend_from_slice(corners);
        self.ends.push(self.corners.len());
    }

    /// Returns the number of polygons.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns whether the list has no polygons.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Returns the corners of polygon `k`; `None` if there are fewer polygons.
    pub fn get(&self, k: usize) -> Option<&[u32]> {
        let end = *self.ends.get(k)?;
        let start = if k == 0 { 0 } else { self.ends[k - 1] };
        Some(&self.corners[start..end])
    }

    /// Returns the corners of each polygon.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> + DoubleEndedIterator + Clone {
        (0..self.len()).map(|k| self.get(k).unwrap_or_default())
    }

    /// Returns the corners of all polygons, one after the other.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// Returns the corners of all polygons, one after the other, so that a caller can renumber them.
    pub fn corners_mut(&mut self) -> &mut [u32] {
        &mut self.corners
    }
}

impl<L: AsRef<[u32]>> FromIterator<L> for PolygonList {
    fn from_iter<I: IntoIterator<Item = L>>(iter: I) -> Self {
        let mut loops = PolygonList::default();
        for corners in iter {
            loops.push(corners.as_ref());
        }
        loops
    }
}

impl From<Vec<Vec<u32>>> for PolygonList {
    fn from(loops: Vec<Vec<u32>>) -> Self {
        loops.into_iter().collect()
    }
}

/// Serialises the polygons as a list of lists.
#[cfg(feature = "serde")]
impl serde::Serialize for PolygonList {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

#[cfg(test)]
mod tests;
