use super::reach;
use crate::body::tree::NodeOrTriangle;
use crate::tests::scene::{SceneKind, rng, scene};

#[test]
fn no_point_of_a_node_is_beyond_the_reach() {
    let mut rng = rng(41);
    let mut nodes = 0;
    for _ in 0..200 {
        let scene = scene(&mut rng, SceneKind::RandomMotion, 60);
        let problem = scene.problem();
        for side in [&problem.a, &problem.b] {
            let tree = side.body.tree();
            for id in 0..tree.node_count() as u32 {
                let NodeOrTriangle::Node(node) = tree.get(id) else {
                    continue;
                };
                let farthest = node.center.distance(side.path.center) + f64::from(node.radius);
                assert!(farthest <= reach(side), "{farthest} {}", reach(side));
                nodes += 1;
            }
        }
    }
    assert!(nodes > 1_000, "{nodes}");
}
