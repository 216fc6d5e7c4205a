use super::BodySource;
use super::error::SourceError;
use crate::{Adjustments, Axis, BodyError, MeshFault, MeshSource, PieceChoice, PreparedBody, Unit};
use ccd_core::Solidity;
use ccd_core::glam::dvec3;
use rstest::rstest;
use std::path::PathBuf;

#[rstest]
#[case("box:1,2,3", BodySource::Box { half_extents: dvec3(1.0, 2.0, 3.0) })]
#[case(" sphere:0.5 ", BodySource::Sphere { radius: 0.5 })]
#[case("capsule: 1e-1 , 2", BodySource::Capsule { radius: 0.1, half_height: 2.0 })]
#[case("cylinder:1,2", BodySource::Cylinder { radius: 1.0, half_height: 2.0, max_excess: None })]
#[case("cone:1,2,1e-3", BodySource::Cone { radius: 1.0, half_height: 2.0, excess: Some(1e-3) })]
#[case("dir/part.ccd", BodySource::StoredBody("dir/part.ccd".into()))]
#[case("dir/part.stl", mesh("dir/part.stl", None, ""))]
#[case(r"C:\part.stl", mesh(r"C:\part.stl", None, ""))]
#[case(r"C:\part.stl@mm", mesh(r"C:\part.stl", None, "@mm"))]
#[case("./box:1.obj", mesh("./box:1.obj", None, ""))]
#[case("part.stl@in@scale=0.5", mesh("part.stl", None, "@in@scale=0.5"))]
#[case("me@home/part.stl@surface", mesh("me@home/part.stl", None, "@surface"))]
#[case("old.stl@mm/part.stl", mesh("old.stl@mm/part.stl", None, ""))]
#[case("a.glb#lid@2@mirror=x", mesh("a.glb", Some("lid@2"), "@mirror=x"))]
#[case("a.glb#lid@mn", mesh("a.glb", Some("lid@mn"), ""))]
fn descriptions_are_parsed(#[case] text: &str, #[case] expected: BodySource) {
    assert_eq!(text.parse(), Ok(expected));
}

/// Returns the source that names a mesh file, an optional part of it, and adjustments given as text.
fn mesh(file: &str, part: Option<&str>, adjusted: &str) -> BodySource {
    let mut words = adjusted.split('@').skip(1);
    let adjustments = words.try_fold(Adjustments::NONE, Adjustments::with_parsed_adjustment);
    let adjustments = adjustments.unwrap();
    assert_eq!(adjustments.to_string(), adjusted);
    BodySource::Mesh(MeshSource {
        file: file.into(),
        part: part.map(Into::into),
        adjustments,
    })
}

#[rstest]
#[case("part.stl@mn", "@mn means nothing after a file; use @mm")]
#[case(
    "part.stl@scale=0",
    "@scale=0: 0 is no factor, which is a positive number; to mirror"
)]
#[case("part.stl@scale=-2", "@scale=-2: -2 is no factor")]
#[case("part.stl@scale=nan", "@scale=nan: nan is no factor")]
#[case("part.stl@scale=1,5", "@scale=1,5: 1,5 is no factor")]
#[case("part.stl@mirror=w", "@mirror=w means nothing")]
#[case("part.stl@mm@", "@ means nothing")]
#[case("part.ccd@mm", "part.ccd: a prepared body has its unit")]
fn unknown_words_after_a_file_are_reported(#[case] text: &str, #[case] message: &str) {
    let error = text.parse::<BodySource>().unwrap_err().to_string();
    assert!(error.starts_with(message), "{error}");
}

/// The path of a temporary mesh file of a tetrahedron, which is deleted on drop.
struct TetrahedronFile(PathBuf);

impl TetrahedronFile {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("{}-{name}", std::process::id()));
        let faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
        let text = format!("v 1 0 0\nv 3 0 0\nv 1 2 0\nv 1 0 2\n{faces}");
        std::fs::write(&path, text).unwrap();
        TetrahedronFile(path)
    }

    /// Returns the description that is the file's path followed by `words`.
    fn with_words(&self, words: &str) -> String {
        format!("{}{words}", self.0.display())
    }

    fn load_with_words(&self, words: &str) -> PreparedBody {
        load(&self.with_words(words)).unwrap()
    }
}

/// Loads the body that a valid text describes.
fn load(text: &str) -> Result<PreparedBody, BodyError> {
    text.parse::<BodySource>().unwrap().load(PieceChoice::Auto)
}

impl Drop for TetrahedronFile {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// Returns the least and the greatest x coordinate of a body.
fn x_range(prepared: &PreparedBody) -> [f64; 2] {
    let xs = prepared.body.pieces().points().iter().map(|p| p.x);
    let fold = |of: fn(f64, f64) -> f64| xs.clone().reduce(of).unwrap();
    [
        fold(ccd_core::order::lesser),
        fold(ccd_core::order::greater),
    ]
}

#[test]
fn files_are_taken_as_their_adjustments_say() {
    let file = TetrahedronFile::new("adjusted.obj");
    assert_eq!(x_range(&file.load_with_words("")), [1.0, 3.0]);
    assert_eq!(
        x_range(&file.load_with_words("@scale=0.1")),
        [0.1, 3.0 * 0.1]
    );
    let mirrored = file.load_with_words("@mirror=x");
    assert_eq!(x_range(&mirrored), [-3.0, -1.0]);
    // The triangles are reversed with the mirroring, so that no repair is needed.
    assert_eq!(
        mirrored.report.to_string(),
        file.load_with_words("").report.to_string()
    );
    assert_eq!(mirrored.report.volume, Solidity::Solid);
    assert!(mirrored.report.topology.unwrap().signed_volume > 0.0);
    let stated = file.load_with_words("@in");
    assert_eq!(
        (x_range(&stated), stated.unit),
        ([1.0, 3.0], Some(Unit::Inch))
    );
    let text = format!("{}@in", file.0.display());
    let source: BodySource = text.parse().unwrap();
    let converted = source
        .load_in_unit(Unit::Millimetre, PieceChoice::Auto)
        .unwrap();
    assert_eq!(x_range(&converted), [25.4, 76.2]);
    // Combined with the adjustments of all files.
    let doubled = Adjustments::NONE.scaled(2.0).unwrap().mirrored(Axis::X);
    let both = source.load_adjusted(&doubled, PieceChoice::Auto).unwrap();
    assert_eq!(x_range(&both), [-6.0, -2.0]);
}

#[test]
fn a_closed_mesh_may_be_hollow() {
    let file = TetrahedronFile::new("hollow.obj");
    assert_eq!(file.load_with_words("").report.volume, Solidity::Solid);
    let hollow = file.load_with_words("@surface");
    assert_eq!(
        (hollow.report.volume, hollow.report.pieces),
        (Solidity::Surface, 4)
    );
    assert_eq!(hollow.body.solidity(), Solidity::Surface);
    assert_eq!(hollow.report.to_string(), "4 triangles, surface only");
}

/// Tests that a file with the whole text as its name takes precedence over a part or adjustments.
#[test]
fn a_file_with_the_whole_text_as_its_name_is_that_file() {
    let (plain, at) = (
        TetrahedronFile::new("it.obj"),
        TetrahedronFile::new("it.obj@scale=2.obj"),
    );
    assert_eq!(x_range(&at.load_with_words("")), [1.0, 3.0]);
    drop(at);
    let text = plain.with_words("@scale=2.obj");
    assert!(matches!(
        text.parse::<BodySource>(),
        Err(SourceError::UnknownAdjustment(_))
    ));
}

#[test]
fn a_stored_body_stays_as_it_is() {
    let scaled = Adjustments::NONE.scaled(2.0).unwrap();
    let stored = BodySource::StoredBody("part.ccd".into());
    let error = stored
        .load_adjusted(&scaled, PieceChoice::Auto)
        .unwrap_err();
    assert!(matches!(error, BodyError::AdjustedStoredBody(_)), "{error}");
    let shape = BodySource::Sphere { radius: 1.0 };
    let ball = shape.load_adjusted(&scaled, PieceChoice::Auto).unwrap();
    assert_eq!(ball.body.pieces().get(0).radius, 1.0);
}

#[rstest]
#[case("", SourceError::Empty)]
#[case("ball:1", SourceError::UnknownShape { shape: "ball".into() })]
#[case("sphere", SourceError::WrongLengthCount { shape: "sphere", expected_count: 1, given_count: 0 })]
#[case("box:1,2", SourceError::WrongLengthCount { shape: "box", expected_count: 3, given_count: 2 })]
#[case("sphere:", SourceError::BadLength { shape: "sphere", length: String::new() })]
#[case("sphere:-1", SourceError::BadLength { shape: "sphere", length: "-1".into() })]
#[case("capsule:1,nan", SourceError::BadLength { shape: "capsule", length: "nan".into() })]
#[case("cylinder:1", SourceError::WrongLengthCount { shape: "cylinder", expected_count: 2, given_count: 1 })]
#[case("cone:1,2,3,4", SourceError::WrongLengthCount { shape: "cone", expected_count: 2, given_count: 4 })]
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
    assert_eq!(error, SourceError::LengthTooLarge { shape, length });
}

/// Tests that the largest allowed lengths are accepted.
#[test]
fn the_largest_lengths_are_lengths() {
    for text in ["sphere:1e12", "capsule:1e12,1e12", "box:1e12,1e12,1e12"] {
        assert!(load(text).is_ok(), "{text}");
    }
}

#[test]
fn primitives_are_single_solid_pieces() {
    for text in ["box:1,2,3", "sphere:0.5", "capsule:0.2,1", "box:1,1,0"] {
        let prepared = load(text).unwrap();
        assert_eq!(prepared.report.to_string(), "1 primitive, solid", "{text}");
        assert_eq!(prepared.body.solidity(), Solidity::Solid);
    }
}

/// Tests that the reported excess of a polytope over its cylinder or cone is at most the allowed one, and at least half
/// of it.
#[rstest]
#[case("cylinder:2,1", 2.0 / 4096.0)]
#[case("cone:2,1,1e-5", 1e-5)]
fn round_shapes_report_their_excess(#[case] text: &str, #[case] most: f64) {
    let PreparedBody { body, report, .. } = load(text).unwrap();
    assert!((0.5 * most..=most).contains(&report.excess), "{report}");
    assert!(!report.is_exact() && report.to_string().contains("sticking out by up to"));
    assert_eq!((body.pieces().len(), body.solidity()), (1, Solidity::Solid));
    assert!(format!("{text},-1").parse::<BodySource>().is_err());
}

#[test]
fn too_small_an_excess_is_refused() {
    let error = load("cylinder:1,1,1e-9").unwrap_err();
    assert!(
        error.to_string().starts_with("excess is 1e-9, but must be"),
        "{error}"
    );
}

#[test]
fn faults_reach_the_caller_typed() {
    // A length that comes from code was not checked by the parser.
    let source = BodySource::Sphere { radius: 1e300 };
    assert!(matches!(
        source.load(PieceChoice::Auto),
        Err(BodyError::InvalidShape(_))
    ));
    match load("no/such/file.ply") {
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

/// Tests that the message about a wrong number of lengths says 1 length, but 2 lengths.
#[test]
fn the_number_of_lengths_is_worded() {
    for (text, start) in [
        ("sphere:1,2", "\"sphere\" takes 1 length, not 2; use box"),
        ("cone", "\"cone\" takes 2 lengths, not 0; use box"),
    ] {
        let message = text.parse::<BodySource>().unwrap_err().to_string();
        assert!(message.starts_with(start), "{message}");
    }
}
