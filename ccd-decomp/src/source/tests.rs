use super::error::{BodyError, SourceError};
use super::{BodySource, parse_body};
use crate::{Detail, MeshFault, Prepared};
use ccd_core::Volume;
use ccd_core::glam::dvec3;
use rstest::rstest;

#[rstest]
#[case("box:1,2,3", BodySource::Box { half_extents: dvec3(1.0, 2.0, 3.0) })]
#[case(" sphere:0.5 ", BodySource::Sphere { radius: 0.5 })]
#[case("capsule: 1e-1 , 2", BodySource::Capsule { radius: 0.1, half_height: 2.0 })]
#[case("cylinder:1,2", BodySource::Cylinder { radius: 1.0, half_height: 2.0, excess: None })]
#[case("cone:1,2,1e-3", BodySource::Cone { radius: 1.0, half_height: 2.0, excess: Some(1e-3) })]
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
#[case("cylinder:1", SourceError::WrongCount { shape: "cylinder", expected: 2, given: 1 })]
#[case("cone:1,2,3,4", SourceError::WrongCount { shape: "cone", expected: 2, given: 4 })]
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
fn lengths_that_are_too_large_are_reported_with_the_range(
    #[case] text: &str,
    #[case] shape: &'static str,
    #[case] length: &str,
) {
    let error = text.parse::<BodySource>().unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("too large") && message.contains("from 0 to 1e12"),
        "{message}"
    );
    let length = length.to_owned();
    assert_eq!(error, SourceError::TooLong { shape, length });
}

/// The largest allowed lengths are accepted.
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

/// What a polytope exceeds its shape by is told, and is no more than was asked for.
#[rstest]
#[case("cylinder:2,1", 2.0 / 4096.0)]
#[case("cone:2,1,1e-5", 1e-5)]
fn round_shapes_tell_their_excess(#[case] text: &str, #[case] most: f64) {
    let Prepared { body, report, .. } = parse_body(text, Detail::Auto).unwrap();
    assert!((0.5 * most..=most).contains(&report.sticks_out), "{report}");
    assert!(!report.is_exact() && report.to_string().contains("sticking out by up to"));
    assert_eq!((body.pieces().len(), body.volume()), (1, Volume::Solid));
    let error = parse_body(&format!("{text},-1"), Detail::Auto);
    assert!(matches!(error, Err(BodyError::Source(_))));
}

#[test]
fn too_small_an_excess_is_refused() {
    let error = parse_body("cylinder:1,1,1e-9", Detail::Auto).unwrap_err();
    assert!(
        error.to_string().starts_with("excess is 1e-9, but must be"),
        "{error}"
    );
}

#[test]
fn faults_reach_the_caller_typed() {
    assert!(matches!(
        parse_body("torus:1", Detail::Auto),
        Err(BodyError::Source(SourceError::UnknownShape { .. }))
    ));
    assert!(matches!(
        parse_body("sphere:1e300", Detail::Auto),
        Err(BodyError::Source(SourceError::TooLong { .. }))
    ));
    // A length that comes from code was not checked by the parser.
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
