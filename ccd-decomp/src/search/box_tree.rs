//! A binary tree of oriented boxes over triangles.

use super::element::Element;
use super::oriented_box::OrientedBox;
use super::planes::largest_facet_planes;
use super::region::{Region, Shape};
use crate::bounds::BoundingBox;
use crate::tolerance::BOXES_BEFORE_ORIENTED_TESTS;
use crate::work::WorkBudget;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use std::cell::{Cell, OnceCell};
use std::ops::Range;

/// A binary tree of oriented boxes over elements: faces or edges of faces.
pub(crate) struct BoxTree {
    pub(super) elements: Vec<Element>,
    /// The nodes of the tree, parents before children.
    nodes: Vec<Node>,
}

struct Node {
    bounds: BoundingBox,
    oriented_box: OrientedBox,
    /// The range of elements of a leaf; empty for an inner node.
    elements: Range<u32>,
    /// The number of nodes of the subtree, including this node.
    subtree_node_count: u32,
}

/// The maximum number of elements of a leaf.
const MAX_LEAF_ELEMENTS: usize = 2;

impl BoxTree {
    /// Builds a tree over the faces with the numbers `some`, in O(n log n).
    pub(crate) fn from_faces(
        points: &[DVec3],
        faces: &[[u32; 3]],
        some: impl IntoIterator<Item = u32>,
    ) -> Self {
        let element = |face: u32| Element {
            corners: faces[face as usize].map(|v| points[v as usize]),
            face,
        };
        BoxTree::new(some.into_iter().map(element).collect())
    }

    /// Builds a tree over the given elements, in O(n log n).
    pub(super) fn new(mut elements: Vec<Element>) -> Self {
        let mut nodes = Vec::with_capacity(2 * elements.len());
        if !elements.is_empty() {
            build(&mut nodes, &mut elements, 0);
        }
        BoxTree { elements, nodes }
    }

    /// Returns the axis-aligned bounding box of all elements; `None` without elements.
    pub(super) fn bounds(&self) -> Option<BoundingBox> {
        self.nodes.first().map(|node| node.bounds)
    }

    /// Calls `holds` for the face of every element that conservative tests do not separate from a region. Stops when
    /// `holds` returns false or the work is spent.
    pub(crate) fn all_near_faces_satisfy(
        &self,
        region: &Region,
        work: &WorkBudget,
        mut holds: impl FnMut(u32) -> bool,
    ) -> bool {
        // Used only if axis-aligned boxes leave too many elements.
        let (met, planes) = (Cell::new(0), OnceCell::new());
        let is_far = |bounds: &BoundingBox, oriented: &OrientedBox| {
            if !bounds.meets(&region.bounds) {
                return true;
            }
            met.set(met.get() + 1);
            met.get() > BOXES_BEFORE_ORIENTED_TESTS
                && match &region.shape {
                    Shape::Segment(ends) => oriented.is_separated_from_points(ends),
                    Shape::Triangle(corners) => oriented.is_separated_from_points(corners),
                    Shape::HullInBox(hull) => {
                        let mut planes = planes.get_or_init(|| largest_facet_planes(hull)).iter();
                        planes.any(|plane| plane.has_box_in_front(oriented))
                    }
                }
        };
        self.all_near_elements_satisfy(is_far, work, |element| holds(element.face))
    }

    /// Calls `holds` for all elements, except those in boxes for which `is_far` is true. Stops when `holds`
    /// returns false or the work is spent.
    pub(super) fn all_near_elements_satisfy(
        &self,
        is_far: impl Fn(&BoundingBox, &OrientedBox) -> bool,
        work: &WorkBudget,
        mut holds: impl FnMut(&Element) -> bool,
    ) -> bool {
        let mut at = 0;
        // Every step leads to a later node.
        while let Some(node) = self.nodes.get(at) {
            if !work.spend(1) {
                return false;
            }
            if is_far(&node.bounds, &node.oriented_box) {
                at += node.subtree_node_count as usize;
                continue;
            }
            let elements = &self.elements[node.elements.start as usize..node.elements.end as usize];
            if !elements.iter().all(&mut holds) {
                return false;
            }
            at += 1;
        }
        true
    }

    /// Returns the elements of a leaf, or the two children of an inner node.
    pub(super) fn elements_and_children(&self, at: usize) -> (&[Element], Option<[usize; 2]>) {
        let Some(node) = self.nodes.get(at) else {
            return (&[], None);
        };
        let elements = &self.elements[node.elements.start as usize..node.elements.end as usize];
        let left = at + 1;
        let below = elements
            .is_empty()
            .then(|| [left, left + self.nodes[left].subtree_node_count as usize]);
        (elements, below)
    }

    /// Returns a lower bound, up to rounding, of the distance from a point to the elements below a node.
    pub(super) fn least_distance(&self, at: usize, point: DVec3) -> f64 {
        let node = &self.nodes[at];
        greater(
            node.bounds.distance(point),
            node.oriented_box.least_distance(point),
        )
    }
}

/// The number of elements above which subtrees are built in parallel.
const MIN_PARALLEL_ELEMENTS: usize = 4096;

/// Appends the subtree over `elements` to `nodes`. It reorders `elements`, so that the elements of each node are
/// consecutive; `first` is the index of `elements[0]` in the list of the whole tree.
///
/// Each level halves the count: the recursion is at most as deep as a count has bits.
fn build(nodes: &mut Vec<Node>, elements: &mut [Element], first: usize) {
    let oriented = OrientedBox::enclosing_elements(elements);
    let at = nodes.len();
    let split = elements.len() / 2;
    let is_leaf = elements.len() <= MAX_LEAF_ELEMENTS;
    nodes.push(Node {
        bounds: BoundingBox::enclosing(elements.iter().flat_map(|element| element.corners)),
        elements: if is_leaf {
            first as u32..(first + elements.len()) as u32
        } else {
            0..0
        },
        oriented_box: oriented,
        subtree_node_count: 1,
    });
    if !is_leaf {
        let along = nodes[at].oriented_box.axis_of_largest_spread(elements);
        let height = |element: &Element| along.dot(element.center());
        elements.select_nth_unstable_by(split, |a, b| {
            let order = height(a).total_cmp(&height(b));
            order.then(a.face.cmp(&b.face))
        });
        let is_shared = elements.len() > MIN_PARALLEL_ELEMENTS;
        let (left, right) = elements.split_at_mut(split);
        let all_of = |elements: &mut [Element], first: usize| {
            let mut nodes = Vec::new();
            build(&mut nodes, elements, first);
            nodes
        };
        if is_shared {
            let (left, right) =
                rayon::join(|| all_of(left, first), || all_of(right, first + split));
            nodes.extend(left);
            nodes.extend(right);
        } else {
            build(nodes, left, first);
            build(nodes, right, first + split);
        }
    }
    nodes[at].subtree_node_count = (nodes.len() - at) as u32;
}
