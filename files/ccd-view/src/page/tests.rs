use super::*;
use crate::{Animation, DrawnMesh, ShownBody};
use ccd_core::Motion;
use ccd_core::glam::DVec3;

fn page(title: &str) -> String {
    let mut meshes = Meshes::default();
    let mesh = meshes.add(&DrawnMesh {
        vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        faces: vec![[0, 1, 2]],
    });
    let hostile = "</script><b>\u{2028}{{title}}";
    let view = Animation {
        bodies: vec![ShownBody::new(hostile, mesh, "#000", &Motion::STILL)],
        ..Animation::new(hostile, hostile, 1.0)
    };
    page_html(title, &meshes, vec![view]).unwrap()
}

#[test]
fn nothing_in_names_ends_an_element() {
    let html = page("a \"<b>\" & c");
    assert!(html.contains("<title>a &quot;&lt;b&gt;&quot; &amp; c</title>"));
    assert!(!html.contains("</script><b>"));
    assert!(html.contains("\\u003c/script>\\u003cb>"));
    assert!(
        html.contains("{{title}}"),
        "what is inserted is not filled in"
    );
    // Its data, and one element for each script.
    assert_eq!(
        html.matches("</script>").count(),
        1 + view_scripts().matches("</script>").count()
    );
}

#[test]
fn a_page_needs_nothing_else() {
    let html = page("");
    for elsewhere in [
        "<script src",
        "<link rel=\"stylesheet",
        "@import",
        "import(",
    ] {
        assert!(!html.contains(elsewhere), "{elsewhere}");
    }
    assert!(html.len() < 700_000, "{}", html.len());
}

#[test]
fn every_element_that_a_script_asks_for_is_there() {
    let asked = [include_str!("view.js"), include_str!("player.js")].concat();
    let quoted = asked.split('"').skip(1).step_by(2);
    let known = ["scene", "shot", "contacts", "status", "time", "now", "play"];
    let ids: Vec<&str> = quoted.filter(|word| known.contains(word)).collect();
    assert!(ids.len() >= known.len());
    for id in known {
        assert!(VIEW_HTML.contains(&format!("id=\"view-{id}\"")), "{id}");
    }
}

#[test]
fn no_control_character_reaches_a_page() {
    let html = page("a\0b\u{1b}[31m\u{9b}c");
    assert!(html.contains("a\u{fffd}b\u{fffd}[31m\u{fffd}c"));
    let data = json(&"a\0b\u{1b}[31m\u{8}\\u0000 \"<\n").unwrap();
    assert_eq!(data, r#""a\ufffdb\ufffd[31m\ufffd\\u0000 \"\u003c\n""#);
    let control = |c: char| c.is_control() && !"\n\r\t".contains(c);
    assert!(!html.chars().any(control) && !data.chars().any(control));
}
