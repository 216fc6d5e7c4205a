use super::*;

#[test]
fn every_part_bounds_a_solid_that_is_drawn_where_it_is() {
    for name in Part::NAMES {
        let part = Part::from_name(name).unwrap();
        let drawn = &part.surface;
        let volume: f64 = (drawn.faces().iter())
            .map(|face| face.map(|k| drawn.vertices()[k as usize]))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        assert!(volume > 0.0, "{name} is inside out");
        let prepared = body_from_mesh(drawn, Detail::Auto).unwrap();
        // The poles of a capsule are drawn as many equal points.
        let is_mesh = matches!(name, "knot" | "slot");
        assert!(
            !is_mesh || prepared.report.to_string().contains("solid"),
            "{name}: {}",
            prepared.report
        );
        assert_eq!(part.vertices().len(), 3 * drawn.vertices().len());
        assert_eq!(part.faces().len(), 3 * drawn.faces().len());
        assert!(part.reach() > 0.0 && part.reach() < 1.0, "{name}");
    }
}

#[test]
fn a_file_is_brought_to_a_size_about_its_middle() {
    let text = b"v 10 0 0\nv 14 0 0\nv 10 3 0\nf 1 2 3\n";
    let part = Part::from_file("a.obj", text, 0.5).unwrap();
    assert!((part.reach() - 0.25).abs() < 1e-9, "{}", part.reach());
}

#[test]
fn what_is_no_part_is_an_error() {
    assert!(matches!(
        Part::from_name("spoon"),
        Err(WebError::UnknownPart(_))
    ));
    let no_mesh: [(&str, &[u8]); 3] = [
        ("a.txt", b""),
        ("a.obj", b""),
        ("a.obj", b"v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n"),
    ];
    for (name, bytes) in no_mesh {
        assert!(
            Part::from_file(name, bytes, 0.5).is_err(),
            "{name} {bytes:?}"
        );
    }
}
