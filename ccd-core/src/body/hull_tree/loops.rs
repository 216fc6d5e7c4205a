//! Loops of corners, flat in memory.

/// Loops of corners, such as the facets of a [hull](super::Hull), each by indices into a list of points.
///
/// ```
/// use ccd_core::Loops;
/// let tetrahedron = Loops::from_iter([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
/// assert_eq!(tetrahedron.len(), 4);
/// assert_eq!(tetrahedron.get(2), Some(&[1, 2, 3][..]));
/// assert!(tetrahedron.iter().all(|corners| corners.len() == 3));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Vec<Vec<u32>>"))]
pub struct Loops {
    corners: Vec<u32>,
    /// The end of each loop.
    ends: Vec<usize>,
}

impl Loops {
    /// Creates an empty list with capacity for this many loops, with this many corners in all.
    pub fn with_capacity(loops: usize, corners: usize) -> Self {
        Loops {
            corners: Vec::with_capacity(corners),
            ends: Vec::with_capacity(loops),
        }
    }

    /// Adds a loop.
    pub fn push(&mut self, corners: &[u32]) {
        self.corners.extend_from_slice(corners);
        self.ends.push(self.corners.len());
    }

    /// Returns the number of loops.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns whether there are no loops.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Returns one loop.
    pub fn get(&self, k: usize) -> Option<&[u32]> {
        let end = *self.ends.get(k)?;
        let start = if k == 0 { 0 } else { self.ends[k - 1] };
        Some(&self.corners[start..end])
    }

    /// Returns the loops in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> + DoubleEndedIterator + Clone {
        (0..self.len()).map(|k| self.get(k).unwrap_or_default())
    }

    /// Returns the corners of all loops in order.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// Returns the corners of all loops, to be renumbered.
    pub fn corners_mut(&mut self) -> &mut [u32] {
        &mut self.corners
    }
}

impl<L: AsRef<[u32]>> FromIterator<L> for Loops {
    fn from_iter<I: IntoIterator<Item = L>>(iter: I) -> Self {
        let mut loops = Loops::default();
        for corners in iter {
            loops.push(corners.as_ref());
        }
        loops
    }
}

impl From<Vec<Vec<u32>>> for Loops {
    fn from(loops: Vec<Vec<u32>>) -> Self {
        loops.into_iter().collect()
    }
}

/// Serialises as a list of lists.
#[cfg(feature = "serde")]
impl serde::Serialize for Loops {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

#[cfg(test)]
mod tests;
