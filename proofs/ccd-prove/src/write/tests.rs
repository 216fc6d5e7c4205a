use super::*;
use crate::Body;
use ccd_core::{Motion, Pose};

/// Proves two pairs with an unlimited cache, and with a cache that is full after two intervals.
#[test]
fn a_full_cache_is_emptied_and_the_proof_still_holds() {
    let rod = Body::new(&[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], &[[0, 1, 1]]);
    let turning = Motion::new(Pose::IDENTITY, [0.0; 3], [0.0, 0.0, 20.0]).unwrap();
    let beside = |y| Motion::new(Pose::at([0.0, y, 0.0]).unwrap(), [0.0; 3], [0.0; 3]).unwrap();
    let mut scene = Scene::of_two((&rod, turning), (&rod, beside(1.001)), 0.0);
    scene.pairs.push(scene.pairs[0]);
    let links = link_motions(&scene.links, 0).unwrap();
    let statement = write_statement(&scene, &links, 1.0, None).unwrap();
    let subdivide = |max_cached_states| {
        let limits = SubdivisionLimits {
            until: 1.0,
            stop: None,
            max_cached_states,
        };
        subdivide_pairs((&scene, &links), &statement, limits).unwrap()
    };
    let (unlimited, limited) = (subdivide(usize::MAX), subdivide(2 * links.len()));
    assert!(unlimited.cached_states() > 10 * links.len());
    assert!(limited.cached_states() <= 3 * links.len());
    for subdivision in [unlimited, limited] {
        let bytes = [&statement.bytes[..], &subdivision.steps].concat();
        let mesh = ccd_check::Body::new(rod.mesh(), rod.certificate(), &bytes).unwrap();
        assert_eq!(ccd_check::check(&[mesh], &bytes), Ok(()));
    }
}
