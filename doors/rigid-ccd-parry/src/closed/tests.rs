use super::*;

const CORNERS: [DVec3; 4] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
const TETRAHEDRON_FACES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

#[test]
fn a_tetrahedron_is_closed() {
    assert_eq!(find_open_edge(&CORNERS, &TETRAHEDRON_FACES), None);
}

#[test]
fn a_missing_or_turned_face_leaves_edges_open() {
    assert_eq!(
        find_open_edge(&CORNERS, &TETRAHEDRON_FACES[..3]),
        Some([1, 2])
    );
    let mut turned = TETRAHEDRON_FACES;
    turned[3] = [1, 3, 2];
    assert_eq!(find_open_edge(&CORNERS, &turned), Some([1, 2]));
}

#[test]
fn vertices_at_one_place_are_one() {
    // Each face has corners of its own, and some zeros are negative.
    let corners: Vec<DVec3> = TETRAHEDRON_FACES
        .iter()
        .flatten()
        .map(|&k| CORNERS[k as usize])
        .collect();
    let signed = corners
        .iter()
        .enumerate()
        .map(|(k, p)| if k % 2 == 0 { *p } else { -(-*p) });
    let signed: Vec<DVec3> = signed.map(|p| DVec3::new(p.x * 1.0, p.y, p.z)).collect();
    let faces: Vec<[u32; 3]> = (0..4).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    assert_eq!(find_open_edge(&signed, &faces), None);
    let negative: Vec<DVec3> = signed
        .iter()
        .map(|p| p.map(|x| if x == 0.0 { -0.0 } else { x }))
        .collect();
    let mixed: Vec<DVec3> = (0..12)
        .map(|k| if k < 6 { signed[k] } else { negative[k] })
        .collect();
    assert_eq!(find_open_edge(&mixed, &faces), None);
}

#[test]
fn faces_without_area_change_nothing() {
    let mut faces = TETRAHEDRON_FACES.to_vec();
    faces.extend([[0, 0, 1], [2, 2, 2]]);
    assert_eq!(find_open_edge(&CORNERS, &faces), None);
}
