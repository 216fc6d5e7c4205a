//! Tests that clusters have all pieces, and that things apart are in clusters of their own.

use super::*;
use rigid_ccd::Body;
use rigid_ccd::body::{Pieces, Solidity};

/// Returns strips of triangles, of which each shares an edge with the next, at places along x.
fn strips(places: &[f64], length: usize) -> Body {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for &place in places {
        let first = vertices.len() as u32;
        vertices.extend((0..length + 2).map(|k| {
            // One zero of each sign: they are the same place.
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
    let clusters = connected_clusters(body.pieces().iter().collect(), max_count);
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
