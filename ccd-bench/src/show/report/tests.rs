use super::*;
use crate::method::first_contact;
use crate::run::measured::Cell;
use crate::scene::model::Model;
use crate::show::chart::{Family, MethodFacts, SceneFacts};
use crate::show::view::Shot;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Instructions, Motion, Pose, Settings};
use ccd_decomp::TriangleMesh;
use ccd_decomp::{Detail, body_from_mesh};
use rigid_ccd::batch::Bodies;
use rigid_ccd::batch::SolverKind;
use rigid_ccd::table::motions::Motions;
use serde_json::Value;

fn mesh() -> TriangleMesh {
    Model::Knot216.generate().unwrap()
}

/// Returns a shot of a knot that turns past a resting one at the given distance.
fn shot(mesh: &TriangleMesh, aside: f64) -> Shot {
    let body = body_from_mesh(mesh, Detail::Auto).unwrap().body;
    let start = Pose::new(DVec3::new(3.0, aside, 0.0), DQuat::from_rotation_y(0.3)).unwrap();
    let end = Pose::new(DVec3::new(-3.0, aside, 0.0), DQuat::from_rotation_x(0.5)).unwrap();
    let centre = DVec3::new(0.1, 0.2, 0.3);
    let query = Motions {
        id: "</script>".to_owned(),
        a: Motion::between(start, end, centre, 2.0).unwrap(),
        b: Motion::still(Pose::IDENTITY),
        duration: 2.0,
    };
    let bodies = Bodies { a: &body, b: &body };
    let mut solver = SolverKind::default().solver(Instructions::Best);
    let answer = first_contact(bodies, &query, &Settings::DEFAULT, solver.as_mut()).unwrap();
    Shot::answered(query, &answer)
}

fn cell() -> Cell {
    Cell {
        scene: "knots".to_owned(),
        method: "ours".to_owned(),
        tolerance: 1e-3,
        rows: 2,
        median_us: 5.0,
        mean_us: 6.0,
        p95_us: 7.0,
        late: 0,
        missed: 0,
        false_contacts: 0,
        unresolved: 0,
        mean_error: f64::NAN,
        max_error: f64::NAN,
        early: 0,
        cut_off: 0,
        undecided: 0,
        mean_steps: 4.0,
    }
}

fn with_page<T>(look: impl FnOnce(&Page<'_>) -> T) -> T {
    let mesh = mesh();
    let views = [View {
        scene: "knots",
        a: &mesh,
        b: &mesh,
        shots: vec![shot(&mesh, 0.2), shot(&mesh, 9.0)],
    }];
    let tables = [TextTable {
        name: "usual".to_owned(),
        title: "A <table>".to_owned(),
        header: vec!["name & kind".to_owned()],
        rows: vec![vec!["{{style}}".to_owned()]],
    }];
    let charts = Charts {
        cells: &[cell()],
        scenes: &[SceneFacts {
            name: "knots",
            shape: "knot",
            triangles: 216,
        }],
        methods: &[MethodFacts {
            name: "ours",
            family: Family::Ours,
            label: "ours",
        }],
    };
    look(&Page {
        title: "Of \"knots\"",
        preface: "One.\n\nTwo < three.",
        charts,
        views: &views,
        tables: &tables,
    })
}

fn script(html: &str, id: &str) -> Value {
    let tag = format!("<script type=\"application/json\" id=\"{id}\">");
    let (_, rest) = html.split_once(&tag).unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

#[test]
fn shots_describe_their_outcome_and_contact() {
    let html = with_page(|page| page.html().unwrap());
    let data = script(&html, "views");
    assert_eq!(
        data["meshes"].as_array().map(Vec::len),
        Some(1),
        "equal ones are one"
    );
    let shots = data["groups"][0]["views"].as_array().unwrap();
    let says = |k: usize| shots[k]["verdict"].as_str().unwrap();
    assert!(says(0).starts_with("Contact at"));
    assert!(says(1).starts_with("No contact until 2"));
    let contacts = |k: usize| shots[k]["contacts"].as_array().unwrap();
    let time = contacts(0)[0]["time"].as_f64().unwrap();
    assert!(time > 0.0 && time < 2.0);
    assert!(contacts(0)[0]["normal"].is_array() && contacts(1).is_empty());
}

#[test]
fn the_page_is_self_contained_and_escapes_its_input() {
    let html = with_page(|page| page.html().unwrap());
    assert!(html.contains("<title>Of &quot;knots&quot;</title>"));
    assert!(html.contains("<p>Two &lt; three.</p>"));
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
    // The data of the views, the script of the tables, and those of the views.
    let views = ccd_view::scripts().matches("</script>").count();
    assert_eq!(html.matches("</script>").count(), 2 + views);
}

#[test]
fn an_empty_page_is_an_error() {
    let error = with_page(|page| {
        let charts = Charts {
            cells: &[],
            ..page.charts
        };
        Page { charts, ..*page }.html()
    });
    assert!(matches!(error, Err(PageError::Chart(_))));
}
