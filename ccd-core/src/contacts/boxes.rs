//! Trees of axis-aligned boxes over the faces of pieces, to find the faces of two pieces that are near each other.

use super::skin::NearSurface;
use glam::DVec3;
use std::collections::HashMap;
use std::ops::Range;

/// The box trees over the faces of one body's pieces, one tree per piece. Each tree is built when its piece is first
/// requested: a piece of many faces may be near many others, and is sorted only once.
#[derive(Default)]
pub(super) struct FaceTrees {
    nodes: Vec<FaceBox>,
    roots_by_piece: HashMap<u32, u32>,
}

/// An axis-aligned box in A's frame that contains faces, rounding radius included.
#[derive(Clone, Copy)]
struct FaceBox {
    low: DVec3,
    high: DVec3,
    content: FaceBoxContent,
}

#[derive(Clone, Copy)]
enum FaceBoxContent {
    MeshFace(u32),
    /// An inner node: its first child is the next node in the list, its second child has this index.
    Inner(u32),
}

/// The pairs of near faces found so far, with the remaining budget of the search.
pub(super) struct NearFacePairSearch {
    pub(super) face_pairs: Vec<[u32; 2]>,
    pub(super) remaining_budget: u64,
    pub(super) reach: f64,
}

impl NearFacePairSearch {
    /// Adds the pairs of a face of A and a face of B below two roots whose boxes are no farther apart than `reach`.
    /// Returns `None` if the budget is spent.
    pub(super) fn add_pairs_below_roots(
        &mut self,
        trees: &[FaceTrees; 2],
        roots: [u32; 2],
    ) -> Option<()> {
        let mut stack = vec![roots];
        while let Some([at_a, at_b]) = stack.pop() {
            let (a, b) = (trees[0].get(at_a), trees[1].get(at_b));
            if a.is_farther_apart(b, self.reach) {
                continue;
            }
            self.remaining_budget = self.remaining_budget.checked_sub(1)?;
            match (a.content, b.content) {
                (FaceBoxContent::MeshFace(face_a), FaceBoxContent::MeshFace(face_b)) => {
                    self.face_pairs.push([face_a, face_b]);
                }
                (FaceBoxContent::Inner(right), FaceBoxContent::MeshFace(_)) => {
                    stack.extend([[right, at_b], [at_a + 1, at_b]]);
                }
                (FaceBoxContent::Inner(right), FaceBoxContent::Inner(_))
                    if a.longest_side_length() >= b.longest_side_length() =>
                {
                    stack.extend([[right, at_b], [at_a + 1, at_b]]);
                }
                (_, FaceBoxContent::Inner(right)) => {
                    stack.extend([[at_a, right], [at_a, at_b + 1]]);
                }
            }
        }
        Some(())
    }
}

impl FaceTrees {
    /// Builds a single box tree over all faces of a surface, for searches by a point.
    pub(super) fn over_all_faces(skin: &NearSurface<'_>) -> Self {
        let mut trees = FaceTrees::default();
        trees.add_tree_over(skin, skin.face_indices());
        trees
    }

    /// Returns the faces whose boxes are within `reach` of a point; only the first tree is searched.
    pub(super) fn faces_near(&self, at: DVec3, reach: f64) -> Vec<u32> {
        let point = FaceBox {
            low: at,
            high: at,
            content: FaceBoxContent::MeshFace(0),
        };
        let mut near = Vec::new();
        let root = (!self.nodes.is_empty()).then_some(0);
        let mut stack = Vec::from_iter(root);
        while let Some(id) = stack.pop() {
            let node = self.get(id);
            match node.content {
                _ if node.is_farther_apart(&point, reach) => {}
                FaceBoxContent::MeshFace(face) => near.push(face),
                FaceBoxContent::Inner(right) => stack.extend([right, id + 1]),
            }
        }
        near
    }

    /// Returns the root of the tree over a piece's faces; `None` if the piece has none.
    pub(super) fn root_or_build(&mut self, skin: &mut NearSurface<'_>, piece: u32) -> Option<u32> {
        if let Some(&root) = self.roots_by_piece.get(&piece) {
            return Some(root);
        }
        let faces = skin.add_piece(piece);
        let root = self.add_tree_over(skin, faces)?;
        self.roots_by_piece.insert(piece, root);
        Some(root)
    }

    /// Adds a tree over a range of faces, and returns its root; `None` if the range is empty.
    fn add_tree_over(&mut self, skin: &NearSurface<'_>, faces: Range<u32>) -> Option<u32> {
        let mut boxes: Vec<FaceBox> = faces.map(|face| FaceBox::new(skin, face)).collect();
        self.build_subtree(&mut boxes)
    }

    fn get(&self, at: u32) -> &FaceBox {
        &self.nodes[at as usize]
    }

    /// Adds the subtree over some faces, and returns its root; `None` without faces. The depth is the logarithm of the
    /// number of faces.
    fn build_subtree(&mut self, faces: &mut [FaceBox]) -> Option<u32> {
        let around = faces.iter().copied().reduce(FaceBox::union)?;
        let at = self.nodes.len();
        self.nodes.push(around);
        if faces.len() > 1 {
            let (left, right) = split_at_median(faces, around.high - around.low);
            self.build_subtree(left)?;
            self.nodes[at].content = FaceBoxContent::Inner(self.build_subtree(right)?);
        }
        Some(at as u32)
    }
}

impl FaceBox {
    fn new(skin: &NearSurface<'_>, face: u32) -> Self {
        let ([a, b, c], radius) = (skin.triangle(face), skin.face(face).radius);
        FaceBox {
            low: a.min(b).min(c) - radius,
            high: a.max(b).max(c) + radius,
            content: FaceBoxContent::MeshFace(face),
        }
    }

    /// Returns the smallest box around two boxes, with the content of the first box.
    fn union(self, other: FaceBox) -> FaceBox {
        FaceBox {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            content: self.content,
        }
    }

    /// Returns whether two boxes are farther apart than `reach` along one of the coordinate axes.
    fn is_farther_apart(&self, other: &FaceBox, reach: f64) -> bool {
        let gap = (other.low - self.high).max(self.low - other.high);
        gap.max_element() > reach
    }

    fn longest_side_length(&self) -> f64 {
        (self.high - self.low).max_element()
    }
}

/// Splits two or more faces at the median of their middles, along the longest side of the box around them.
fn split_at_median(faces: &mut [FaceBox], size: DVec3) -> (&mut [FaceBox], &mut [FaceBox]) {
    let (axis, half) = (size.max_position(), faces.len() / 2);
    let middle = |face: &FaceBox| face.low[axis] + face.high[axis];
    faces.select_nth_unstable_by(half, |one, other| middle(one).total_cmp(&middle(other)));
    faces.split_at_mut(half)
}
