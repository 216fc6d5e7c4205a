//! Tests the error message for every kind of invalid 3MF.

use super::{error, file, package_of_model, tetrahedron};
use crate::MeshFault;
use crate::test_files::{Entry, model, object, package, zip_archive};
use rawzip::CompressionMethod;
use rstest::rstest;

const ITEM: &str = r#"<item objectid="1"/>"#;

fn valid_model() -> String {
    model("", &tetrahedron(r#"id="1""#), ITEM)
}

#[rstest]
#[case::vertex(
    "x=\"1\"",
    "x=\"one\"",
    "object 1: vertex 1 has \"one\" instead of a number as its x"
)]
#[case::no_vertex("<vertex x=\"1\"", "<vertex", "object 1: vertex 1 has no x")]
#[case::nan("x=\"1\"", "x=\"nan\"", "object 1: vertex 1 is NaN or infinite")]
#[case::infinite("x=\"1\"", "x=\"1e999\"", "object 1: vertex 1 is NaN or infinite")]
#[case::large("x=\"1\"", "x=\"1e13\"", "vertex 1 has a coordinate beyond")]
#[case::corner(
    "v1=\"1\"",
    "v1=\"4\"",
    "object 1: face 2 names vertex 4, but there are 4, numbered from 0"
)]
#[case::negative(
    "v1=\"1\"",
    "v1=\"-1\"",
    "object 1: triangle 2 has \"-1\" instead of a number as its v1"
)]
#[case::no_corner("v1=\"1\"", "", "object 1: triangle 2 has no v1")]
#[case::id("<object id=\"1\"", "<object", "an object has no id")]
#[case::bad_id(
    "<object id=\"1\"",
    "<object id=\"one\"",
    "an object has \"one\" instead of a number as its id"
)]
#[case::item(
    "objectid=\"1\"",
    "objectid=\"2\"",
    "item 0 of the build: names object 2, which there is not"
)]
#[case::no_item("<item objectid=\"1\"/>", "", "has no items in its build")]
#[case::item_without("<item objectid=\"1\"/>", "<item/>", "an item has no objectid")]
#[case::transform(
    "<item ",
    "<item transform=\"1 0 0\" ",
    "has the transform \"1 0 0\" instead of 12 numbers"
)]
#[case::more(
    "<item ",
    "<item transform=\"1 0 0 0 1 0 0 0 1 0 0 0 1\" ",
    "instead of 12 numbers"
)]
#[case::words(
    "<item ",
    "<item transform=\"1 0 0 0 1 0 0 0 1 0 0 up\" ",
    "instead of 12 numbers"
)]
#[case::nan_transform(
    "<item ",
    "<item transform=\"1 0 0 0 1 0 0 0 1 0 0 inf\" ",
    "instead of 12 numbers"
)]
#[case::unit(
    "<model ",
    "<model unit=\"mile\" ",
    "is in the unit \"mile\", which there is not"
)]
#[case::root("model", "modle", "begins with \"modle\" instead of a model")]
#[case::entity("A &amp; B", "<x>&lol;</x>", "")]
#[case::lattice(
    "</mesh>",
    "<b:beamlattice/></mesh>",
    "object 1: holds a shape of another kind, \"beamlattice\""
)]
#[case::boolean("<mesh>", "<b:booleanshape/><mesh>", "")]
#[case::displaced(
    "mesh>",
    "displacementmesh>",
    "object 1: holds a shape of another kind, \"displacementmesh\""
)]
#[case::nothing(
    "mesh>",
    "metadatagroup>",
    "object 1: holds a shape of another kind, \"nothing\""
)]
#[case::lattice_without_namespace(
    "</mesh>",
    "<beamlattice/></mesh>",
    "object 1: holds a shape of another kind, \"beamlattice\""
)]
#[case::two_shapes("</mesh>", "</mesh><components/>", "object 1: has two shapes")]
#[case::unclosed("</model>", "", "ends before its XML")]
#[case::crossed("</resources>", "</objects>", "its XML is not valid before byte")]
#[case::quote("x=\"1\"", "x=1", "its XML has a bad attribute")]
#[case::twice("x=\"1\"", "x=\"1\" x=\"2\"", "its XML has a bad attribute")]
#[case::dtd(
    "<model ",
    "<!DOCTYPE lolz [<!ENTITY lol \"lol\">]><model ",
    "has a document type"
)]
#[case::reference("x=\"1\"", "x=\"&lol;\"", "its XML has a bad attribute")]
#[case::required(
    "<model ",
    "<model requiredextensions=\"b\" ",
    "what the extension \"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" says"
)]
#[case::unknown_prefix(
    "<model ",
    "<model requiredextensions=\"p zz\" ",
    "what the extension \"zz\" says"
)]
fn bad_input_is_named(#[case] good_part: &str, #[case] bad_part: &str, #[case] expected: &str) {
    let text = valid_model();
    assert!(text.contains(good_part));
    let bytes = package_of_model(&text.replace(good_part, bad_part));
    match expected {
        // Case does not matter.
        "" => assert!(file(&bytes).into_mesh().is_ok()),
        _ => {
            let message = error(&bytes).to_string();
            assert!(message.contains(expected), "{message}");
        }
    }
}

#[test]
fn messages_name_model_and_object() {
    let text = model(
        "",
        &object(r#"id="3" name="lid""#, &[[0.0; 3]], &[[0, 0, 9]]),
        ITEM,
    );
    let expected = "\"/3D/3dmodel.model\": object 3 \"lid\": face 0 names vertex 9, but there are 1, numbered from 0";
    let message = error(&package_of_model(&text)).to_string();
    assert!(message.ends_with(expected), "{message}");
}

#[test]
fn objects_are_told_apart() {
    let two = tetrahedron(r#"id="1""#) + &tetrahedron(r#"id="1""#);
    let message = error(&package_of_model(&model("", &two, ITEM))).to_string();
    assert!(message.contains("has two objects 1"), "{message}");
}

fn components(id: u32, members: &[u32]) -> String {
    let members: String = members
        .iter()
        .map(|id| format!(r#"<component objectid="{id}"/>"#))
        .collect();
    format!(r#"<object id="{id}"><components>{members}</components></object>"#)
}

#[test]
fn components_name_objects() {
    let text = model("", &components(1, &[1]), ITEM);
    let message = error(&package_of_model(&text)).to_string();
    assert!(
        message.contains("object 1: is a component of itself"),
        "{message}"
    );
    let circle = components(1, &[2]) + &components(2, &[3]) + &components(3, &[2]);
    let message = error(&package_of_model(&model("", &circle, ITEM))).to_string();
    assert!(message.contains(": is a component of itself"), "{message}");
    let message = error(&package_of_model(&model("", &components(1, &[7]), ITEM))).to_string();
    assert!(
        message.contains("object 1, component 0: names object 7, which there is not"),
        "{message}"
    );
    let message = error(&package_of_model(&model("", &components(1, &[]), ITEM))).to_string();
    assert!(message.starts_with("has no "), "{message}");
}

/// Tests that a thousand nested objects, each ten times the one before, are refused.
#[test]
fn components_that_multiply_are_refused() {
    let mut objects = tetrahedron(r#"id="1""#);
    for id in 2..1000 {
        objects.push_str(&components(id, &[id - 1; 10]));
    }
    let error = error(&package_of_model(&model(
        "",
        &objects,
        r#"<item objectid="999"/>"#,
    )));
    assert!(
        matches!(error.fault, MeshFault::TooManyRepeats { .. }),
        "{error}"
    );
}

/// Tests that a long chain of components is read without recursion.
#[test]
fn components_may_be_deep() {
    let mut objects = tetrahedron(r#"id="1""#);
    for id in 2..100_000 {
        objects.push_str(&components(id, &[id - 1]));
    }
    let bytes = package_of_model(&model("", &objects, r#"<item objectid="99999"/>"#));
    assert_eq!(file(&bytes).into_mesh().unwrap().faces().len(), 4);
}

#[test]
fn elements_may_be_deep() {
    let nested = |depth| {
        let deep = format!("{}{}", "<a>".repeat(depth), "</a>".repeat(depth));
        package_of_model(&valid_model().replace("<resources>", &format!("{deep}<resources>")))
    };
    assert_eq!(file(&nested(60_000)).into_mesh().unwrap().faces().len(), 4);
    // quick-xml follows namespaces to this depth.
    let message = error(&nested(300_000)).to_string();
    assert!(
        message.contains("deeper than the supported limit"),
        "{message}"
    );
}

#[test]
fn models_of_the_package_must_be_there_and_agree() {
    let far = r#"<object id="1"><components><component p:path="/3D/b.model" objectid="1"/></components></object>"#;
    let root = model(r#"requiredextensions="p""#, far, ITEM);
    let message = error(&package_of_model(&root)).to_string();
    assert!(
        message.contains("\"/3D/b.model\": is not in the package"),
        "{message}"
    );
    let inches = model(r#"unit="inch""#, &tetrahedron(r#"id="1""#), "");
    let bytes = package(&[("3D/a.model", &root), ("3D/b.model", &inches)]);
    let message = error(&bytes).to_string();
    assert!(
        message.contains("the model \"/3D/b.model\" in another unit than mm"),
        "{message}"
    );
    // Models may refer to each other if their objects form no cycle.
    let back = model("", far.replace("b.model", "a.model").as_str(), "");
    let bytes = package(&[("3D/a.model", &root), ("3D/b.model", &back)]);
    let message = error(&bytes).to_string();
    assert!(
        message.contains("object 1: is a component of itself"),
        "{message}"
    );
}

#[test]
fn a_zip_is_whole() {
    let whole = package_of_model(&valid_model());
    for end in 0..whole.len() {
        assert!(!error(&whole[..end]).to_string().is_empty());
    }
    assert!(error(b"").to_string().contains("has no vertices"));
    assert!(error(b"hello").to_string().contains("its zip is not whole"));
    let other = Entry {
        path: "readme.txt",
        content: b"hello",
        method: CompressionMethod::STORE,
    };
    assert!(
        error(&zip_archive(&[other]))
            .to_string()
            .contains("so that it is no 3MF")
    );
    // A changed byte of a stored model does not pass its checksum.
    let text = valid_model();
    let stored = Entry {
        path: "3D/3dmodel.model",
        content: text.as_bytes(),
        method: CompressionMethod::STORE,
    };
    let mut bytes = zip_archive(&[stored]);
    let digit = bytes.windows(4).position(|four| four == b"x=\"1").unwrap() + 3;
    bytes[digit] = b'2';
    let message = error(&bytes).to_string();
    assert!(message.contains("its XML is not valid"), "{message}");
}

#[test]
fn other_compressions_are_refused() {
    for (method, expected) in [
        (CompressionMethod::ZSTD, "compressed by method 93"),
        (CompressionMethod::LZMA, "compressed by method 14"),
    ] {
        let text = valid_model();
        let entry = Entry {
            path: "3D/3dmodel.model",
            content: text.as_bytes(),
            method,
        };
        let message = error(&zip_archive(&[entry])).to_string();
        assert!(message.contains(expected), "{message}");
    }
}

/// Tests that a hundred million spaces, packed into a hundred thousand bytes, are refused.
#[test]
fn a_bomb_is_refused() {
    let text = valid_model().replace(
        "<resources>",
        &format!("{}<resources>", " ".repeat(100_000_000)),
    );
    let bytes = package_of_model(&text);
    assert!(bytes.len() < 200_000);
    let error = error(&bytes);
    assert!(
        error.to_string().contains("unpacks to more than"),
        "{error}"
    );
}
