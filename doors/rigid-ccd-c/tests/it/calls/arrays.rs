//! Draws arrays, and the counts that belong to them: meshes, curves, paths.

use super::call::Call;
use rigid_ccd_c::*;
use std::fmt::Debug;
use std::ptr::null;

/// A count beyond any memory.
const TOO_MANY: usize = usize::MAX / 8;

impl Call<'_, '_> {
    /// Keeps an array, and its number of values in units of `unit`, which `count` returns. Sometimes the count is too
    /// large, or the array is null or misaligned.
    pub(super) fn array<T: Debug + 'static>(
        &mut self,
        name: &str,
        values: Vec<T>,
        unit: usize,
    ) -> *const T {
        self.note(name, &values);
        let count = values.len() / unit;
        let pointer = self.keep(values);
        if !self.is_odd() {
            self.counts.push_back(count);
            return pointer;
        }
        let (count, pointer) = match self.random.index(5) {
            0 => (count, null()),
            1 => ([1 << 32, 1 << 60, usize::MAX][self.random.index(3)], null()),
            2 => (TOO_MANY, pointer),
            3 => (count, pointer.wrapping_byte_add(1)),
            _ => (self.random.index(1 + count as u32), pointer),
        };
        self.note("which is", (count, !pointer.is_null()));
        self.counts.push_back(count);
        pointer
    }

    pub(super) fn count(&mut self) -> usize {
        self.counts.pop_front().unwrap()
    }

    pub(super) fn vertices(&mut self) -> *const f64 {
        let scale = if self.once_in(10) { 1e6 } else { 1.0 };
        let points: Vec<[f64; 3]> = match self.random.index(5) {
            // The corners of a box.
            0 => (0..8)
                .map(|k| [k & 1, k >> 1 & 1, k >> 2].map(f64::from))
                .collect(),
            1 => vec![[0.5; 3]; 4],
            2 => (0..4).map(|k| [f64::from(k), 0.0, 1.0]).collect(),
            _ => (0..3 + self.random.index(12))
                .map(|_| self.random.vector(1.0))
                .collect(),
        };
        self.vertex_count = points.len() as u32;
        let mut numbers: Vec<f64> = points.into_iter().flatten().map(|x| scale * x).collect();
        if self.is_odd() {
            let index = self.random.index(numbers.len() as u32);
            numbers[index] = self.number("one vertex", 0.0);
        }
        self.array("vertices", numbers, 3)
    }

    pub(super) fn triangles(&mut self) -> *const u32 {
        const BOX: [[u32; 3]; 12] = [
            [0, 2, 1],
            [1, 2, 3],
            [4, 5, 6],
            [5, 7, 6],
            [0, 1, 4],
            [1, 5, 4],
            [2, 6, 3],
            [3, 6, 7],
            [0, 4, 2],
            [2, 4, 6],
            [1, 3, 5],
            [3, 7, 5],
        ];
        let count = self.vertex_count;
        let corner = |call: &mut Self| {
            if call.is_odd() {
                call.random.bits()
            } else {
                call.random.index(count) as u32
            }
        };
        let triangles = if count == 8 {
            BOX.as_flattened().to_vec()
        } else {
            (0..3 * self.random.index(20))
                .map(|_| corner(self))
                .collect()
        };
        self.array("triangles", triangles, 3)
    }

    /// Draws the number of times, the number of joints and the degree of a curve. Some do not fit together.
    fn curve_size(&mut self) -> [usize; 3] {
        let count = if self.once_in(40) {
            500
        } else {
            [0, 1, 2, 2, 3, 4][self.random.index(6)]
        };
        let joints = [0, 1, 2, 2, 2, 7][self.random.index(6)];
        let degree = if self.once_in(10) {
            40
        } else {
            self.random.index(10)
        };
        [count, joints, degree]
    }

    pub(super) fn times(&mut self, count: usize) -> Vec<f64> {
        let mut time = self.random.number();
        (0..count)
            .map(|_| {
                time += 1.0 + self.random.number();
                self.number("time", time)
            })
            .collect()
    }

    fn joint_values(&mut self, count: usize, scale: f64) -> Vec<f64> {
        let draw = |_| {
            let usual = scale * self.random.number();
            if self.is_odd() {
                self.number("value", usual)
            } else {
                usual
            }
        };
        (0..count).map(draw).collect()
    }

    /// Draws the times of a curve, three arrays with a row for each time, and their counts.
    pub(super) fn hermite(&mut self) -> *const f64 {
        let [count, joints, _] = self.curve_size();
        let mut arrays = vec![self.times(count)];
        for scale in [0.8, 0.1, 0.1] {
            arrays.push(self.joint_values(count * joints, scale));
        }
        let (mut arrays, counts) = self.arrays(arrays, [count, joints]);
        if self.once_in(2) {
            arrays[3] = null();
        }
        self.first_of(arrays, counts)
    }

    /// Draws times, coefficients, and the numbers of segments, joints and the degree.
    pub(super) fn polynomials(&mut self) -> *const f64 {
        let [segments, joints, degree] = self.curve_size();
        let times = self.times(segments + 1);
        let coefficients = if self.once_in(2) {
            // Constant polynomials, which are continuous.
            let own = [vec![0.3], vec![0.0; degree]].concat();
            own.repeat(segments * joints)
        } else {
            self.joint_values(segments * joints * (degree + 1), 0.1)
        };
        let arrays = vec![times, coefficients];
        let (arrays, counts) = self.arrays(arrays, [segments, joints, degree]);
        self.first_of(arrays, counts)
    }

    /// Draws times and poses, and their count.
    pub(super) fn times_of_poses(&mut self) -> *const f64 {
        let count = [0, 1, 2, 3, 4][self.random.index(5)];
        let times = self.times(count);
        let poses = (0..count).flat_map(|_| self.pose_numbers()).collect();
        let (arrays, counts) = self.arrays(vec![times, poses], [count]);
        self.first_of(arrays, counts)
    }

    /// Returns the first of these arrays. `next` and `count` return the other arrays and the counts.
    fn first_of<const COUNT: usize>(
        &mut self,
        arrays: Vec<*const f64>,
        counts: [usize; COUNT],
    ) -> *const f64 {
        self.counts.extend(counts);
        self.pointers.extend(arrays);
        self.next()
    }

    pub(super) fn next<T>(&mut self) -> *const T {
        self.pointers.pop_front().unwrap().cast()
    }

    /// Draws pointers to several arrays with the same counts.
    pub(super) fn arrays<const COUNT: usize>(
        &mut self,
        arrays: Vec<Vec<f64>>,
        mut counts: [usize; COUNT],
    ) -> (Vec<*const f64>, [usize; COUNT]) {
        self.note("counts", counts);
        self.note("arrays", &arrays);
        let mut pointers: Vec<_> = arrays.into_iter().map(|own| self.keep(own)).collect();
        let which = self.random.index(COUNT as u32);
        if self.is_odd() {
            match self.random.index(4) {
                0 => pointers = pointers.into_iter().map(|own| self.spoil(own)).collect(),
                1 => counts[0] = TOO_MANY,
                2 => counts[which] = counts[which].saturating_sub(1),
                _ => {
                    pointers.fill(null());
                    counts[which] = [1 << 32, TOO_MANY, usize::MAX][self.random.index(3)];
                }
            }
            self.note("which are", (counts, pointers[0].is_null()));
        }
        (pointers, counts)
    }

    /// Draws a path for the solver that was drawn, or one that does not fit it.
    pub(super) fn path(&mut self) -> *const RccdPath {
        let joints = self.world.joint_counts.get(&self.owner).copied();
        let joints = joints.or(self.joint_count).unwrap_or(2);
        let count = match self.random.index(300) {
            0 => 300,
            1..10 => 0,
            k => 1 + k % 4,
        };
        let configurations = self.joint_values(count * joints, 1.2);
        let (arrays, [mut count]) = self.arrays(vec![configurations], [count]);
        let mut configurations = arrays[0];
        let curve = if self.once_in(4) {
            if !self.is_odd() {
                (configurations, count) = (null(), 0);
            }
            self.handle::<RccdJointCurve>()
        } else {
            null()
        };
        // The number of segments of a curve is unknown here.
        self.segments = if curve.is_null() { count } else { 0 };
        self.lend(RccdPath {
            configurations,
            configuration_count: count,
            curve,
        })
    }
}
