//! The boxes of shells, to find those that may surround a point.

use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};

/// The boxes of shells, in the order of their lower ends along one axis.
pub(super) struct ShellBoxes {
    axis: usize,
    boxes: Vec<ShellBox>,
    /// The place of each shell among them.
    places: Vec<u32>,
}

struct ShellBox {
    shell: u32,
    low: DVec3,
    high: DVec3,
    /// The greatest upper end of this box and those before it.
    reach: f64,
}

impl ShellBoxes {
    /// Takes the vertices of each shell.
    pub(super) fn new<V: Iterator<Item = DVec3>>(shells: impl Iterator<Item = V>) -> Self {
        let boxes = shells.zip(0..).map(|(mut vertices, shell)| {
            // Every shell has a face.
            let first = vertices.next().unwrap_or_default();
            let (mut low, mut high) = (first, first);
            for vertex in vertices {
                low = each(low, vertex, lesser);
                high = each(high, vertex, greater);
            }
            let reach = f64::NEG_INFINITY;
            ShellBox {
                shell,
                low,
                high,
                reach,
            }
        });
        let mut boxes: Vec<ShellBox> = boxes.collect();
        let axis = longest_axis(&boxes);
        boxes.sort_by(|a, b| a.low[axis].total_cmp(&b.low[axis]));
        let mut reach = f64::NEG_INFINITY;
        for shell in &mut boxes {
            reach = greater(reach, shell.high[axis]);
            shell.reach = reach;
        }
        let mut places = vec![0; boxes.len()];
        for (place, shell) in (0..).zip(&boxes) {
            places[shell.shell as usize] = place;
        }
        ShellBoxes {
            axis,
            boxes,
            places,
        }
    }

    /// Returns whether a point is in the box of a shell. A shell winds about no point outside of its box.
    pub(super) fn is_about(&self, shell: u32, point: DVec3) -> bool {
        self.boxes[self.places[shell as usize] as usize].holds(point)
    }

    /// Returns whether a point is in the box of a shell other than its own.
    ///
    /// Exact. It looks at the boxes that overlap the point along the mesh's longest axis.
    pub(super) fn any_other_about(&self, own: u32, point: DVec3) -> bool {
        let along = point[self.axis];
        let begun = self
            .boxes
            .partition_point(|shell| shell.low[self.axis] <= along);
        let near = self.boxes[..begun]
            .iter()
            .rev()
            .take_while(|shell| shell.reach >= along);
        near.filter(|shell| shell.shell != own)
            .any(|shell| shell.holds(point))
    }
}

impl ShellBox {
    fn holds(&self, point: DVec3) -> bool {
        self.low.cmple(point).all() && point.cmple(self.high).all()
    }
}

fn longest_axis(boxes: &[ShellBox]) -> usize {
    let Some(first) = boxes.first() else {
        return 0;
    };
    let ends = boxes
        .iter()
        .fold((first.low, first.high), |(low, high), shell| {
            (
                each(low, shell.low, lesser),
                each(high, shell.high, greater),
            )
        });
    let size = ends.1 - ends.0;
    (0..3)
        .max_by(|&a, &b| size[a].total_cmp(&size[b]))
        .unwrap_or(0)
}

fn each(a: DVec3, b: DVec3, choose: fn(f64, f64) -> f64) -> DVec3 {
    DVec3::new(choose(a.x, b.x), choose(a.y, b.y), choose(a.z, b.z))
}
