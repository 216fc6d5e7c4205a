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
        let reach = drawn.vertices().iter().map(|vertex| vertex.length());
        let reach = reach.max_by(f64::total_cmp).unwrap();
        assert!(reach > 0.0 && reach < 1.0, "{name}");
    }
}

#[test]
fn the_page_makes_the_same_bodies() {
    for name in Part::NAMES {
        let part = Part::from_name(name).unwrap();
        let json = part.to_json();
        let numbers = |key: &str| json[key].as_array().unwrap().len();
        assert_eq!(numbers("vertices"), 3 * part.surface.vertices().len());
        assert_eq!(numbers("faces"), 3 * part.surface.faces().len());
        if json["shape"] == json!(["mesh"]) {
            let exact = |vertex: &rigid_ccd::glam::DVec3| vertex.as_vec3().as_dvec3() == *vertex;
            assert!(part.surface.vertices().iter().all(exact), "{name}");
        }
    }
}

#[test]
fn what_is_no_part_is_an_error() {
    assert!(matches!(
        Part::from_name("spoon"),
        Err(WebError::UnknownPart(_))
    ));
}
