use crate::{
    BodyError, BodySource, Detail, Format, MeshFault, SourceError, TriangleMesh, body_from_mesh,
    parse_body, prepare,
};
use ccd_core::glam::dvec3;
use ccd_core::{Combination, Volume};
use rstest::rstest;

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn report(file: &str) -> String {
    let mesh = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
    let prepared = body_from_mesh(&mesh, Detail::Auto).unwrap();
    assert_eq!(prepared.body.pieces().len(), prepared.report.pieces);
    assert_eq!(prepared.body.volume(), prepared.report.volume);
    prepared.report.to_string()
}

#[test]
fn a_closed_mesh_is_solid() {
    assert_eq!(report(TETRAHEDRON), "1 convex hull, solid");
}

#[test]
fn a_closed_mesh_inside_out_is_solid_and_says_so() {
    let file = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 2 3 1\nf 4 2 1\nf 4 3 2\nf 4 1 3\n";
    assert_eq!(report(file), "1 convex hull, solid (closed, inside out)");
}

#[test]
fn an_open_mesh_is_a_surface_and_says_why() {
    let file = TETRAHEDRON.replace("f 3 1 4", "f 2 2 3");
    assert_eq!(
        report(&file),
        "3 triangles, surface only (open; edges with one face: 3 (e0-2, e0-3, e2-3); \
         collapsed faces dropped: 1 (3))"
    );
}

#[test]
fn features_carry_the_numbers_of_the_file() {
    let file = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 2 3\nf 2 3 4\n";
    let mesh = TriangleMesh::from_reader(Format::Obj, file.as_bytes()).unwrap();
    let body = body_from_mesh(&mesh, Detail::Triangles).unwrap().body;
    let feature = |support: &[u32]| {
        let mut point = Combination::EMPTY;
        support.iter().for_each(|&corner| point.push(corner, 1.0));
        body.pieces().feature(0, &point).to_string()
    };
    assert_eq!(feature(&[0]), "v1");
    assert_eq!(feature(&[1, 2]), "e2-3");
    assert_eq!(feature(&[0, 1, 2]), "f1");
}

#[rstest]
#[case("box:1,2,3", BodySource::Box { half_extents: dvec3(1.0, 2.0, 3.0) })]
#[case(" sphere:0.5 ", BodySource::Sphere { radius: 0.5 })]
#[case("capsule: 1e-1 , 2", BodySource::Capsule { radius: 0.1, half_height: 2.0 })]
#[case("dir/part.stl", BodySource::Mesh("dir/part.stl".into()))]
#[case(r"C:\part.stl", BodySource::Mesh(r"C:\part.stl".into()))]
#[case("./box:1.obj", BodySource::Mesh("./box:1.obj".into()))]
fn descriptions_of_bodies(#[case] text: &str, #[case] expected: BodySource) {
    assert_eq!(text.parse(), Ok(expected));
}

#[rstest]
#[case("", SourceError::Empty)]
#[case("ball:1", SourceError::UnknownShape { shape: "ball".into() })]
#[case("box:1,2", SourceError::WrongCount { shape: "box", expected: 3, given: 2 })]
#[case("sphere:", SourceError::BadLength { shape: "sphere", length: String::new() })]
#[case("sphere:-1", SourceError::BadLength { shape: "sphere", length: "-1".into() })]
#[case("capsule:1,nan", SourceError::BadLength { shape: "capsule", length: "nan".into() })]
#[case("box:1,2,inf", SourceError::BadLength { shape: "box", length: "inf".into() })]
fn bad_descriptions_show_examples(#[case] text: &str, #[case] expected: SourceError) {
    let error = text.parse::<BodySource>().unwrap_err();
    assert!(error.to_string().contains("box:1,2,3"), "{error}");
    assert_eq!(error, expected);
}

#[rstest]
#[case("sphere:1e13", "sphere", "1e13")]
#[case("capsule:1,2e12", "capsule", "2e12")]
#[case("box:1,1e308,1", "box", "1e308")]
fn lengths_that_are_too_large_are_told_with_the_range(
    #[case] text: &str,
    #[case] shape: &'static str,
    #[case] length: &str,
) {
    let error = text.parse::<BodySource>().unwrap_err();
    let told = error.to_string();
    assert!(
        told.contains("too large") && told.contains("from 0 to 1e12"),
        "{told}"
    );
    let length = length.to_owned();
    assert_eq!(error, SourceError::TooLong { shape, length });
}

/// What is just not too large is taken.
#[test]
fn the_largest_lengths_are_lengths() {
    for text in ["sphere:1e12", "capsule:1e12,1e12", "box:1e12,1e12,1e12"] {
        assert!(parse_body(text, Detail::Auto).is_ok(), "{text}");
    }
}

#[test]
fn primitives_are_single_solid_pieces() {
    for text in ["box:1,2,3", "sphere:0.5", "capsule:0.2,1", "box:1,1,0"] {
        let prepared = parse_body(text, Detail::Auto).unwrap();
        assert_eq!(prepared.report.to_string(), "1 primitive, solid", "{text}");
        assert_eq!(prepared.body.volume(), Volume::Solid);
    }
}

#[test]
fn what_is_wrong_reaches_the_caller_typed() {
    assert!(matches!(
        parse_body("cone:1", Detail::Auto),
        Err(BodyError::Source(SourceError::UnknownShape { .. }))
    ));
    assert!(matches!(
        parse_body("sphere:1e300", Detail::Auto),
        Err(BodyError::Source(SourceError::TooLong { .. }))
    ));
    // Nobody has looked at a length that comes from code.
    let source = BodySource::Sphere { radius: 1e300 };
    assert!(matches!(
        source.load(Detail::Auto),
        Err(BodyError::Input(_))
    ));
    match parse_body("no/such/file.ply", Detail::Auto) {
        Err(BodyError::Mesh(error)) => {
            assert!(matches!(error.fault, MeshFault::Unreadable(_)));
            assert!(
                error
                    .to_string()
                    .starts_with("no/such/file.ply: cannot be read")
            );
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_mesh_that_is_not_what_was_asked_for_is_named_with_its_file() {
    let file = std::env::temp_dir().join(format!("ccd-open-{}.obj", std::process::id()));
    std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let source = file.display().to_string();
    let error = parse_body(&source, Detail::Hull).unwrap_err().to_string();
    std::fs::remove_file(&file).unwrap();
    let expected = format!("{source}: open; edges with one face: 3 (e0-1, e0-2, e1-2)");
    assert!(error.starts_with(&expected), "{error}");
}

/// Many points of a plane, but for rounding: every hull is exact all the same, as the core proves.
#[test]
fn hull_trees_of_what_is_nearly_flat_are_proven() {
    use crate::test_meshes::{block, cubes, placed};
    let step = cubes(&block([4, 4, 2]));
    let vertices = placed(&step, 0.1, dvec3(0.3, 0.1, 0.7)).vertices().to_vec();
    let tilt = ccd_core::glam::DQuat::from_axis_angle(dvec3(0.6, 0.0, 0.8), 0.4);
    let turned: Vec<_> = vertices.iter().map(|&p| tilt * p).collect();
    let turned = TriangleMesh::new(turned, step.faces()).unwrap();
    let model = prepare(&turned, Detail::Triangles).unwrap();
    let tree = model.with_hull_tree().unwrap().hull_tree.unwrap();
    // The root has points in the middle of its sides, which rounding took outward.
    assert!(tree.hulls().get(0).points.len() > 8);
}
