use super::*;

fn decode_base64_chunks<const N: usize>(text: &str) -> Vec<[u8; N]> {
    let bytes = BASE64_STANDARD.decode(text).unwrap();
    let chunks = bytes.chunks_exact(N);
    assert!(chunks.remainder().is_empty());
    chunks.map(|chunk| chunk.try_into().unwrap()).collect()
}

fn tetrahedron(at: DVec3) -> DrawnMesh {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    DrawnMesh {
        vertices: corners.iter().map(|corner| *corner + at).collect(),
        faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
    }
}

#[test]
fn meshes_decode_to_their_numbers_even_far_away() {
    // At this place single precision has steps of 64.
    let far = DVec3::new(1e9, -1e9, 5e8);
    let mesh = tetrahedron(far);
    let stored = StoredMesh::new(&mesh);
    let numbers = decode_base64_chunks(&stored.vertices)
        .into_iter()
        .map(f32::from_le_bytes);
    let places: Vec<f64> = numbers.map(f64::from).collect();
    for (place, vertex) in places.chunks(3).zip(&mesh.vertices) {
        let there = DVec3::from_slice(place) + DVec3::from_array(stored.middle);
        assert!(there.distance(*vertex) < 1e-6, "{there} {vertex}");
    }
    let corners: Vec<u32> = decode_base64_chunks(&stored.faces)
        .into_iter()
        .map(u32::from_le_bytes)
        .collect();
    assert_eq!(corners, mesh.faces.concat());
}

#[test]
fn equal_meshes_are_stored_once() {
    let mut meshes = Meshes::default();
    let other = tetrahedron(DVec3::X);
    let numbers =
        [tetrahedron(DVec3::ZERO), other, tetrahedron(DVec3::ZERO)].map(|mesh| meshes.add(&mesh));
    assert_eq!(numbers, [0, 1, 0]);
}

#[test]
fn a_mesh_of_nothing_is_stored() {
    let stored = StoredMesh::new(&DrawnMesh::default());
    assert_eq!((stored.middle, stored.vertices.as_str()), ([0.0; 3], ""));
}
