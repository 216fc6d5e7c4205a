//! Finds extremal points by a tree over the points, and visits only nodes that may contain an extremal point.

use crate::math::order::greater;
use crate::math::principal::principal_axes;
use crate::math::vector::{bounding_box, distance};
use crate::rounding::{DISC_HEIGHT_ERROR_F32, DISC_TILT_ERROR_F32, FRAME_ERROR_F64};
use glam::{DMat3, DVec3, Vec3};

/// The number of points in a block, and of children in a group.
const LANES: usize = 8;

/// The points of a piece in blocks of eight, under a tree of bounding discs. There are discs around the points of every
/// block, of every eight blocks, and so on up to one group. On a curved surface, discs shrink with the square of their
/// width, so that few of them extend beyond the farthest point.
///
/// # Memory
/// About 70 bytes for each point.
#[derive(Clone, Debug)]
pub struct SupportTree {
    blocks: Vec<Block>,
    groups: Vec<DiscGroup>,
    /// The index in `groups` of each level's first group; the lowest level is that above the blocks. The last level is
    /// one group.
    level_starts: Vec<usize>,
    /// The center and radius of a ball around the points.
    pub(super) bounding_ball: (DVec3, f64),
}

/// Eight points, relative to the middle of the piece and scaled to its size; the last point is repeated to fill the
/// block.
#[derive(Clone, Debug)]
#[repr(align(32))]
struct Block {
    points: [[f64; LANES]; 3],
    /// The indices of the block's points among the piece's points.
    point_indices: [u32; LANES],
}

/// Eight discs that bound points. Each contains the points below it: those at most `thickness` to either side of
/// `center` along `normal`, and at most `radius` across.
#[derive(Clone, Debug, Default)]
#[repr(align(32))]
struct DiscGroup {
    center: [[f32; LANES]; 3],
    normal: [[f32; LANES]; 3],
    radius: [f32; LANES],
    half_thickness: [f32; LANES],
    /// For each disc, what is added for rounding to the upper bound of its points' heights along a direction. In lanes
    /// without a disc it is −∞, so that these lanes are never visited.
    rounding_error_bounds: [f32; LANES],
}

impl SupportTree {
    /// Builds the tree over one or more finite points.
    ///
    /// # Complexity
    /// O(n log n).
    pub fn new(points: &[DVec3]) -> Self {
        let (middle, reach) = bounding_ball(points);
        let scale = power_of_two_above(reach).recip();
        let placed: Vec<DVec3> = points.iter().map(|&p| (p - middle) * scale).collect();
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        sort_spatially(&placed, &mut order);
        let sorted: Vec<DVec3> = order.iter().map(|&k| placed[k as usize]).collect();
        let mut tree = SupportTree {
            blocks: order
                .chunks(LANES)
                .map(|of| Block::new(&placed, of))
                .collect(),
            groups: Vec::new(),
            level_starts: Vec::new(),
            bounding_ball: (middle, reach),
        };
        let mut width = LANES;
        while width < sorted.len() {
            tree.level_starts.push(tree.groups.len());
            let groups = sorted.chunks(LANES * width);
            tree.groups
                .extend(groups.map(|points| DiscGroup::new(points, width)));
            width *= LANES;
        }
        tree
    }

    /// Returns the index of a point that is farthest along a direction.
    ///
    /// # Guarantee
    /// The guarantee of [`SupportMap::extremal_point`](crate::SupportMap::extremal_point), for any points.
    ///
    /// # Complexity
    /// About logarithmic in the number of points of a curved surface; linear if all are equally far.
    pub fn extremal_point(&self, direction: DVec3) -> u32 {
        let mut search = Search::new(direction);
        self.descend(self.level_starts.len(), 0, &mut search);
        search.highest_point
    }

    /// Returns the number of nodes that a search along a direction visits.
    #[cfg(test)]
    pub(super) fn count_visited_nodes(&self, direction: DVec3) -> usize {
        let mut search = Search::new(direction);
        self.descend(self.level_starts.len(), 0, &mut search);
        search.visit_count
    }

    /// Searches below a node: visits its children in descending order of their bounds while they may contain a farther
    /// point.
    fn descend(&self, level: usize, at: usize, search: &mut Search) {
        #[cfg(test)]
        {
            search.visit_count += 1;
        }
        let Some(below) = level.checked_sub(1) else {
            return search.visit_block(&self.blocks[at]);
        };
        let mut bounds =
            self.groups[self.level_starts[below] + at].height_upper_bounds(search.scaled_direction);
        for _ in 0..LANES {
            let lane = index_of_highest(&bounds);
            // Written so that NaN ends the loop.
            if !(bounds[lane] > search.visit_threshold) {
                return;
            }
            bounds[lane] = f32::NEG_INFINITY;
            self.descend(below, LANES * at + lane, search);
        }
    }
}

/// The state of a search for the farthest point: the direction, and the farthest point so far.
struct Search {
    direction: DVec3,
    /// The direction of the search, scaled so that its largest component is 1.
    scaled_direction: Vec3,
    largest_component: f64,
    max_height: f64,
    /// The height that a disc's upper bound must exceed for the disc to be visited.
    visit_threshold: f32,
    highest_point: u32,
    #[cfg(test)]
    visit_count: usize,
}

impl Search {
    #[inline]
    fn new(direction: DVec3) -> Self {
        let size = direction.abs().max_element();
        Search {
            direction,
            scaled_direction: (direction / size).as_vec3(),
            largest_component: size,
            max_height: f64::NEG_INFINITY,
            visit_threshold: f32::NEG_INFINITY,
            highest_point: 0,
            #[cfg(test)]
            visit_count: 0,
        }
    }

    #[inline]
    fn visit_block(&mut self, block: &Block) {
        let ([x, y, z], d) = (&block.points, self.direction);
        let mut heights = [0.0; LANES];
        for k in 0..LANES {
            heights[k] = x[k] * d.x + (y[k] * d.y + z[k] * d.z);
        }
        let lane = index_of_highest(&heights);
        if heights[lane] > self.max_height {
            self.max_height = heights[lane];
            self.visit_threshold = ((self.max_height / self.largest_component) as f32).next_down();
            self.highest_point = block.point_indices[lane];
        }
    }
}

impl Block {
    fn new(placed: &[DVec3], numbers: &[u32]) -> Self {
        let number = |lane: usize| numbers[lane.min(numbers.len() - 1)];
        let row = |axis: usize| std::array::from_fn(|lane| placed[number(lane) as usize][axis]);
        Block {
            points: [0, 1, 2].map(row),
            point_indices: std::array::from_fn(number),
        }
    }
}

impl DiscGroup {
    /// Builds the discs around at most eight consecutive runs of `width` points each.
    fn new(points: &[DVec3], width: usize) -> Self {
        let mut discs = DiscGroup {
            rounding_error_bounds: [f32::NEG_INFINITY; LANES],
            ..DiscGroup::default()
        };
        for (lane, points) in points.chunks(width).enumerate() {
            let disc = Disc::enclosing(points);
            for axis in 0..3 {
                discs.center[axis][lane] = disc.center[axis];
                discs.normal[axis][lane] = disc.normal[axis];
            }
            discs.radius[lane] = disc.radius;
            discs.half_thickness[lane] = disc.half_thickness;
            discs.rounding_error_bounds[lane] = DISC_HEIGHT_ERROR_F32;
        }
        discs
    }

    /// Returns an upper bound of the heights of each disc's points along a direction whose largest component is 1.
    #[inline]
    fn height_upper_bounds(&self, d: Vec3) -> [f32; LANES] {
        let square = d.length_squared() * (1.0 + DISC_TILT_ERROR_F32);
        let ([x, y, z], [u, v, w]) = (&self.center, &self.normal);
        let mut bounds = [0.0; LANES];
        for k in 0..LANES {
            let along = u[k] * d.x + (v[k] * d.y + w[k] * d.z);
            let across = square - along * along;
            let across = if across > 0.0 { across } else { 0.0 }.sqrt();
            let center = x[k] * d.x + (y[k] * d.y + z[k] * d.z);
            let reach = self.radius[k] * across + self.half_thickness[k] * along.abs();
            bounds[k] = center + reach + self.rounding_error_bounds[k];
        }
        bounds
    }
}

/// A disc that bounds points, in f32, with its radius and thickness rounded up.
struct Disc {
    center: Vec3,
    normal: Vec3,
    radius: f32,
    half_thickness: f32,
}

impl Disc {
    /// Creates a disc around points, whose normal is the principal axis along which their extent is least.
    fn enclosing(points: &[DVec3]) -> Self {
        let frame = principal_axes(|| points.iter().map(|&p| (p, 1.0)));
        // An axis that is not of unit length, due to rounding or underflow, is not used.
        let is_unit = |axis: DVec3| (axis.length_squared() - 1.0).abs() <= FRAME_ERROR_F64;
        let frame = if [0, 1, 2].into_iter().all(|k| is_unit(frame.col(k))) {
            frame
        } else {
            DMat3::IDENTITY
        };
        let turned = frame.transpose();
        let (low, high) = bounding_box(points.iter().map(|&p| turned * p));
        let thinnest = (high - low).min_position();
        let center = (frame * (0.5 * (low + high))).as_vec3();
        let normal = frame.col(thinnest).as_vec3();
        let (mut square, mut thickness) = (0.0, 0.0);
        for &point in points {
            let way = point - center.as_dvec3();
            let along = normal.as_dvec3().dot(way);
            thickness = greater(thickness, along.abs());
            square = greater(square, (way - along * normal.as_dvec3()).length_squared());
        }
        // One step is for rounding to f32, one for rounding in f64.
        let outward = |x: f64| (x as f32).next_up().next_up();
        Disc {
            center,
            normal,
            radius: outward(square.sqrt()),
            half_thickness: outward(thickness),
        }
    }
}

/// Sorts the indices of points so that points in the same block, and in the same group of blocks, are near each other.
fn sort_spatially(points: &[DVec3], order: &mut [u32]) {
    if order.len() <= LANES {
        return;
    }
    let mut unit = LANES;
    while unit * LANES < order.len() {
        unit *= LANES;
    }
    let at = |k: u32| points[k as usize];
    let (low, high) = bounding_box(order.iter().map(|&k| at(k)));
    let axis = (high - low).max_position();
    let half = order.len().div_ceil(unit) / 2 * unit;
    order.select_nth_unstable_by(half, |&k, &l| at(k)[axis].total_cmp(&at(l)[axis]));
    let (before, after) = order.split_at_mut(half);
    sort_spatially(points, before);
    sort_spatially(points, after);
}

/// Returns the middle of the bounding box of one or more points, and an upper bound of their distances from it.
pub(super) fn bounding_ball(points: &[DVec3]) -> (DVec3, f64) {
    let (low, high) = bounding_box(points.iter().copied());
    let middle = low + 0.5 * (high - low);
    let ways = points.iter().map(|&p| distance(p, middle));
    (middle, ways.fold(0.0, greater).next_up())
}

/// Returns the least power of two above a number; 1 for a number too small to divide by.
fn power_of_two_above(x: f64) -> f64 {
    const EXPONENT_MASK: u64 = 0x7ff << 52;
    match f64::from_bits(x.to_bits() & EXPONENT_MASK) {
        below if below > 0.0 => 2.0 * below,
        _ => 1.0,
    }
}

/// Returns the index of the highest value; the first one if several are equal.
#[inline]
fn index_of_highest<T: PartialOrd + Copy>(values: &[T; LANES]) -> usize {
    let (mut best, mut most) = (0, values[0]);
    for (k, &value) in values.iter().enumerate().skip(1) {
        let higher = value > most;
        most = if higher { value } else { most };
        best = if higher { k } else { best };
    }
    best
}

#[cfg(test)]
mod tests;
