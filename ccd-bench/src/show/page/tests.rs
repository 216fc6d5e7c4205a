use super::*;
use crate::scene::{ModelBodyCache, scene_descriptions};
use serde_json::Value;

/// Returns the page of the smallest scene, with a table whose names contain HTML.
fn page() -> String {
    let scene_descriptions = scene_descriptions().unwrap();
    let listing = scene_descriptions
        .iter()
        .find(|listing| listing.name == "knot216");
    let scene = listing
        .unwrap()
        .make_scene(&mut ModelBodyCache::default())
        .unwrap();
    let table = TextTable {
        title: "A <table>".to_owned(),
        header: vec!["name & kind".to_owned()],
        rows: vec![vec!["{{style}}".to_owned()]],
    };
    let views = SceneAnimations::new(&[scene]).unwrap();
    page_html("<svg></svg>", &views, &[table]).unwrap()
}

fn parse_json_script(html: &str, id: &str) -> Value {
    let tag = format!("<script type=\"application/json\" id=\"{id}\">");
    let (_, rest) = html.split_once(&tag).unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn views_are_contacts_first_and_share_equal_meshes() {
    let data = parse_json_script(&page(), "views");
    assert_eq!(data["meshes"].as_array().map(Vec::len), Some(1));
    let views = data["groups"][0]["views"].as_array().unwrap();
    assert_eq!(views.len(), 8);
    for (number, view) in views.iter().enumerate() {
        let contacts = view["contacts"].as_array().unwrap();
        let name = view["name"].as_str().unwrap();
        assert_eq!(name.contains("(contact)"), number < 6, "{name}");
        assert_eq!(contacts.len(), usize::from(number < 6), "{name}");
        for contact in contacts {
            let time = contact["time"].as_f64().unwrap();
            assert!(time > 0.0 && time < 1.0 && contact["normal"].is_array());
        }
    }
}

#[test]
fn the_page_is_self_contained_and_escapes_its_input() {
    let html = page();
    assert!(html.contains("<h3>A &lt;table&gt;</h3>"));
    assert!(html.contains("name &amp; kind"));
    assert!(
        html.contains("<td class=\"number\">{{style}}</td>"),
        "not filled in again"
    );
    for elsewhere in [
        "<script src",
        "<link rel=\"stylesheet",
        "@import",
        "cdn.jsdelivr",
    ] {
        assert!(!html.contains(elsewhere), "{elsewhere}");
    }
    assert!(html.contains("<figure><svg"));
    // The data of the views, and their scripts.
    let views = ccd_view::view_scripts().matches("</script>").count();
    assert_eq!(html.matches("</script>").count(), 1 + views);
}
