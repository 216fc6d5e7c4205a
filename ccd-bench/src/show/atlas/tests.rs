use super::*;
use crate::run::contest::Verdict;
use crate::show::chart::HeatKind;

fn map() -> HeatMap {
    let reach = |worst, share, limit: &str| {
        Some(HeatCell::Reach {
            worst,
            share,
            limit: limit.to_owned(),
        })
    };
    HeatMap {
        kind: HeatKind::Reach,
        methods: vec!["ours".to_owned(), "a <b>".to_owned(), "idle".to_owned()],
        rows: vec![HeatRow {
            name: "gap & more".to_owned(),
            parameter: "gap".to_owned(),
            cells: vec![
                reach(Verdict::Right, 1.0, ""),
                reach(Verdict::Missed, 0.25, "1e-3"),
                None,
            ],
        }],
    }
}

fn detail(view: Option<[usize; 2]>) -> Detail {
    Detail {
        command: "ccd-bench stability --families '</script>'".to_owned(),
        steps: Vec::new(),
        view,
    }
}

#[test]
fn each_cell_that_was_asked_is_a_button_with_its_colour_and_limit() {
    let details = [vec![Some(detail(None)), Some(detail(None)), None]];
    let atlas = Atlas {
        title: "Where <methods> fail",
        preface: "",
        maps: &[map()],
        details: &details,
        views: &[],
    };
    let html = atlas.html().unwrap();
    assert_eq!(html.matches("data-cell=\"").count(), 2);
    assert!(
        html.contains("data-cell=\"0,1\" aria-label=\"gap &amp; more: a &lt;b&gt; missed 1e-3\"")
    );
    assert!(html.contains("--bar:25%"));
    assert!(html.contains("Where &lt;methods&gt; fail"));
    // No tag of the data ends the script that it is in.
    assert!(!html.contains("'</script>'") && html.contains("'\\u003c/script>'"));
}
