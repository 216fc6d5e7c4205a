//! Tests that `ccd-bench chart` measures methods and writes the chart page and its tables.

use crate::command::{CommandCall, Scene, parse, stderr};
use std::fs;
use std::path::Path;

/// Runs `ccd-bench chart` on one scene with two methods, for a tenth of a second.
fn chart_call(folder: &Path) -> CommandCall {
    let options = [
        "chart",
        "--scenes",
        "knot216",
        "--methods",
        "best-first direct,C2A",
        "--tolerances",
        "1e-2,1e-3",
        "--cell-time",
        "0.1",
    ];
    CommandCall::with_args(&options).args(&["--out", folder.to_str().unwrap()])
}

#[test]
fn an_evaluation_writes_tables_charts_and_a_page_and_does_not_measure_twice() {
    let scene = Scene::new("chart");
    let folder = scene.directory.join("report");
    let output = chart_call(&folder).output();
    assert!(output.status.success(), "{}", stderr(&output));
    let output_text = String::from_utf8(output.stdout).unwrap();
    assert!(output_text.starts_with("Answers compared"), "{output_text}");
    assert!(output_text.contains("\n| C2A "), "{output_text}");
    assert!(output_text.lines().count() <= 10 && output_text.ends_with("index.html\n"));
    let page = fs::read_to_string(folder.join("index.html")).unwrap();
    assert!(page.contains("<h1>ccd: certified"));
    let place = |part: &str| page.find(part).unwrap();
    assert!(place(r#"<section id="scenes">"#) < place(r#"<section id="charts">"#));
    assert!(page.contains("Time against error"));
    assert_eq!(first_view_name_suffix(&page), "contact");
    let table = fs::read(folder.join("chart.csv")).unwrap();
    let rows = parse(&table);
    assert_eq!(rows.len(), 4);
    for row in &rows {
        assert_eq!(row.text("scene"), "knot216");
        assert!(row.number("rows") >= 1.0 && row.number("median_us") > 0.0);
        for fault in ["late", "missed", "false", "early", "unresolved"] {
            assert_eq!(row.number(fault), 0.0, "{fault} of {}", row.text("method"));
        }
        assert!(row.number("mean_error") <= row.number("max_error"));
    }
    let trials = parse(&fs::read(folder.join("trials.csv")).unwrap());
    let asked: f64 = rows.iter().map(|row| row.number("rows")).sum();
    assert_eq!(trials.len() as f64, asked);
    for file in ["pareto.svg", "index.html"] {
        assert!(
            fs::metadata(folder.join(file)).unwrap().len() > 1000,
            "{file}"
        );
    }
    let tables = fs::read_to_string(folder.join("tables.md")).unwrap();
    assert!(tables.contains("\n| knot216 | "), "{tables}");
    assert!(chart_call(&folder).output().status.success());
    assert_eq!(fs::read(folder.join("chart.csv")).unwrap(), table);
}

/// Returns the text in brackets in the name of the first view of a chart page.
fn first_view_name_suffix(page: &str) -> String {
    let (_, views) = page.split_once(r#"id="views">"#).unwrap();
    let (views, _) = views.split_once("</script>").unwrap();
    let views: serde_json::Value = serde_json::from_str(views).unwrap();
    let name = views["groups"][0]["views"][0]["name"].as_str().unwrap();
    name.split(['(', ')']).nth(1).unwrap().to_owned()
}

#[test]
fn exported_scenes_are_read_again() {
    let scene = Scene::new("chart-export");
    let folder = scene.directory.join("scenes");
    let options = ["chart", "--scenes", "knot216", "--export"];
    let run = CommandCall::with_args(&options).args(&[folder.to_str().unwrap()]);
    let output = run.output();
    assert!(output.status.success(), "{}", stderr(&output));
    let at = |name: &str| folder.join("knot216").join(name).display().to_string();
    let (a, b, motions) = (at("a.obj"), at("b.obj"), at("motions.csv"));
    let rows = CommandCall::with_args(&["truth", "--a", &a, "--b", &b, "--motions", &motions])
        .run_for_rows();
    assert_eq!(rows.len(), 25);
    let hits = rows.iter().filter(|r| r.text("status") == "hit").count();
    assert!((8..25).contains(&hits), "{hits}");
}

#[test]
fn unknown_names_are_answered_with_the_known_ones() {
    for (option, name) in [("--scenes", "knot216"), ("--methods", "C2A")] {
        let output = CommandCall::with_args(&["chart", option, "atlantis"]).output();
        assert_eq!(output.status.code(), Some(2));
        let output_text = stderr(&output);
        assert!(
            output_text.contains("atlantis") && output_text.contains(name),
            "{output_text}"
        );
    }
    let output = CommandCall::with_args(&["chart", "--tolerances", "-1"]).output();
    assert_eq!(output.status.code(), Some(2));
}
