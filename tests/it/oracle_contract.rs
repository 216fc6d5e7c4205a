//! The contract of oracles, for every oracle and every size of piece.

use ccd_core::DistanceOracle;
use ccd_core::glam::{DQuat, DVec3};
use ccd_distance_gjk::{ClosedForm, Direct, Gjk};
use ccd_distance_vmarch::Vmarch;
use ccd_tests::contract::{Hull, Met, Pair, bounds_law, cache_law, ends_law};
use ccd_tests::models::cuboid;
use ccd_tests::strategies::{direction, rotation, runner};
use proptest::prelude::*;
use std::cell::Cell;
use std::f64::consts::FRAC_PI_4;

/// Runs the contract for an oracle and the sizes of piece that it supports.
macro_rules! contract {
    ($($name:ident: $oracle:ty, $sizes:expr;)*) => {$(
        mod $name {
            use super::*;

            #[test]
            fn claims_enclose_the_distance() {
                enclose::<$oracle>(&$sizes);
            }

            #[test]
            fn stale_caches_change_nothing() {
                stale::<$oracle>(&$sizes);
            }

            #[test]
            fn degenerate_input_ends() {
                degenerate::<$oracle>(&$sizes);
            }

            #[test]
            fn nearly_parallel_boxes() {
                parallel::<$oracle>(&$sizes);
            }
        }
    )*};
}

contract! {
    closed_form: ClosedForm, [1, 2, 3];
    gjk: Gjk, [1, 2, 3, 8, 20];
    direct: Direct, [1, 2, 3, 8, 20];
    vmarch: Vmarch, [1, 2, 3, 8, 20];
}

/// The largest error of a claimed distance, as a fraction of the pair's size: a tenth of the least tolerance in the
/// tests.
const SLACK: f64 = 1e-10;

fn points(sizes: &'static [usize]) -> impl Strategy<Value = Vec<DVec3>> {
    let coordinates = || [-1.0..1.0f64, -1.0..1.0, -1.0..1.0];
    // The shapes range from cubes to needles and plates.
    let stretch = [-2.0..0.0f64, -2.0..0.0, -2.0..0.0];
    let size = prop::sample::select(sizes);
    let all = size.prop_flat_map(move |n| prop::collection::vec(coordinates(), n));
    (all, stretch).prop_map(|(all, stretch)| {
        let stretch = DVec3::from(stretch.map(|x| 10.0f64.powf(x)));
        all.into_iter().map(|p| stretch * DVec3::from(p)).collect()
    })
}

fn pairs(sizes: &'static [usize]) -> impl Strategy<Value = (Pair, f64)> {
    // `None` places the middles of both pieces at the same point.
    let apart = prop_oneof![
        (0.0..4.0f64).prop_map(Some),
        (1.0..2.0f64).prop_map(Some),
        Just(Some(50.0)),
        Just(None)
    ];
    let scale = prop_oneof![3 => Just(1.0), 1 => Just(1e-3), 1 => Just(1e3)];
    (
        points(sizes),
        points(sizes),
        rotation(),
        direction(),
        apart,
        scale,
    )
        .prop_map(|(a, b, rotation, towards, apart, scale)| {
            let scaled = |points: Vec<DVec3>| points.iter().map(|p| scale * p).collect();
            let [a, b] = [a, b].map(|points| Hull::new(scaled(points)));
            let offset = match apart {
                Some(apart) => scale * apart * towards,
                None => a.middle() - rotation * b.middle(),
            };
            let pair = Pair::new(a, b, rotation, offset);
            (pair, SLACK * scale * (1.0 + apart.unwrap_or(0.0)))
        })
}

/// The numbers of pairs that are apart, that meet, and that an oracle refuses.
#[derive(Debug, Default)]
struct Tally([Cell<u32>; 3]);

impl Tally {
    fn add(&self, met: Met) {
        let count = &self.0[met as usize];
        count.set(count.get() + 1);
    }

    /// Asserts that most pieces are apart, many meet, and very few are refused.
    fn check(&self) {
        let [apart, meeting, refused] = [0, 1, 2].map(|k| self.0[k].get());
        let all = apart + meeting + refused;
        let enough = 2 * apart > all && 5 * meeting > all && 100 * refused <= all;
        assert!(enough, "{self:?}");
    }
}

fn run<S: Strategy>(cases: u32, strategy: &S, law: impl Fn(S::Value) -> Result<(), String>) {
    runner(cases)
        .run(strategy, |value| law(value).map_err(TestCaseError::fail))
        .unwrap_or_else(|error| panic!("{error}"));
}

fn enclose<O: DistanceOracle + Default>(sizes: &'static [usize]) {
    let tally = Tally::default();
    run(2_000, &pairs(sizes), |(pair, slack)| {
        bounds_law(&mut O::default(), &pair, slack).map(|met| tally.add(met))
    });
    tally.check();
}

fn stale<O: DistanceOracle + Default>(sizes: &'static [usize]) {
    let (tally, both) = (Tally::default(), (pairs(sizes), pairs(sizes)));
    run(1_000, &both, |((first, _), (second, slack))| {
        let law = cache_law(&mut O::default(), [&first, &second], slack);
        law.map(|met| tally.add(met))
    });
    tally.check();
}

fn degenerate<O: DistanceOracle + Default>(sizes: &'static [usize]) {
    let odd = [0.0, -0.0, 1.0, 1e-300, 1e15, -1e15, f64::MIN_POSITIVE];
    let point = || prop::array::uniform3(prop::sample::select(odd.to_vec())).prop_map(DVec3::from);
    let size = || prop::sample::select(sizes);
    let all = move || size().prop_flat_map(move |n| prop::collection::vec(point(), n));
    run(2_000, &(all(), all(), point()), |(a, b, offset)| {
        // The coordinates exceed those allowed in a `Pieces`, so the points are used alone.
        let [a, b] = [a, b].map(|points| Hull::with_facets(points, Vec::new()));
        let same = Pair::new(a.clone(), a.clone(), DQuat::IDENTITY, DVec3::ZERO);
        ends_law(&mut O::default(), &same)?;
        ends_law(&mut O::default(), &Pair::new(a, b, DQuat::IDENTITY, offset))
    });
}

/// T23: pieces rotated from parallel by smaller and smaller angles, face over face, until the nearest features change.
fn parallel<O: DistanceOracle + Default>(sizes: &'static [usize]) {
    let count = *sizes.iter().filter(|&&n| n <= 8).max().expect("a size");
    let cube = &cuboid(DVec3::splat(0.5)).parts[0];
    // Shapes with fewer than all corners have no facets.
    let shape = match count {
        8 => Hull::with_facets(cube.points.clone(), cube.facets.clone()),
        _ => Hull::new(cube.points[..count].to_vec()),
    };
    let inputs = (direction(), -16.0..0.0f64, -9.0..1.0f64, any::<bool>());
    run(600, &inputs, |(axis, turn, apart, diagonal)| {
        let turn = DQuat::from_axis_angle(axis, 10.0f64.powf(turn));
        let base = if diagonal {
            DQuat::from_rotation_x(FRAC_PI_4)
        } else {
            DQuat::IDENTITY
        };
        let offset = DVec3::new(0.1, 0.2, 2.0 + 10.0f64.powf(apart));
        let pair = Pair::new(shape.clone(), shape.clone(), turn * base, offset);
        match bounds_law(&mut O::default(), &pair, 10.0 * SLACK)? {
            Met::Apart => Ok(()),
            met => Err(format!("{met:?}")),
        }
    });
}
