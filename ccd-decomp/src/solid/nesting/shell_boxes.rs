//! Bounding boxes of shells, to find shells that may surround a point.

use crate::bounds::Bounds;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Bounding boxes of shells, sorted by their lower ends along one axis.
pub(super) struct ShellBoxes {
    axis: usize,
    boxes: Vec<ShellBox>,
    /// The index of each shell's box.
    places: Vec<u32>,
}

struct ShellBox {
    shell: u32,
    bounds: Bounds,
    /// The largest upper end of this box and all before it.
    reach: f64,
}

impl ShellBoxes {
    /// Creates the boxes from the vertices of each shell.
    pub(super) fn new<V: Iterator<Item = DVec3>>(shells: impl Iterator<Item = V>) -> Self {
        let boxes = shells.zip(0..).map(|(vertices, shell)| ShellBox {
            shell,
            bounds: Bounds::enclosing(vertices),
            reach: f64::NEG_INFINITY,
        });
        let mut boxes: Vec<ShellBox> = boxes.collect();
        let axis = longest_axis(&boxes);
        boxes.sort_by(|a, b| a.bounds.lo[axis].total_cmp(&b.bounds.lo[axis]));
        let mut places = vec![0; boxes.len()];
        let mut reach = f64::NEG_INFINITY;
        for (place, shell) in (0..).zip(&mut boxes) {
            reach = greater(reach, shell.bounds.hi[axis]);
            shell.reach = reach;
            places[shell.shell as usize] = place;
        }
        ShellBoxes {
            axis,
            boxes,
            places,
        }
    }

    /// Returns whether a point is in the box of a shell. A shell winds about no point outside its box.
    pub(super) fn is_about(&self, shell: u32, point: DVec3) -> bool {
        self.boxes[self.places[shell as usize] as usize].holds(point)
    }

    /// Returns whether a point is in the box of a shell other than its own.
    ///
    /// Exact. Tests the boxes that overlap the point along the mesh's longest axis.
    pub(super) fn any_other_about(&self, own: u32, point: DVec3) -> bool {
        let along = point[self.axis];
        let begun = self
            .boxes
            .partition_point(|shell| shell.bounds.lo[self.axis] <= along);
        let near = self.boxes[..begun].iter().rev();
        near.take_while(|shell| shell.reach >= along)
            .any(|shell| shell.shell != own && shell.holds(point))
    }
}

impl ShellBox {
    fn holds(&self, point: DVec3) -> bool {
        self.bounds.meets(&Bounds {
            lo: point,
            hi: point,
        })
    }
}

fn longest_axis(boxes: &[ShellBox]) -> usize {
    let bounds = boxes.iter().map(|shell| shell.bounds);
    let size = bounds
        .reduce(Bounds::union)
        .map_or(DVec3::ZERO, |all| all.hi - all.lo);
    (0..3)
        .max_by(|&a, &b| size[a].total_cmp(&size[b]))
        .unwrap_or(0)
}
