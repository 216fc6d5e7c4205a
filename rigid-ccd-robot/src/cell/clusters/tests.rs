//! Tests that clusters contain all pieces, and that separate components are in separate clusters.

use super::*;
use rigid_ccd::Body;
use rigid_ccd::body::{Pieces, Solidity};

/// Returns a body of triangle strips at positions along x. Within a strip, each triangle shares an edge with the next.
fn strips(places: &[f64], length: usize) -> Body {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for &place in places {
        let first = vertices.len() as u32;
        vertices.extend((0..length + 2).map(|k| {
            // 0.0 and -0.0 alternate: they are the same coordinate.
            let side = if k % 2 == 0 { -0.0 } else { 0.1 };
            DVec3::new(place, side, 0.01 * k as f64)
        }));
        faces.extend((0..length as u32).map(|k| [first + k, first + k + 1, first + k + 2]));
    }
    let ids: Vec<u32> = (0..faces.len() as u32).collect();
    let pieces = Pieces::from_triangles(&vertices, &faces, &ids).unwrap();
    Body::new(&pieces, Solidity::Surface).unwrap()
}

fn sizes(body: &Body, max_count: usize) -> Vec<usize> {
    let clusters = connected_clusters(body, max_count);
    let mut sizes: Vec<usize> = clusters.iter().map(Vec::len).collect();
    sizes.sort_unstable();
    sizes
}

#[test]
fn things_apart_are_clusters_of_their_own() {
    let places: Vec<f64> = (0..10).map(f64::from).collect();
    assert_eq!(sizes(&strips(&places, 7), 4), [7; 10]);
    // Each strip is halved twice.
    assert_eq!(sizes(&strips(&places, 64), 4), [16; 40]);
    assert_eq!(sizes(&strips(&[0.0], 64), 4), [16; 4]);
    assert_eq!(sizes(&strips(&[0.0], 15), 4), [15]);
    // A link has one hull.
    assert_eq!(sizes(&strips(&places, 7), 1), [70]);
    let many: Vec<f64> = (0..1000).map(f64::from).collect();
    let sizes = sizes(&strips(&many, 1), 4);
    assert!(sizes.len() <= MAX_COMPONENTS && sizes.iter().sum::<usize>() == 1000);
}

/// Returns solid balls of triangles at positions along x. The surface of each has two components.
fn solid_balls(count: usize) -> Body {
    let (mut vertices, mut faces) = (Vec::new(), Vec::<[u32; 3]>::new());
    let (rings, sides) = (6, 8);
    for number in 0..count {
        let first = vertices.len() as u32;
        let center = DVec3::new(3.0 * number as f64, 0.0, 0.0);
        vertices.push(center - DVec3::Z);
        for ring in 1..rings {
            let height = -1.0 + 2.0 * f64::from(ring) / f64::from(rings);
            let radius = (1.0 - height * height).sqrt();
            vertices.extend((0..sides).map(|side| {
                let (sine, cosine) =
                    (f64::from(side) / f64::from(sides) * std::f64::consts::TAU).sin_cos();
                center + DVec3::new(radius * cosine, radius * sine, height)
            }));
        }
        vertices.push(center + DVec3::Z);
        let at = |ring: u32, side: u32| first + 1 + (ring - 1) * sides + side % sides;
        let top = first + 1 + (rings - 1) * sides;
        for side in 0..sides {
            faces.push([first, at(1, side + 1), at(1, side)]);
            faces.push([top, at(rings - 1, side), at(rings - 1, side + 1)]);
            for ring in 1..rings - 1 {
                faces.push([at(ring, side), at(ring, side + 1), at(ring + 1, side + 1)]);
                faces.push([at(ring, side), at(ring + 1, side + 1), at(ring + 1, side)]);
            }
        }
    }
    let ids: Vec<u32> = (0..faces.len() as u32).collect();
    let pieces = Pieces::from_triangles(&vertices, &faces, &ids).unwrap();
    Body::new(&pieces, Solidity::Solid).unwrap()
}

/// Tests that a link anywhere inside a solid obstacle is in contact.
#[test]
fn a_link_inside_a_solid_is_never_free() {
    use crate::cell::Cell;
    use crate::pairs::LinkPairs;
    use crate::robot::{Joint, Link, PositionRule, Robot};
    use rigid_ccd::{Pose, trajectory};
    for count in [1, 10, 300] {
        let slider = Joint {
            name: "slider".into(),
            parent: "rail".into(),
            child: "bead".into(),
            geometry: trajectory::Joint::prismatic(Pose::IDENTITY, [1.0, 0.0, 0.0]).unwrap(),
            position_rule: PositionRule::Independent,
        };
        let bead = Link::named("bead").with_body(Body::sphere(0.01).unwrap(), Pose::IDENTITY);
        let robot = Robot::new(vec![Link::named("rail"), bead], vec![slider]).unwrap();
        let mut cell = Cell::new(robot.clone(), LinkPairs::from_robot(&robot));
        cell.add_obstacle("balls", solid_balls(count), Pose::IDENTITY)
            .unwrap();
        let mut solver = cell.solver();
        let last = 3.0 * (count - 1) as f64;
        for at in [-0.5, -0.2, 0.0, 0.1, 0.4, last, last + 0.3] {
            assert!(!solver.is_free(&[[at]]).unwrap(), "{count} {at}");
            assert!(
                !solver.is_free(&[[at], [at + 0.05]]).unwrap(),
                "{count} {at}"
            );
        }
        assert!(solver.is_free(&[[-2.0], [-1.1]]).unwrap());
    }
}
