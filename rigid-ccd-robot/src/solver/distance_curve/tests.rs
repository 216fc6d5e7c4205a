use crate::solver::tests::{least_distance, random_cell, random_configuration};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::Settings;

#[test]
fn no_sample_is_below_the_curve() {
    let mut random = Pcg64::seed_from_u64(11);
    let mut near = 0;
    for _ in 0..25 {
        let cell = random_cell(&mut random);
        let path = [(); 3].map(|()| random_configuration(&mut random, cell.robot()));
        let mut solver = cell.solver();
        let ranges = solver.distance_curve(&path, 3).unwrap();
        assert_eq!(ranges.len(), 16);
        assert_eq!(ranges[0].from.time(), 0.0);
        assert_eq!(ranges[ranges.len() - 1].to.time(), 2.0);
        for two in ranges.windows(2) {
            assert_eq!(two[0].to.time(), two[1].from.time());
        }
        let whole = solver.closest_approach(&path).unwrap().outcome;
        for range in &ranges {
            let closest = range.closest;
            assert!(closest.upper() >= whole.lower());
            assert!(
                closest.upper() - closest.lower() <= Settings::DEFAULT.tolerance + 1e-9
                    || closest.upper().is_infinite()
            );
            for _ in 0..8 {
                let at = range.from.time()
                    + random.random_range(0.0..=1.0) * (range.to.time() - range.from.time());
                let segment = (at as usize).min(1);
                let fraction = at - segment as f64;
                let between = |k: usize| {
                    path[segment][k] + fraction * (path[segment + 1][k] - path[segment][k])
                };
                let configuration: Vec<f64> = (0..path[0].len()).map(between).collect();
                let measured = least_distance(&cell, &configuration);
                assert!(measured >= closest.lower() - 1e-9, "{measured} {closest:?}");
                near += usize::from(measured < closest.upper() + 0.01);
            }
        }
    }
    assert!(near > 100, "{near}");
}
